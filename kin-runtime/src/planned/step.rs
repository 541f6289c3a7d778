//! A step of a plan with the names of its joints, for error messages.

use crate::model::{CoordinateKind, Model};
use crate::plan::{PlanStep, StepKind};
use core::fmt;

/// Largest number of coordinates of a mechanism for which the drivers of a step are determined.
const COORDINATES: usize = 1024;

/// A set of coordinates, as bits by their index in q.
type Coordinates = [u64; COORDINATES / 64];

fn contains(set: &Coordinates, k: usize) -> bool {
    set[k / 64] >> (k % 64) & 1 == 1
}

/// A step of a mechanism's plan.
#[doc(hidden)]
#[derive(Clone, Copy)]
pub struct Step {
    model: &'static Model,
    index: u32,
    /// True if the margin measures the distance between the closures of the group.
    closes: bool,
}

impl Step {
    /// The step at `index` of [`Plan::steps`](crate::plan::Plan::steps); `None` where that is out of range.
    pub fn new(model: &'static Model, index: usize) -> Option<Self> {
        let step = model.plan.steps.get(index)?;
        Some(Self { model, index: u32::try_from(index).ok()?, closes: step.kind == StepKind::Closure })
    }

    /// The step to which a margin belongs.
    pub fn of_margin(model: &'static Model, margin: usize) -> Option<Self> {
        let closes = model.plan.modes.iter().any(|mode| mode.margin == margin);
        let index = u32::try_from(model.plan.step_of_margin(margin)?).ok()?;
        Some(Self { model, index, closes })
    }

    /// The index of the step in [`Plan::steps`](crate::plan::Plan::steps).
    pub const fn index(&self) -> usize {
        self.index as usize
    }

    /// The description of the step in the plan.
    pub fn info(&self) -> &'static PlanStep {
        &self.model.plan.steps[self.index()]
    }

    /// The names of the step's joints: those of a dyad from one end to the other, others in
    /// order of declaration.
    pub fn joints(&self) -> impl Iterator<Item = &'static str> + use<> {
        let joints = self.model.joints;
        self.info().joints.iter().filter_map(|&joint| joints.get(joint)).map(|joint| joint.name)
    }

    /// Whether the mechanism has inputs.
    pub(super) const fn has_inputs(&self) -> bool {
        !self.model.inputs.is_empty()
    }

    /// The name of the mechanism.
    pub const fn mechanism(&self) -> &'static str {
        self.model.name
    }

    /// The names of the bodies that the step places, in order of declaration.
    pub fn bodies(&self) -> impl Iterator<Item = &'static str> + use<> {
        let (model, info) = (self.model, self.info());
        let places = move |body: usize| {
            let is_pose_of_body =
                |&(k, _): &(usize, usize)| match model.coordinates.get(k).map(|coordinate| coordinate.kind) {
                    Some(CoordinateKind::Pose { body: other, .. }) => other == body,
                    _ => false,
                };
            info.coordinates.iter().any(is_pose_of_body)
        };
        model.bodies.iter().enumerate().filter(move |(body, _)| places(*body)).map(|(_, body)| body.name)
    }

    /// The drivers whose range the limit of the step ends: those among its joints or, where there are none, all drivers
    /// of the bodies to which it is attached. Empty where these cannot be determined, in mechanisms of more than 1024
    /// coordinates.
    pub fn drivers(&self) -> impl Iterator<Item = &'static str> + use<> {
        let (model, own_joints, moving) = (self.model, self.info().joints, self.coordinates_before());
        let drives = move |joint: usize| model.rows.iter().any(|row| row.joint == joint && row.driving);
        let inside = own_joints.iter().any(|&joint| drives(joint));
        let belongs = move |joint: usize| match inside {
            true => own_joints.contains(&joint),
            false => model.plan.steps.iter().any(|step| {
                step.joints.contains(&joint) && step.coordinates.iter().any(|&(k, _)| contains(&moving, k))
            }),
        };
        let joints = model.joints.iter().enumerate();
        joints.filter(move |(joint, _)| drives(*joint) && belongs(*joint)).map(|(_, joint)| joint.name)
    }

    /// The coordinates from earlier steps on which this step depends, directly or indirectly.
    fn coordinates_before(&self) -> Coordinates {
        let mut needed = [0; COORDINATES / 64];
        if self.model.coordinates.len() > COORDINATES {
            return needed;
        }
        for (index, step) in self.model.plan.steps[..=self.index()].iter().enumerate().rev() {
            let gives = step.coordinates.iter().any(|&(k, _)| contains(&needed, k));
            if index != self.index() && !gives {
                continue;
            }
            for &(row, k) in self.model.constraint_pattern.entries {
                if self.model.rows.get(row).is_some_and(|row| step.joints.contains(&row.joint)) {
                    needed[k / 64] |= 1 << (k % 64);
                }
            }
        }
        needed
    }

    /// True for redundant rows, whose residuals are checked.
    pub fn checks_redundant_rows(&self) -> bool {
        self.info().kind == StepKind::RedundantRows
    }

    /// True for a group that is solved by iteration.
    pub(crate) fn is_iterated(&self) -> bool {
        matches!(self.info().kind, StepKind::Newton(_))
    }

    /// True if the margin measures the distance between the two closures of a group; false for the margin of a divisor.
    pub const fn closes(&self) -> bool {
        self.closes
    }
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::eq(self.model, other.model) && self.index == other.index
    }
}

