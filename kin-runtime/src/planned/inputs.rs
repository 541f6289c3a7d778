//! Lists of inputs: copies, their values within a step, and their lanes.
//!
//! These functions are not generic over the mechanism, so that they are compiled once for all.

use crate::scalar::Scalar;
use crate::scalar::compare::Compare;
use crate::signal::Signal;

/// Copies inputs; a shorter list leaves the rest.
#[inline]
pub(super) fn copy_inputs(to: &mut [Signal], inputs: &[Signal]) {
    to.iter_mut().zip(inputs).for_each(|(to, from)| *to = *from);
}

/// Writes the inputs at the fraction s of a step, between their values at both ends; `number` converts these.
pub(crate) fn write_inputs_within<E: Copy, V: Scalar>(
    inputs: &mut [Signal<V>],
    [from, to]: [&[Signal<E>]; 2],
    s: V,
    number: fn(E) -> V,
) {
    for (input, (from, to)) in inputs.iter_mut().zip(from.iter().zip(to)) {
        let first = number(from.value);
        let last = Signal { value: number(to.value), rate: number(to.rate), acceleration: number(to.acceleration) };
        *input = Signal { value: first + s * (last.value - first), ..last };
    }
}

/// Writes inputs that all lanes share to all of them.
pub(super) fn spread_inputs<V: Compare>(to: &mut [Signal<V>], inputs: &[Signal]) {
    to.iter_mut().zip(inputs).for_each(|(to, input)| *to = input.map(V::from_f64));
}

/// Writes one lane of every input.
pub(crate) fn write_lane_of_inputs<V: Compare>(to: &mut [Signal], inputs: &[Signal<V>], lane: usize) {
    to.iter_mut().zip(inputs).for_each(|(to, input)| *to = input.map(|x| x.lane(lane)));
}
