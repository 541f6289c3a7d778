//! The steps of a plan as they are reported: which joint gives which coordinate, and by which method.

use crate::vocabulary::StepKind;
use std::collections::BTreeSet;

/// A step, as an index of [`SolutionPlan::steps`](super::SolutionPlan::steps).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct StepId(pub(super) usize);

impl StepId {
    /// The index of the step.
    pub const fn index(self) -> usize {
        self.0
    }

    /// The number of the step, counted from 1.
    pub const fn number(self) -> usize {
        self.0 + 1
    }
}

/// A step of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The kind of step.
    pub kind: StepKind,
    /// For a dyad, the letters of its joints: `RRR`, `RRP`, …; empty otherwise.
    pub group: String,
    /// The joints of the step; for a dyad, in order from one end to the other.
    pub joints: Vec<usize>,
    /// The coordinates that the step gives, each with the joint whose row gives it.
    pub coordinates: Vec<(u32, usize)>,
    /// The modes of the step, as indices of [`SolutionPlan::modes`](super::SolutionPlan::modes).
    pub modes: core::ops::Range<usize>,
    /// The margins of the step, as indices of the margins of a solution.
    pub margins: core::ops::Range<usize>,
    /// The configuration in which the step is singular, in words.
    pub singular: String,
    /// The rows of Φ that the step uses.
    pub rows: BTreeSet<usize>,
    /// The bodies of the group, needed only until the group is named.
    pub(super) bodies: BTreeSet<usize>,
    /// The dyad letters of the closed form of the step, from the equations alone.
    pub(super) closed_as: Option<&'static str>,
}

/// An assembly mode: the sign that selects one of the two solutions of a group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mode {
    /// The names of the group's joints, joined with `-`.
    pub name: String,
    /// The step that has this mode.
    pub step: StepId,
    /// The index of the margin that is 0 where both solutions coincide.
    pub margin: usize,
}
