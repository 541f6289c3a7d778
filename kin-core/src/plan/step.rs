//! The steps of a plan in words: which joint gives which coordinate, and how.

use crate::vocabulary::StepKind;
use std::collections::BTreeSet;

/// A step by its place in [`SolutionPlan::steps`](super::SolutionPlan::steps).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct StepId(pub(super) usize);

impl StepId {
    /// Its place.
    pub const fn index(self) -> usize {
        self.0
    }

    /// Its number, as people count steps.
    pub const fn number(self) -> usize {
        self.0 + 1
    }
}

/// A step of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// What kind.
    pub kind: StepKind,
    /// Its kinematic group where it is a dyad: `RRR`, `RRP`, …; empty otherwise.
    pub group: String,
    /// Its joints, along the group where it is a dyad.
    pub joints: Vec<usize>,
    /// The coordinates that it gives, each with the joint whose row gives it.
    pub coordinates: Vec<(u32, usize)>,
    /// Its modes, as places in [`SolutionPlan::modes`](super::SolutionPlan::modes).
    pub modes: core::ops::Range<usize>,
    /// Its margins, as places among those of a solution.
    pub margins: core::ops::Range<usize>,
    /// When it is singular.
    pub singular: String,
    /// The rows of Φ that it is made of.
    pub rows: BTreeSet<usize>,
    /// The bodies of its group, while it is being named.
    pub(super) bodies: BTreeSet<usize>,
    /// What its equations are, whatever they were written as.
    pub(super) closed_as: Option<&'static str>,
}

/// An assembly mode: a group that closes in two ways, told apart by a sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mode {
    /// The names of its joints, joined with `-`.
    pub name: String,
    /// Its step.
    pub step: StepId,
    /// Its margin.
    pub margin: usize,
}
