//! The solution plan: q, q̇ and q̈ block by block, in closed form where one exists.
//!
//! The plan is found at compile time, and its steps are generated code ([`Mechanism::solve_with`]);
//! [`Model::plan`](crate::model::Model::plan) describes it step by step. Its evaluation needs neither `std` nor an
//! allocator.
//!
//! [`Mechanism::solve_with`]: crate::Mechanism::solve_with

use crate::scalar::Scalar;
use kin_core::vocabulary::UnknownKind;

mod text;

pub use kin_core::vocabulary::{Depth, StepKind};

/// The slices into which a solution is written.
#[doc(hidden)]
#[derive(Debug)]
pub struct Solved<'a, T> {
    /// q, n numbers.
    pub q: &'a mut [T],
    /// q̇, n numbers.
    pub q_dot: &'a mut [T],
    /// q̈, n numbers.
    pub q_ddot: &'a mut [T],
    /// The margins of the plan's steps, [`Plan::margins`] numbers: 1 far from all limits, 0 at a limit or where the
    /// step is singular, negative beyond a limit. The solution is valid only if all of them are positive.
    pub margins: &'a mut [T],
}

/// A plan: its steps in order, and its assembly modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// The steps, in the order in which they are solved; empty without a plan.
    pub steps: &'static [PlanStep],
    /// The assembly modes.
    pub modes: &'static [ModeInfo],
    /// The groups whose determinant has a sign that distinguishes branches: those that are solved by iteration, and
    /// linear systems that are singular for some configurations, where their solution goes to infinity. Unlike a mode,
    /// this sign cannot be requested.
    pub orientations: &'static [ModeInfo],
    /// The number of groups that are solved by iteration; they come first in `orientations`.
    pub iterations: usize,
    /// The number of margins of a solution.
    pub margins: usize,
    /// The reason why there is no plan.
    pub absent: Option<&'static str>,
}

/// A step of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanStep {
    /// Its kind.
    pub kind: StepKind,
    /// The redundant rows that it checks, indices of [`Model::rows`](crate::model::Model::rows); empty for other steps.
    pub rows: &'static [usize],
    /// Its kinematic group, `RRR` or `RRP` for example, if it is a dyad.
    pub group: &'static str,
    /// Its joints, indices of [`Model::joints`](crate::model::Model::joints).
    pub joints: &'static [usize],
    /// The coordinates that it determines, indices of q, each with the index of the joint that determines it.
    pub coordinates: &'static [(usize, usize)],
    /// Its modes: the first index in [`Plan::modes`] and one past the last.
    pub modes: (usize, usize),
    /// Its margins: the first index and one past the last.
    pub margins: (usize, usize),
    /// When it is singular, in words.
    pub singular: &'static str,
}

impl PlanStep {
    /// True if its unknowns are the solution of a linear system.
    pub(crate) fn is_linear(&self) -> bool {
        matches!(self.kind, StepKind::Explicit | StepKind::Linear(_))
    }

    /// The unknowns of its iteration, as in `coordinates`; empty for a step that does not iterate.
    #[inline(always)]
    pub(crate) fn unknowns(&self) -> &'static [(usize, usize)] {
        match self.kind {
            StepKind::Newton(unknowns) => self.coordinates.get(..unknowns).unwrap_or_default(),
            _ => &[],
        }
    }
}

/// An assembly mode: a group that closes in two ways, which a sign distinguishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeInfo {
    /// The names of its joints, joined with `-`.
    pub name: &'static str,
    /// Its step, an index of [`Plan::steps`].
    pub step: usize,
    /// Its margin, an index among the margins of a solution.
    pub margin: usize,
}

impl Plan {
    /// The margin that every step of a solution must exceed. The error of a closure grows with the inverse square root
    /// of its margin: at this margin about ten digits are left, and the sign of its mode is still certain.
    pub const SMALLEST_MARGIN: f64 = 1e-12;

    /// The residual of a redundant row, relative to the size of the mechanism and of its motion, at which its margin is
    /// 0. Near limits of other steps it is larger, because rounding errors grow there.
    pub const CONSISTENCY: f64 = 3e-11;

    /// No plan, with the reason.
    pub const fn absent(why: &'static str) -> Self {
        Self { steps: &[], modes: &[], orientations: &[], iterations: 0, margins: 0, absent: Some(why) }
    }

    /// The number of signs that distinguish the branches of the motion: one for every mode, then one for every
    /// orientation.
    pub const fn signs(&self) -> usize {
        self.modes.len() + self.orientations.len()
    }

    /// The index of the margin of a group, from the index of its sign: the root of this margin is the distance of the
    /// group from the limit at which the sign changes.
    pub(crate) fn margin_of_group(&self, group: usize) -> Option<usize> {
        let oriented = || self.orientations.get(group - self.modes.len());
        self.modes.get(group).or_else(oriented).map(|info| info.margin)
    }

    /// The index of the sign of the group to which a margin belongs; `None` for other margins.
    pub(crate) fn group_of_margin(&self, margin: usize) -> Option<usize> {
        self.modes.iter().chain(self.orientations).position(|info| info.margin == margin)
    }

