//! The solution plan: q, q̇ and q̈ the way an expert would, block by block, in closed form where there is one.
//!
//! The plan is found at compile time and its steps are generated code ([`Mechanism::solve_with`]); what it is, step by
//! step, stands in [`Model::plan`](crate::model::Model::plan). This evaluation path needs no `std` and no allocator.
//!
//! [`Mechanism::solve_with`]: crate::Mechanism::solve_with

use crate::scalar::Scalar;

mod text;

pub use kin_core::vocabulary::{Depth, StepKind};

/// Where a solution is written.
#[doc(hidden)]
#[derive(Debug)]
pub struct Solved<'a, T> {
    /// q, n numbers.
    pub q: &'a mut [T],
    /// q̇, n numbers.
    pub q_dot: &'a mut [T],
    /// q̈, n numbers.
    pub q_ddot: &'a mut [T],
    /// The margins of the plan's steps, [`Plan::margins`] numbers: 1 far from trouble, 0 at a limit or where the step
    /// says nothing, negative beyond a limit. What is solved is only good where all of them are positive.
    pub margins: &'a mut [T],
}

/// A plan: its steps in order, and its assembly modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// The steps, in the order in which they are solved; empty where there is no plan.
    pub steps: &'static [PlanStep],
    /// The assembly modes.
    pub modes: &'static [ModeInfo],
    /// The groups that are solved by iteration: neighbouring solutions of each are told apart by the sign of the
    /// determinant of its own small system. Unlike modes they cannot be asked for.
    pub orientations: &'static [ModeInfo],
    /// How many margins a solution has.
    pub margins: usize,
    /// Why there is no plan.
    pub absent: Option<&'static str>,
}

/// A step of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanStep {
    /// What kind.
    pub kind: StepKind,
    /// The redundant rows that it watches, places in [`Model::rows`](crate::model::Model::rows); empty for other steps.
    pub rows: &'static [usize],
    /// Its kinematic group, `RRR` or `RRP` for example, where it is a dyad.
    pub group: &'static str,
    /// Places of its joints in [`Model::joints`](crate::model::Model::joints).
    pub joints: &'static [usize],
    /// The coordinates that it gives, places in q, each with the place of the joint that gives it.
    pub coordinates: &'static [(usize, usize)],
    /// Its modes: first place in [`Plan::modes`] and one past the last.
    pub modes: (usize, usize),
    /// Its margins: first place and one past the last.
    pub margins: (usize, usize),
    /// When it is singular, in words.
    pub singular: &'static str,
}

/// An assembly mode: a group that closes in two ways, told apart by a sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeInfo {
    /// The names of its joints, joined with `-`.
    pub name: &'static str,
    /// Its step, a place in [`Plan::steps`].
    pub step: usize,
    /// Its margin, a place among the margins of a solution.
    pub margin: usize,
}

impl Plan {
    /// The margin that every step of a solution must exceed. The error of a closure grows with the inverse root of its
    /// margin: at this one about ten digits are left, and the sign of its mode is still certain.
    pub const SMALLEST_MARGIN: f64 = 1e-12;

    /// By how much a redundant row may be missed, relative to the size of the mechanism and of its motion, before its
    /// margin is 0; beside limits of other steps it is more, as far as rounding grows there.
    pub const CONSISTENCY: f64 = 3e-11;

    /// No plan, and why.
    pub const fn absent(why: &'static str) -> Self {
        Self { steps: &[], modes: &[], orientations: &[], margins: 0, absent: Some(why) }
    }

    /// How many signs tell one branch of the motion from another: one for every mode, then one for every iteration.
    pub const fn signs(&self) -> usize {
        self.modes.len() + self.orientations.len()
    }

    /// The margin of a sign: its square root is how far the group is from where the sign changes.
    pub(crate) fn margin_of_sign(&self, sign: usize) -> Option<usize> {
        let of_iteration = || self.orientations.get(sign - self.modes.len());
        self.modes.get(sign).or_else(of_iteration).map(|info| info.margin)
    }

    /// True where there is a plan.
    pub const fn exists(&self) -> bool {
        self.absent.is_none()
    }

    /// The rows that the plan does without, places in [`Model::rows`](crate::model::Model::rows).
    pub fn watched(&self) -> impl Iterator<Item = usize> + use<> {
        self.steps.iter().flat_map(|step: &'static PlanStep| step.rows).copied()
    }

    /// The step that a margin belongs to.
    pub fn step_of_margin(&self, margin: usize) -> Option<usize> {
        self.steps.iter().position(|step| (step.margins.0..step.margins.1).contains(&margin))
    }
}

/// A correction this small, for an unknown of size 1, is the last: the next one is its square.
const LAST: f64 = 3e-9;

/// A correction this small, for an unknown of size 1, is rounding.
const ROUNDING: f64 = 1e-13;

/// [`LAST`] and [`ROUNDING`] for a scalar with this rounding: the one goes with its root, the other with itself.
const fn last_and_rounding(epsilon: f64) -> [f64; 2] {
    let coarse = epsilon / f64::EPSILON;
    // Its root by Heron's rule; that of 1 is exact.
    let (mut root, mut k) = (1.0, 0);
    while k < 60 {
        root = 0.5 * (root + coarse / root);
        k += 1;
    }
    [LAST * root, ROUNDING * coarse]
}

/// The square of how much coarser a scalar is than an `f64`.
#[doc(hidden)]
#[inline(always)]
pub const fn coarseness<T: Scalar>() -> f64 {
    let coarse = T::EPSILON / f64::EPSILON;
    coarse * coarse
}

/// Newton's iteration over the unknowns `places` of `x`: `correction` gives, for the current values, what is to be
/// subtracted. Where it does not converge, `x` is what it was. `lengths` says of each unknown whether it is a length: lengths are as large as all of them together, so
/// that a mechanism of micrometres is solved to the same digits in metres. Gives 1 where it has converged and 0 where not.
#[doc(hidden)]
#[inline]
pub fn iterate<T: Scalar, const N: usize, const M: usize>(
    x: &mut [T; N],
    places: [usize; M],
    lengths: [bool; M],
    mut correction: impl FnMut(&[T; N]) -> [T; M],
) -> T {
    let [last_step, rounding_step] = const { last_and_rounding(T::EPSILON) };
    let (mut rounding, start) = (false, *x);
    for _ in 0..T::CORRECTIONS {
        let steps = correction(x);
        // Never 0, so that lengths that are all 0 are found, too.
        let mut length = T::from_f64(f64::from(f32::MIN_POSITIVE));
        for ((place, step), is_length) in places.into_iter().zip(steps).zip(lengths) {
            x[place] = x[place] - step;
            if is_length {
                length = length + x[place].abs();
            }
        }
        let mut last = true;
        rounding = true;
        for ((place, step), is_length) in places.into_iter().zip(steps).zip(lengths) {
            let relative = step / (T::from_f64(1.0) + x[place].abs());
            last &= relative.is_within(last_step) && (!is_length || (step / length).is_within(last_step));
            rounding &= relative.is_within(rounding_step);
        }
        if last {
            return T::from_f64(1.0);
        }
    }
    // A scalar that cannot tell has gone through all corrections, which is more than convergence takes.
    let cannot_tell = !T::from_f64(0.0).is_within(1.0);
    // A length that passes through 0 alone has no size of its own to be compared with.
    if rounding || cannot_tell {
        return T::from_f64(1.0);
    }
    // What follows has numbers to compute with.
    *x = start;
    T::from_f64(0.0)
}
