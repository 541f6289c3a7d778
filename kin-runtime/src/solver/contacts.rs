//! Loss of contact: the instants at which a normal force changes its sign.

use super::{AnySolver, Solver};
use crate::analysis::forces::forces as forces_of;
use crate::error::SolveError;
use crate::forces::{ContactChange, Forces};
use crate::mechanism::Mechanism;
use crate::nonlinear::root::{Value, bracket, tolerance};
use crate::signal::{Instant, Signal};
use crate::state::State;

/// Gives the state at an instant near a known state, with its normal forces.
type Between<'b> = &'b dyn Fn(f64, &State) -> Option<(State, Vec<Option<f64>>)>;

/// Watches normal forces from state to state.
#[derive(Default)]
pub(crate) struct ContactWatch {
    /// For every joint the last two states at which its normal force is determined, with this force; empty for joints
    /// that are no contacts.
    last: Vec<Vec<(State, f64)>>,
    /// The changes that were found.
    pub(crate) changes: Vec<ContactChange>,
}

impl ContactWatch {
    /// The next state of a motion.
    pub(crate) fn push(&mut self, state: &State, forces: &Forces, between: Between<'_>) {
        self.last.resize(forces.reactions.len(), Vec::new());
        for (k, (reaction, last)) in forces.reactions.iter().zip(&mut self.last).enumerate() {
            let (name, Some(value)) = (reaction.name, reaction.normal) else { continue };
            let found = match last.as_slice() {
                [] if value < 0.0 => vec![ContactChange { name, t: state.t, lifts_off: true, within: 0.0 }],
                [] => Vec::new(),
                [.., (before, earlier)] if (*earlier < 0.0) != (value < 0.0) => {
                    vec![change(name, k, (before, *earlier), (state, value), between)]
                }
                [(first, earliest), (before, earlier)] => {
                    dip(name, k, [(first, *earliest), (before, *earlier), (state, value)], between)
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

/// The normal forces of all joints, of those that are contacts and where they are determined.
fn normals(forces: &Forces) -> Vec<Option<f64>> {
    forces.reactions.iter().map(|reaction| reaction.normal).collect()
}

/// The change of sign between two states.
fn change(name: &'static str, k: usize, from: (&State, f64), to: (&State, f64), between: Between<'_>) -> ContactChange {
    let lifts_off = to.1 < 0.0;
    let sign = if lifts_off { 1.0 } else { -1.0 };
    let value = |(state, normal): (&State, f64)| Value { t: state.t, f: sign * normal, rate: f64::NAN };
    let near = |t: f64| if (t - from.0.t).abs() < (to.0.t - t).abs() { from.0 } else { to.0 };
    let evaluate = |t: f64| {
        let (state, normals) = between(t, near(t))?;
        Some(value((&state, (*normals.get(k)?)?)))
    };
    let [first, last] = bracket(value(from), value(to), tolerance(to.0.t.abs()), evaluate);
    let t = if first.f.abs() < last.f.abs() { first.t } else { last.t };
    ContactChange { name, t, lifts_off, within: (last.t - first.t).abs() }
}

/// Two changes around the least of three forces of one sign, where a parabola through them comes near 0 or beyond.
fn dip(name: &'static str, k: usize, values: [(&State, f64); 3], between: Between<'_>) -> Vec<ContactChange> {
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
    let Some((state, normals)) = between(t, b) else { return Vec::new() };
    let Some(value) = normals.get(k).copied().flatten().filter(|value| sign * value < 0.0) else { return Vec::new() };
    // The least force is between the first and the second state, or between the second and the third.
    let (from, to) = if (t - b.t) * h < 0.0 { ((a, sign * x), (b, sign * y)) } else { ((b, sign * y), (c, sign * z)) };
    vec![change(name, k, from, (&state, value), between), change(name, k, (&state, value), to, between)]
}

impl<M: Mechanism> Solver<'_, M> {
    /// Where contacts lift off, and where they press again, over the states of a motion in their order: the instants at
    /// which the normal force of a cam, a flat follower or a rolling disc
    /// ([`Reaction::normal`](crate::Reaction::normal)) changes its sign, exact to rounding. Contacts in kin hold in
    /// both directions, so the motion does not change there; a real follower leaves its cam unless a spring or a groove
    /// holds it.
    ///
    /// Between states the mechanism is solved again. Two changes of sign between two states are found if the force is
    /// small at the states around them. A contact whose force is tensile at the first state lifts off there.
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
        let normals = normals(&forces(&state).ok()?);
        Some((state, normals))
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
