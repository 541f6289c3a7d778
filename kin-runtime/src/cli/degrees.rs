//! Angles in degrees, for `--degrees`: coordinates, poses, defines, joint quantities, inputs, torsion springs and what
//! drivers drive, where they are angles.

use std::borrow::Cow;

use crate::forces::Forces;
use crate::measure::{Dimension, dimension_of_driven};
use crate::model::{Component, CoordinateKind, Model};
use crate::motion::{BodyMotion, Motion};
use crate::present::units::ResultUnits;
use crate::sensitivities::Sensitivities;
use crate::signal::Signal;
use crate::state::State;

/// The state with angles in degrees, if `degrees`.
pub(super) fn state<'s>(model: &Model, state: &'s State, degrees: bool) -> Cow<'s, State> {
    if !degrees {
        return Cow::Borrowed(state);
    }
    let (units, mut shown) = (ResultUnits::of(model), state.clone());
    turn_coordinates(model, [&mut shown.q, &mut shown.q_dot, &mut shown.q_ddot]);
    for (name, input) in model.inputs.iter().zip(&mut shown.inputs) {
        if units.dimension(name) == Dimension::Angle {
            turn_signal(input);
        }
    }
    Cow::Owned(shown)
}

/// The motion with angles in degrees, if `degrees`.
pub(super) fn motion<'m>(model: &Model, motion: &'m Motion, degrees: bool) -> Cow<'m, Motion> {
    if !degrees {
        return Cow::Borrowed(motion);
    }
    let mut shown = motion.clone();
    turn_motion(model, &mut shown.bodies, &mut shown.defines, &mut shown.joints);
    shown.forces.iter_mut().for_each(|forces| turn_forces(model, forces));
    Cow::Owned(shown)
}

/// The derivatives of angles in degrees, if `degrees`, by parameters in their own units.
pub(super) fn sensitivities(found: &Sensitivities, degrees: bool) -> Cow<'_, Sensitivities> {
    if !degrees {
        return Cow::Borrowed(found);
    }
    let (model, mut shown) = (found.model, found.clone());
    for by in &mut shown.by {
        turn_coordinates(model, [&mut by.q, &mut by.q_dot, &mut by.q_ddot]);
        turn_motion(model, &mut by.bodies, &mut by.defines, &mut by.joints);
        by.forces.iter_mut().for_each(|forces| turn_forces(model, forces));
    }
    Cow::Owned(shown)
}

/// Coordinates, their rates and their accelerations.
fn turn_coordinates(model: &Model, mut lists: [&mut Vec<f64>; 3]) {
    let units = ResultUnits::of(model);
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        let angle = match coordinate.kind {
            CoordinateKind::Pose { component, .. } => component == Component::Phi,
            CoordinateKind::Scalar => units.dimension(coordinate.name) == Dimension::Angle,
        };
        if angle {
            lists.iter_mut().filter_map(|values| values.get_mut(k)).for_each(turn);
        }
    }
}

/// Poses, defines and joint quantities.
fn turn_motion(model: &Model, bodies: &mut [BodyMotion], defines: &mut [Signal], joints: &mut [Vec<Signal>]) {
    let units = ResultUnits::of(model);
    for body in bodies {
        [&mut body.phi, &mut body.phi_dot, &mut body.phi_ddot].into_iter().for_each(turn);
    }
    let defines = model.defines.iter().map(|define| define.name.to_owned()).zip(defines);
    let joints = model.joints.iter().zip(joints).flat_map(|(joint, quantities)| {
        let names = joint.quantities.iter().map(|quantity| format!("{}.{}", joint.name, quantity.name));
        names.zip(quantities)
    });
    for (name, rates) in defines.chain(joints) {
        if units.dimension(&name) == Dimension::Angle {
            turn_signal(rates);
        }
    }
}

/// The rates of what drivers and inputs drive, and torsion springs.
fn turn_forces(model: &Model, forces: &mut Forces) {
    let efforts = forces.efforts.iter_mut().chain(&mut forces.inputs);
    let turning = efforts.filter(|effort| dimension_of_driven(model, effort.name) == Dimension::Angle);
    turning.for_each(|effort| turn(&mut effort.rate));
    let springs = forces.springs.iter_mut().filter(|spring| spring.turns);
    springs.flat_map(|spring| [&mut spring.length, &mut spring.rate]).for_each(turn);
}

fn turn_signal(signal: &mut Signal) {
    [&mut signal.value, &mut signal.rate, &mut signal.acceleration].into_iter().for_each(turn);
}

fn turn(value: &mut f64) {
    *value = value.to_degrees();
}
