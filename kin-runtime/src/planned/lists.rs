//! Lists with one number per group, or per margin, of a mechanism's plan.
//!
//! The plan determines their length. They are stored in arrays as long as the mechanism's coordinates or rows, which is
//! always sufficient.

use crate::mechanism::{LengthError, Mechanism};
use crate::plan::Plan;
use crate::scalar::Scalar;
use crate::scalar::compare::{Compare, all_above, write_lane};
use crate::signal::Instant;
use crate::workspace::Array;

macro_rules! list {
    ($(#[$doc:meta])* $Name:ident in $Room:ident, as many as |$plan:ident| $count:expr) => {
        $(#[$doc])*
        pub(crate) struct $Name<M: Mechanism, T: Scalar = f64>(M::$Room<T>);

        impl<M: Mechanism, T: Scalar> Clone for $Name<M, T> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<M: Mechanism, T: Scalar> Copy for $Name<M, T> {}

        impl<M: Mechanism, T: Scalar> $Name<M, T> {
            /// A list with the same number everywhere.
            #[inline(always)]
            pub(crate) fn filled(value: T) -> Self {
                Self(Array::filled(value))
            }

            #[inline(always)]
            fn count() -> usize {
                let $plan: &Plan = &M::model().plan;
                $count
            }
        }

        impl<M: Mechanism, T: Scalar> AsRef<[T]> for $Name<M, T> {
            #[inline(always)]
            fn as_ref(&self) -> &[T] {
                &self.0.as_ref()[..Self::count()]
            }
        }

        impl<M: Mechanism, T: Scalar> AsMut<[T]> for $Name<M, T> {
            #[inline(always)]
            fn as_mut(&mut self) -> &mut [T] {
                &mut self.0.as_mut()[..Self::count()]
            }
        }
    };
}

list! {
    /// The signs of all groups, ±1: first the modes of those that close in two ways, then the orientations of those
    /// whose determinant has a sign. NaN for an undecided sign, so that everything that depends on it is NaN, too.
    Modes in Coordinates, as many as |plan| plan.signs()
}

list! {
    /// The branch values w of all groups, whose signs distinguish their branches.
    BranchValues in Coordinates, as many as |plan| plan.signs()
}

list! {
    /// |w| of all groups: the distance of each from the configuration at which its sign changes, at most 1.
    Distances in Coordinates, as many as |plan| plan.signs()
}

list! {
    /// The margins of all steps of the plan: the distance from singularity, 0 where a step is singular, negative where
    /// it has no solution, at most 1.
    Margins in Rows, as many as |plan| plan.margins
}

impl<M: Mechanism, T: Scalar> BranchValues<M, T> {
    /// The branch values of a configuration.
    #[inline]
    pub(crate) fn at(mechanism: &M, parameters: &[T], at: &Instant<'_, T>, q: &[T]) -> Result<Self, LengthError> {
        let mut branch_values = Self::filled(T::from_f64(0.0));
        mechanism.branches_with(parameters, at, q, branch_values.as_mut())?;
        Ok(branch_values)
    }
}

impl<M: Mechanism, V: Compare> BranchValues<M, V> {
    /// The signs.
    #[inline]
    pub(crate) fn modes(&self) -> Modes<M, V> {
        let mut modes = Modes::filled(V::from_f64(0.0));
        write_directions(self.as_ref(), modes.as_mut());
        modes
    }
}

impl<M: Mechanism, T: Scalar> Modes<M, T> {
    /// The modes of the groups that close in two ways, which are arguments of the plan.
    #[inline(always)]
    pub(crate) fn of_closures(&self) -> &[T] {
        &self.0.as_ref()[..M::model().plan.modes.len()]
    }

    /// As [`of_closures`](Self::of_closures), mutable.
    #[inline(always)]
    pub(crate) fn of_closures_mut(&mut self) -> &mut [T] {
        &mut self.0.as_mut()[..M::model().plan.modes.len()]
    }
}

impl<M: Mechanism> Modes<M> {
    /// The modes of one lane.
    pub(crate) fn lane_of<V: Compare>(modes: &Modes<M, V>, lane: usize) -> Self {
        let mut modes_of_lane = Self::filled(0.0);
        write_lane(modes_of_lane.as_mut(), modes.as_ref(), lane);
        modes_of_lane
    }
}

impl<M: Mechanism, V: Compare> Margins<M, V> {
    /// The smallest margin, at most 1; NaN is ignored.
    #[cfg(any(feature = "std", all(feature = "simd", feature = "alloc")))]
    #[inline(always)]
    pub(crate) fn least(&self) -> V {
        least_of(self.as_ref())
    }

    /// Writes |w| of every group; returns the smallest.
    #[inline(always)]
    pub(crate) fn write_distances(&self, distances: &mut Distances<M, V>) -> V {
        write_roots(&M::model().plan, self.as_ref(), distances.as_mut())
    }
}

impl<M: Mechanism> Margins<M> {
    /// True where all margins are large enough for the solution to be valid.
    #[inline]
    pub(crate) fn are_good(&self) -> bool {
        all_above(self.as_ref(), Plan::SMALLEST_MARGIN)
    }

    /// The index of the first margin that is too small.
    pub(crate) fn first_bad(&self) -> Option<usize> {
        first_small(self.as_ref())
    }
}

// These functions are not generic over the mechanism, so that they are compiled once for all. Batches call them with
// lanes, in code compiled for one instruction set, into which they must be inlined.

/// Writes the signs of branch values.
#[inline(always)]
fn write_directions<V: Compare>(branch_values: &[V], modes: &mut [V]) {
    modes.iter_mut().zip(branch_values).for_each(|(mode, closure)| *mode = closure.direction());
}

/// The smallest number, at most 1; NaN is ignored.
#[cfg(any(feature = "std", all(feature = "simd", feature = "alloc")))]
#[inline(always)]
fn least_of<V: Compare>(margins: &[V]) -> V {
    margins.iter().fold(V::from_f64(1.0), |least, margin| least.least(*margin))
}

/// Writes the root of the margin of every group; returns the smallest, at most 1.
#[inline(always)]
fn write_roots<V: Compare>(plan: &Plan, margins: &[V], distances: &mut [V]) -> V {
    let mut least = V::from_f64(1.0);
    for (group, distance) in distances.iter_mut().enumerate() {
        let Some(margin) = plan.margin_of_group(group) else { continue };
        *distance = margins[margin].abs().sqrt();
        least = least.least(*distance);
    }
    least
}

/// The index of the first margin that is too small for the solution to be valid.
fn first_small(margins: &[f64]) -> Option<usize> {
    margins.iter().position(|margin| *margin <= Plan::SMALLEST_MARGIN)
}

#[cfg(test)]
mod tests {
    use super::{Distances, Margins, Modes};
    use crate::fixture::PlannedFourBar;

    #[test]
    fn a_group_is_as_far_from_its_limit_as_the_root_of_its_margin() {
        let of = |margin: f64| {
            let (margins, mut found) = (Margins::<PlannedFourBar>::filled(margin), Distances::filled(7.0));
            let least = margins.write_distances(&mut found);
            assert_eq!([least], found.as_ref());
            least
        };
        assert_eq!([0.3, 0.7], [of(0.09), of(0.49)]);
        // Just beyond its limit a group has the same distance as just before.
        assert_eq!(0.3, of(-0.09));
        let farther = Margins::<PlannedFourBar>::filled(4.0).write_distances(&mut Distances::filled(0.0));
        assert_eq!(1.0, farther, "it is never farther than 1");
    }

    #[test]
    fn margins_are_good_above_the_smallest() {
        for (margin, good) in [(1.0, true), (2e-12, true), (1e-12, false), (0.0, false), (-3.0, false)] {
            let margins = Margins::<PlannedFourBar>::filled(margin);
            assert_eq!((good, (!good).then_some(0)), (margins.are_good(), margins.first_bad()), "{margin}");
        }
        let unknown = Margins::<PlannedFourBar>::filled(f64::NAN);
        assert_eq!((false, None), (unknown.are_good(), unknown.first_bad()));
    }

    #[test]
    fn lists_are_as_long_as_the_plan_says() {
        let modes = Modes::<PlannedFourBar>::filled(1.0);
        assert_eq!([1, 1], [modes.as_ref().len(), modes.of_closures().len()]);
        assert_eq!(1, Margins::<PlannedFourBar>::filled(1.0).as_ref().len());
    }
}
