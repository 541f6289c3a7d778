//! Motions, which all commands follow in the same way: from instant to instant, with the values of the requested
//! quantities.

use std::ops::ControlFlow;

use super::engine::Arc;
use super::failure::Failure;
use super::followed::{FollowedMotion, Moved, Visit};
use super::instants::Instants;
use super::leg::{LegRow, joined};
use super::limit_search::Stop;
use super::motion_notes::arc_notes;
use super::solved::{analysis, misfit, other_modes};
use crate::arc::ArcEnd;
use crate::error::SolveError;
use crate::measure::Measure;
use crate::present::number::rounded;
use crate::present::record::InstantRow;
use crate::state::State;

impl FollowedMotion<'_> {
    /// Follows the motion up to its first failure, to Ctrl-C or until `visit` ends it, and calls `visit` with every
    /// row. The result has no states. A motion in both directions from its start is followed backwards first.
    pub(super) fn each(&self, visit: Visit<'_>) -> Result<Moved, Failure> {
        let Instants { times, start, limits, notes, arc } = self.instants;
        if let Some(arc) = *arc {
            return self.along_arc(arc, visit);
        }
        let mut notes = notes.clone();
        notes.extend(times.get(*start).and_then(|first| other_modes(self.engine, self.setup, *first)));
        let (mut before, mut done) = (None, 0);
        if *start > 0 {
            let (rows, mut leg) = self.backwards(times, *start, limits[0].as_ref())?;
            done = rows.len().saturating_sub(1);
            if let (Some(stop), Some(last), true) = (&limits[0], rows.last(), leg.is_whole()) {
                notes.push(format!("note: it begins at t = {}: {}", rounded(stop.t), stop.text));
                self.at_limit(stop, &last.state, visit)?;
            }
            let event = leg.trajectory.events.first().filter(|_| self.stop_at_events).map(|event| event.state.clone());
            let until = event.as_ref().map_or(f64::INFINITY, |event| event.t);
            // The start itself is the first row of what follows.
            for LegRow { state, motion, values } in rows.iter().skip(1).rev().take_while(|row| row.state.t < until) {
                if visit(&InstantRow { state, motion: motion.as_ref(), values }).is_break() {
                    break;
                }
            }
            if let Some(event) = event {
                let _ = self.with_rates(&event, visit)?;
                leg.stop_at_first_event();
                notes.extend(leg.missing.take());
                return Ok(leg.moved(notes, false));
            }
            before = Some(leg);
        }
        let mut last = None;
        let keeps = limits[1].is_some();
        let mut leg = self.leg(&times[*start..], (done, limits[1].as_ref()), &mut |row| {
            if keeps {
                last = Some(row.state.clone());
            }
            visit(row)
        })?;
        if let (Some(stop), Some(last), true) = (&limits[1], &last, leg.is_whole()) {
            notes.push(format!("note: it ends at t = {}: {}", rounded(stop.t), stop.text));
            self.at_limit(stop, last, visit)?;
        }
        let at_its_end = leg.limit.is_some();
        notes.extend(leg.limit.take());
        notes.extend(before.as_mut().and_then(|first| first.missing.take()).or(leg.missing.take()));
        if let Some(mut first) = before {
            notes.extend(first.limit.take());
            leg = joined(first, leg);
        }
        Ok(leg.moved(notes, at_its_end))
    }

    /// Calls `visit` with the configuration at a limit, if it was found. Quantities that depend on rates are NaN there.
    fn at_limit(&self, stop: &Stop, neighbour: &State, visit: Visit<'_>) -> Result<(), Failure> {
        let Some(q) = &stop.q else { return Ok(()) };
        let mut state = State { t: stop.t, q: q.clone(), ..neighbour.clone() };
        let elapsed = stop.t - neighbour.t;
        state.inputs.iter_mut().for_each(|input| *input = input.after(elapsed));
        self.without_rates(state, visit).map(|_| ())
    }

    /// Calls `visit` with a state and its quantities.
    fn with_rates(&self, state: &State, visit: Visit<'_>) -> Result<ControlFlow<()>, Failure> {
        let (motion, values) = self.row(state).map_err(|error| analysis(self.engine, &error))?;
        Ok(visit(&InstantRow { state, motion: motion.as_ref(), values: &values }))
    }

    /// Calls `visit` with a configuration and all quantities that depend on it alone; rates and accelerations are NaN.
    fn without_rates(&self, mut state: State, visit: Visit<'_>) -> Result<ControlFlow<()>, Failure> {
        let Self { engine, setup, .. } = *self;
        let say = |error| analysis(engine, &error);
        state.q_dot.fill(0.0);
        state.q_ddot.fill(0.0);
        let motion = engine.motion(setup, &state).map_err(say)?.without_rates();
        state.bodies.clone_from(&motion.bodies);
        state.points.clone_from(&motion.points);
        let values = self.values(&state).map_err(say)?;
        let known = |(value, measure): (f64, &Measure)| if measure.is_place() { value } else { f64::NAN };
        let values: Vec<f64> = values.into_iter().zip(self.measures).map(known).collect();
        state.q_dot.fill(f64::NAN);
        state.q_ddot.fill(f64::NAN);
        Ok(visit(&InstantRow { state: &state, motion: self.reported.then_some(&motion), values: &values }))
    }

    /// The motion along the arc of the solution curve; `visit` is called after the whole arc is solved.
    fn along_arc(&self, arc: Arc, visit: Visit<'_>) -> Result<Moved, Failure> {
        let Self { engine, setup, watch, .. } = *self;
        let mut trajectory = match engine.sweep_along_arc(setup, arc, &|reached| watch.observe(reached)) {
            Ok(trajectory) => trajectory,
            Err(SolveError::Stopped { .. }) if watch.interrupted() => {
                return Err(Failure::Interrupted("no state of the arc is finished".to_owned()));
            }
            Err(error) => return Err(misfit(engine, setup, arc.from, &error)),
        };
        for state in std::mem::take(&mut trajectory.states) {
            let flow = if state.q_dot.iter().any(|rate| rate.is_nan()) {
                self.without_rates(state, visit)?
            } else {
                self.with_rates(&state, visit)?
            };
            if flow.is_break() {
                break;
            }
        }
        let found = trajectory.arc.as_ref();
        let notes = found.map_or_else(Vec::new, arc_notes);
        let at_its_end =
            found.is_some_and(|arc| arc.ends.iter().any(|end| !matches!(end, ArcEnd::Closed | ArcEnd::Bound)));
        let (motions, columns, contacts) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Moved { trajectory, motions, columns, ended: None, notes, at_its_end, open: 0, contacts })
    }

    /// The motion with its states, with the values of the quantities as columns, and with motions if `reported`. A motion
    /// that ends before its first row is an error.
    pub(super) fn with_states(&self) -> Result<Moved, Failure> {
        let (mut states, mut motions) = (Vec::new(), Vec::new());
        let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(self.instants.len()); self.measures.len()];
        let mut moved = self.each(&mut |row| {
            states.push(row.state.clone());
            motions.extend(row.motion.cloned());
            columns.iter_mut().zip(row.values).for_each(|(column, value)| column.push(*value));
            ControlFlow::Continue(())
        })?;
        if let Some(failure) = moved.ended.take_if(|_| states.is_empty()) {
            return Err(failure);
        }
        moved.trajectory.states = states;
        Ok(Moved { motions, columns, ..moved })
    }
}