    /// True if a step is solved by iteration.
    pub(crate) const fn iterates(&self) -> bool {
        self.iterations > 0
    }

    /// The coordinates that are unknowns of iterations.
    #[inline(always)]
    pub(crate) fn iterated_coordinates(&self) -> impl Iterator<Item = usize> + use<> {
        let steps = if self.iterates() { self.steps } else { &[] };
        steps.iter().flat_map(PlanStep::unknowns).map(|(k, _)| *k)
    }

    /// True if a linear step may be singular for some configurations.
    pub(crate) const fn has_poles(&self) -> bool {
        self.orientations.len() > self.iterations
    }

    /// True if there is a plan.
    pub const fn exists(&self) -> bool {
        self.absent.is_none()
    }

    /// The redundant rows that the plan leaves out and checks, indices of [`Model::rows`](crate::model::Model::rows).
    pub fn redundant_rows(&self) -> impl Iterator<Item = usize> + use<> {
        self.steps.iter().flat_map(|step: &'static PlanStep| step.rows).copied()
    }

    /// True if there are redundant rows.
    pub fn has_redundant_rows(&self) -> bool {
        self.redundant_rows().next().is_some()
    }

    /// The step that a margin belongs to.
    pub fn step_of_margin(&self, margin: usize) -> Option<usize> {
        self.steps.iter().position(|step| (step.margins.0..step.margins.1).contains(&margin))
    }
}

/// A correction this small, for an unknown of size 1, is the last one: the next would be about its square, which is below
/// rounding. The rounding of a larger unknown is proportional to its size, and so is the square of its last correction.
pub(crate) const LAST_CORRECTION: f64 = 3e-9;

/// A correction this small, for an unknown of size 1, is a rounding error.
const ROUNDING: f64 = 1e-13;

/// [`LAST_CORRECTION`] and [`ROUNDING`] for a scalar with this machine precision: the first is proportional to its square
/// root, the second to itself.
const fn last_and_rounding(epsilon: f64) -> [f64; 2] {
    let coarse = epsilon / f64::EPSILON;
    // The square root by Heron's method, which is exact for 1.
    let (mut root, mut k) = (1.0, 0);
    while k < 60 {
        root = 0.5 * (root + coarse / root);
        k += 1;
    }
    [LAST_CORRECTION * root, ROUNDING * coarse]
}

/// The square of the ratio of the scalar's machine precision to that of `f64`.
#[doc(hidden)]
#[inline(always)]
pub const fn coarseness<T: Scalar>() -> f64 {
    let coarse = T::EPSILON / f64::EPSILON;
    coarse * coarse
}

/// Largest last correction of a scalar, relative to its size. The one after it is about k times its square, where 1/k is
/// the unit in which the scalar is of the order of 1.
const LAST_CORRECTION_OF_SCALAR: f64 = 3e-7;

/// Newton's iteration over the unknowns `places` of `x`, of these `kinds`: `correction` gives, for the current values, the
/// numbers to be subtracted. If it does not converge, `x` is left unchanged. Returns 1 if it has converged, otherwise 0.
#[doc(hidden)]
#[inline(always)]
pub fn iterate<T: Scalar, const N: usize, const M: usize>(
    x: &mut [T; N],
    places: [usize; M],
    kinds: [UnknownKind; M],
    mut correction: impl FnMut(&[T; N]) -> [T; M],
) -> T {
    let [last_step, rounding_step] = const { last_and_rounding(T::EPSILON) };
    let (mut rounding, start) = (false, *x);
    for _ in 0..T::CORRECTIONS {
        let steps = correction(x);
        // Never 0, so that the iteration also converges if all lengths are 0.
        let mut length = T::from_f64(f64::from(f32::MIN_POSITIVE));
        for ((index, step), kind) in places.into_iter().zip(steps).zip(kinds) {
            x[index] = x[index] - step;
            if kind == UnknownKind::Length {
                length = length + x[index].abs();
            }
        }
        let mut last = true;
        rounding = true;
        for ((index, step), kind) in places.into_iter().zip(steps).zip(kinds) {
            let size = x[index].abs();
            let relative = step / (T::from_f64(1.0) + size);
            last &= match kind {
                UnknownKind::Length => relative.is_within(last_step) && (step / length).is_within(last_step),
                UnknownKind::Angle => (step * relative).is_within(last_step * last_step),
                UnknownKind::Scalar => {
                    let allowed = T::from_f64(LAST_CORRECTION_OF_SCALAR * last_step / LAST_CORRECTION) * size
                        + T::from_f64(rounding_step);
                    (step * relative).is_within(last_step * last_step) && (step / allowed).is_within(1.0)
                }
            };
            rounding &= relative.is_within(rounding_step);
        }
        if last {
            return T::from_f64(1.0);
        }
    }
    // For scalars that cannot be compared (intervals, series) all corrections were taken, more than convergence needs.
    let cannot_tell = !T::from_f64(0.0).is_within(1.0);
    // A single length that passes through 0 has no size to be compared with, so `rounding` suffices.
    if rounding || cannot_tell {
        return T::from_f64(1.0);
    }
    // Later steps of the plan need finite numbers.
    *x = start;
    T::from_f64(0.0)
}
