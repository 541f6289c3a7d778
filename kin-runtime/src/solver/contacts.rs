//! Loss of contact and slack ropes: the instants at which a normal force or a tension changes its sign.

use super::{AnySolver, Solver};
use crate::analysis::forces::forces as forces_of;
use crate::error::SolveError;
use crate::forces::{ContactChange, Forces};
use crate::mechanism::Mechanism;
use crate::nonlinear::root::{Value, bracket, tolerance};
use crate::signal::{Instant, Signal};
use crate::state::State;

/// Gives the state at an instant near a known state, with the forces of its contacts and ropes.
type Between<'b> = &'b dyn Fn(f64, &State) -> Option<(State, Vec<Option<f64>>)>;

/// Watches the forces of contacts and ropes from state to state.
#[derive(Default)]
pub(crate) struct ContactWatch {
    /// For every joint the last two states at which its force is determined, with this force; empty for joints that are
    /// neither contacts nor ropes.
    last: Vec<Vec<(State, f64)>>,
    /// The changes that were found.
    pub(crate) changes: Vec<ContactChange>,
}

impl ContactWatch {
    /// The next state of a motion.
    pub(crate) fn push(&mut self, state: &State, forces: &Forces, between: Between<'_>) {
        self.last.resize(forces.reactions.len(), Vec::new());
        for (k, (force, last)) in forces.one_sided().zip(&mut self.last).enumerate() {
            let Some(value) = force else { continue };
            let joint = Joint { name: forces.reactions[k].name, k, rope: forces.reactions[k].normal.is_none() };
            let found = match last.as_slice() {
                [] if value < 0.0 => vec![joint.changed(state.t, true, 0.0)],
                [] => Vec::new(),
                [.., (before, earlier)] if (*earlier < 0.0) != (value < 0.0) => {
                    vec![joint.change((before, *earlier), (state, value), between)]
                }
                [(first, earliest), (before, earlier)] => {
                    joint.dip([(first, *earliest), (before, *earlier), (state, value)], between)
                }
                _ => Vec::new(),
            };
            self.changes.extend(found);
            if last.len() == 2 {
                last.remove(0);
            }
            last.push((state.clone(), value));
        }
    }
}

/// A contact or a rope.
#[derive(Clone, Copy)]
struct Joint {
    name: &'static str,
    /// Its index among the reactions.
    k: usize,
    rope: bool,
}

impl Joint {
    const fn changed(self, t: f64, lifts_off: bool, within: f64) -> ContactChange {
        ContactChange { name: self.name, t, lifts_off, within, rope: self.rope }
    }

    /// The change of sign between two states.
    fn change(self, from: (&State, f64), to: (&State, f64), between: Between<'_>) -> ContactChange {
        let lifts_off = to.1 < 0.0;
        let sign = if lifts_off { 1.0 } else { -1.0 };
        let value = |(state, force): (&State, f64)| Value { t: state.t, f: sign * force, rate: f64::NAN };
        let near = |t: f64| if (t - from.0.t).abs() < (to.0.t - t).abs() { from.0 } else { to.0 };
        let evaluate = |t: f64| {
            let (state, forces) = between(t, near(t))?;
            Some(value((&state, (*forces.get(self.k)?)?)))
        };
        let [first, last] = bracket(value(from), value(to), tolerance(to.0.t.abs()), evaluate);
        let t = if first.f.abs() < last.f.abs() { first.t } else { last.t };
        self.changed(t, lifts_off, (last.t - first.t).abs())
    }

    /// Two changes around the least of three forces of one sign, where a parabola through them comes near 0 or beyond.
    fn dip(self, values: [(&State, f64); 3], between: Between<'_>) -> Vec<ContactChange> {
        let [(a, x), (b, y), (c, z)] = values;
        let sign = if y < 0.0 { -1.0 } else { 1.0 };
        let (x, y, z) = (sign * x, sign * y, sign * z);
        let (h, g) = (b.t - a.t, c.t - b.t);
        let (before, after) = ((y - x) / h, (z - y) / g);
        let curvature = (after - before) / (h + g);
        let slope = (before * g + after * h) / (h + g);
        if x < y || z < y || curvature.is_nan() || curvature <= 0.0 {
            return Vec::new();
        }
        let (t, least) = (b.t - 0.5 * slope / curvature, y - 0.25 * slope * slope / curvature);
        if least > 0.1 * y {
            return Vec::new();
        }
        let Some((state, forces)) = between(t, b) else { return Vec::new() };
        let force = forces.get(self.k).copied().flatten();
        let Some(value) = force.filter(|force| sign * force < 0.0) else { return Vec::new() };
        // The least force is between the first and the second state, or between the second and the third.
        let (from, to) = match (t - b.t) * h < 0.0 {
            true => ((a, sign * x), (b, sign * y)),
            false => ((b, sign * y), (c, sign * z)),
        };
        vec![self.change(from, (&state, value), between), self.change((&state, value), to, between)]
    }
}

impl<M: Mechanism> Solver<'_, M> {
    /// Where contacts lift off and press again, and where ropes go slack and are taut again, over the states of a motion
    /// in their order: the instants at which the normal force of a cam, a flat follower or a rolling disc
    /// ([`Reaction::normal`](crate::Reaction::normal)), or the tension of a rope, changes its sign, exact to rounding.
    /// Contacts and ropes in kin hold in both directions, so the motion does not change there; a real follower leaves its
    /// cam unless a spring or a groove holds it.
    ///
    /// Between states the mechanism is solved again. Two changes of sign between two states are found if the force is
    /// small at the states around them. A contact or a rope whose force has the wrong sign at the first state lifts off or
    /// goes slack there. Where redundant rows leave a force undetermined, it is not watched.
    ///
    /// # Errors
    /// As [`forces`](Self::forces) at the states.
    pub fn contact_changes(&self, states: &[State]) -> Result<Vec<ContactChange>, SolveError> {
        let mut watch = ContactWatch::default();
        for state in states {
            self.watch_contacts(&mut watch, state)?;
        }
        Ok(watch.changes)
    }

    /// The next state of a motion that is watched.
    pub(crate) fn watch_contacts(&self, watch: &mut ContactWatch, state: &State) -> Result<(), SolveError> {
        watch_contacts(self, watch, state)
    }
}

/// As [`Solver::watch_contacts`].
fn watch_contacts(solver: &dyn AnySolver, watch: &mut ContactWatch, state: &State) -> Result<(), SolveError> {
    let forces = |state: &State| forces_of(&mut solver.equations_of_state(state)?, state, solver.settings().sharing);
    watch.push(state, &forces(state)?, &|t, near| {
        let state = beside(solver, t, near)?;
        let forces = forces(&state).ok()?.one_sided().collect();
        Some((state, forces))
    });
    Ok(())
}

/// The state at an instant near another.
fn beside(solver: &dyn AnySolver, t: f64, near: &State) -> Option<State> {
    let mut inputs = near.inputs.clone();
    match solver.settings().inputs {
        Some(function) => function(t, &mut inputs),
        None => inputs.iter_mut().for_each(|input: &mut Signal| *input = input.after(t - near.t)),
    }
    let h = t - near.t;
    let rates = near.q.iter().zip(&near.q_dot).zip(&near.q_ddot);
    let start: Vec<f64> = rates.map(|((q, rate), acceleration)| q + h * (rate + 0.5 * h * acceleration)).collect();
    solver.state_near_start(&Instant { t, inputs: &inputs }, &start).ok()
}
