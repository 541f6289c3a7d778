//! Narrow features of known functions within a step.
//!
//! A function g of time, of inputs or of a single coordinate may have a peak, a pole or a gap between two places within a
//! step at which the plan is solved (see [`hidden_motion`](super::hidden_motion)). Therefore g is enclosed over parts of
//! the step, in interval arithmetic. A part hides nothing if
//!
//! ```text
//! width of the enclosure of g ≤ 8 · range of g at the ends and near the middle of the step + 10⁻⁹ |g|
//! ```
//!
//! Any other part is halved, and the plan is solved in its middle. If the enclosures of many parts are about as wide, they
//! are wider than the function, as where it nearly rests, and tell nothing. Supplied functions are enclosed by themselves
//! ([`ScalarFunction::enclose`](crate::ScalarFunction::enclose)), or not at all.

use super::interior::{FRACTIONS, input_within, on_cubic};
use super::parts::{Span, halve, hull};
use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// The largest number of parts of the same length that are looked at.
const PARTS: usize = 16;

/// Widths of an enclosure up to this hide nothing, relative to the range of the function in the step, and to the function.
const USUAL: f64 = 8.0;
const NEGLIGIBLE: f64 = 1e-9;

/// A function that has no enclosure even over a part as short as this, in the middle of the step, has none at all.
const SHORTEST: f64 = 1e-6;

/// Where the range is measured: at the ends of the step and at the middle one of the places at which it is looked into.
const MEASURED: [f64; 3] = [0.0, FRACTIONS[3], 1.0];

/// True if `is_near` is true wherever known functions may have a narrow feature within a step, whose first and last
/// instants are given.
#[cold]
#[inline(never)]
pub(crate) fn narrow_curves_are_followed<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    [from, to]: [&Instant<'_>; 2],
    span: Span<'_>,
    is_near: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<bool, LengthError> {
    let zero = M::KnownCurves::<f64>::filled(0.0);
    if zero.as_ref().is_empty() {
        return Ok(true);
    }
    let [least, most] = range_of_curves(mechanism, parameters, [from, to], span)?;
    let known: M::Parameters<Interval> = Array::generate(Interval::ZERO, |k| Interval::from_f64(parameters[k]));
    let mut box_of_part = M::Coordinates::<Interval>::filled(Interval::ZERO);
    let mut enclosures = M::KnownCurves::<Interval>::filled(Interval::ZERO);
    let mut in_the_middle = M::KnownCurves::<f64>::filled(0.0);
    let mut excesses = |start: f64, width: f64| -> Result<M::KnownCurves<f64>, LengthError> {
        hull(box_of_part.as_mut(), span, start, width);
        let place = Interval::new(start, start + width);
        let inputs = inputs_within::<M, Interval>([from, to], place);
        let [first, last] = [from.t, to.t].map(Interval::from_f64);
        let at = Instant { t: first + place * (last - first), inputs: inputs.as_ref() };
        mechanism.known_curves_with(known.as_ref(), &at, box_of_part.as_ref(), enclosures.as_mut())?;
        for (function, x) in supplied(M::FUNCTIONS_IN_CURVES, enclosures.as_mut()) {
            *x = mechanism.enclose_function(function, *x);
        }
        Ok(M::KnownCurves::<f64>::generate(0.0, |k| {
            let (enclosure, [least, most]) = (enclosures.as_ref()[k], [least.as_ref()[k], most.as_ref()[k]]);
            let usual = USUAL * (most - least) + NEGLIGIBLE * least.abs().max(most.abs()) + f64::MIN_POSITIVE;
            let excess = (enclosure.upper() - enclosure.lower()) / usual;
            if excess.is_nan() { f64::INFINITY } else { excess }
        }))
    };
    let whole = excesses(0.0, 1.0)?;
    if whole.as_ref().iter().all(|excess| *excess <= 1.0) {
        return Ok(true);
    }
    if !M::FUNCTIONS_IN_CURVES.is_empty() {
        in_the_middle = excesses(0.5, SHORTEST)?;
        // A formula without a value there has a gap.
        let formulas = zero.as_ref().len() - M::FUNCTIONS_IN_CURVES.len();
        in_the_middle.as_mut()[..formulas].fill(0.0);
    }
    let is_known = |(k, excess): (usize, &f64)| *excess > 1.0 && in_the_middle.as_ref()[k].is_finite();
    if !whole.as_ref().iter().enumerate().any(is_known) {
        return Ok(true);
    }
    let mut excess = |start: f64, width: f64| -> Result<f64, LengthError> {
        let excesses = excesses(start, width)?;
        let known = excesses.as_ref().iter().zip(in_the_middle.as_ref()).filter(|(_, middle)| middle.is_finite());
        Ok(known.fold(0.0, |most, (excess, _)| excess.max(most)))
    };
    Ok(halve(PARTS, &mut excess, is_near)?.unwrap_or(true))
}

/// The least and the largest value of every curve in a step; NaN for supplied functions that do not enclose their values.
fn range_of_curves<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    [from, to]: [&Instant<'_>; 2],
    span: Span<'_>,
) -> Result<[M::KnownCurves<f64>; 2], LengthError> {
    let nothing = M::KnownCurves::<f64>::filled(f64::NAN);
    let ([mut least, mut most], mut curves) = ([nothing; 2], nothing);
    let mut q = M::Coordinates::<f64>::filled(0.0);
    for s in MEASURED {
        on_cubic(q.as_mut(), span.ends, span.h, s);
        let inputs = inputs_within::<M, f64>([from, to], s);
        let at = Instant { t: from.t + s * (to.t - from.t), inputs: inputs.as_ref() };
        mechanism.known_curves_with(parameters, &at, q.as_ref(), curves.as_mut())?;
        for (function, x) in supplied(M::FUNCTIONS_IN_CURVES, curves.as_mut()) {
            let is_enclosed = mechanism.enclose_function(function, Interval::from(*x)).is_defined();
            let value = if is_enclosed { mechanism.evaluate_function(function, *x) } else { None };
            *x = value.map_or(f64::NAN, |[f, ..]| f);
        }
        for (k, curve) in curves.as_ref().iter().enumerate() {
            // The other number where one is NaN.
            least.as_mut()[k] = curve.min(least.as_ref()[k]);
            most.as_mut()[k] = curve.max(most.as_ref()[k]);
        }
    }
    Ok([least, most])
}

/// The supplied functions among known curves, with the places of their arguments, which are the last ones.
fn supplied<'a, V>(functions: &'a [usize], curves: &'a mut [V]) -> impl Iterator<Item = (usize, &'a mut V)> {
    let first = curves.len() - functions.len();
    functions.iter().copied().zip(&mut curves[first..])
}

/// The inputs at a fraction of a step.
fn inputs_within<M: Mechanism, V: Scalar>([from, to]: [&Instant<'_>; 2], s: V) -> M::Inputs<V> {
    M::Inputs::<V>::generate(Signal::constant(V::from_f64(0.0)), |k| {
        let [from, to] = [from, to].map(|at| at.inputs[k].map(V::from_f64));
        input_within([&from, &to], s)
    })
}