/// For example `dyad RRR of A, B, D`.
impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = self.info();
        match (step.group, step.kind) {
            ("", StepKind::Explicit) => f.write_str("formula")?,
            ("", StepKind::RedundantRows) if step.rows.len() == 1 => f.write_str("redundant row")?,
            ("", StepKind::RedundantRows) => f.write_str("redundant rows")?,
            ("", StepKind::Linear(1)) => f.write_str("linear equation")?,
            ("", StepKind::Linear(n)) => write!(f, "{n}×{n} linear system")?,
            ("", StepKind::Closure) => f.write_str("closure")?,
            ("", StepKind::Newton(n)) => write!(f, "{n}×{n} Newton iteration")?,
            (group, StepKind::Newton(n)) => write!(f, "group {group} by a {n}×{n} Newton iteration")?,
            (group, _) => write!(f, "dyad {group}")?,
        }
        for (k, joint) in self.joints().enumerate() {
            f.write_str(if k == 0 { " of " } else { ", " })?;
            f.write_str(joint)?;
        }
        Ok(())
    }
}

impl fmt::Debug for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Step({}: {self})", self.index)
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Step {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mechanism;
    use crate::fixture::{PlannedFourBar, StretchedSlider};

    #[test]
    fn a_step_is_known_by_its_mechanism_and_its_index() {
        let model = PlannedFourBar::model();
        let step = |index: usize| Step::new(model, index).unwrap();
        assert!(step(2) == step(2) && step(0) != step(1));
        assert_eq!(
            (Some(step(2)), None, None),
            (Step::of_margin(model, 0), Step::of_margin(model, 1), Step::new(model, 3))
        );
        // Steps of different mechanisms are never equal.
        let mut other = Box::new(*model);
        other.name = "other";
        let other: &'static Model = Box::leak(other);
        assert!(Step::new(other, 2).unwrap() != step(2));
        assert_eq!(None, Step::new(StretchedSlider::model(), 0));
    }

    #[test]
    fn a_step_names_what_belongs_to_it() {
        let step = |index: usize| Step::new(PlannedFourBar::model(), index).unwrap();
        // The driver of the crank also drives the dyad that is attached to it.
        assert!((0..3).all(|index| step(index).drivers().eq(["drive"])));
        assert_eq!([false, false, true], [0, 1, 2].map(|index| step(index).closes()));
        assert!((0..3).all(|index| !step(index).checks_redundant_rows()));
        assert!(step(2).bodies().eq(["coupler", "rocker"]) && step(2).joints().eq(["A", "B", "D"]));
        assert!(step(0).bodies().eq(["crank"]) && step(0).joints().eq(["drive"]));
    }
}
