//! Angles in degrees, for `--degrees`: coordinates, poses, defines, joint quantities and inputs that are angles.

use std::borrow::Cow;

use crate::measure::Dimension;
use crate::model::{Component, CoordinateKind, Model};
use crate::motion::Motion;
use crate::present::units::ResultUnits;
use crate::state::State;

/// The state with angles in degrees, if `degrees`.
pub(super) fn state<'s>(model: &Model, state: &'s State, degrees: bool) -> Cow<'s, State> {
    if !degrees {
        return Cow::Borrowed(state);
    }
    let (units, mut shown) = (ResultUnits::of(model), state.clone());
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        let angle = match coordinate.kind {
            CoordinateKind::Pose { component, .. } => component == Component::Phi,
            CoordinateKind::Scalar => units.dimension(coordinate.name) == Dimension::Angle,
        };
        if angle {
            for values in [&mut shown.q, &mut shown.q_dot, &mut shown.q_ddot] {
                values.get_mut(k).into_iter().for_each(turn);
            }
        }
    }
    for (name, input) in model.inputs.iter().zip(&mut shown.inputs) {
        if units.dimension(name) == Dimension::Angle {
            [&mut input.value, &mut input.rate, &mut input.acceleration].into_iter().for_each(turn);
        }
    }
    Cow::Owned(shown)
}

/// The motion with angles in degrees, if `degrees`.
pub(super) fn motion<'m>(model: &Model, motion: &'m Motion, degrees: bool) -> Cow<'m, Motion> {
    if !degrees {
        return Cow::Borrowed(motion);
    }
    let (units, mut shown) = (ResultUnits::of(model), motion.clone());
    for body in &mut shown.bodies {
        [&mut body.phi, &mut body.phi_dot, &mut body.phi_ddot].into_iter().for_each(turn);
    }
    let defines = model.defines.iter().map(|define| define.name.to_owned()).zip(&mut shown.defines);
    let joints = model.joints.iter().zip(&mut shown.joints).flat_map(|(joint, quantities)| {
        let names = joint.quantities.iter().map(|quantity| format!("{}.{}", joint.name, quantity.name));
        names.zip(quantities)
    });
    for (name, rates) in defines.chain(joints) {
        if units.dimension(&name) == Dimension::Angle {
            [&mut rates.value, &mut rates.rate, &mut rates.acceleration].into_iter().for_each(turn);
        }
    }
    Cow::Owned(shown)
}

fn turn(value: &mut f64) {
    *value = value.to_degrees();
}
