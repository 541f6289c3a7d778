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
//! Any other part is halved, and the plan is solved in its middle. Where velocities are integrated, a pulse need not exceed
//! the range of g to move the mechanism. There the step is divided into 16 parts from the beginning, and ½ replaces 8. If
//! the enclosures of many parts are about as wide, they are wider than the function, as where it nearly rests, and tell
//! nothing. Supplied functions are enclosed by themselves ([`ScalarFunction::enclose`](crate::ScalarFunction::enclose)), or
//! not at all.

use super::inputs::write_inputs_within;
use super::interior::{IRREGULAR_FRACTIONS, on_cubic};
use super::parts::{Span, divide, hull};
use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// The largest number of parts of the same length that are looked at.
const PARTS: usize = 16;

/// Widths of an enclosure up to this hide nothing, relative to the function.
const NEGLIGIBLE_WIDTH: f64 = 1e-9;

/// How finely the functions in a step are enclosed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Resolution {
    /// The number of parts into which the step is divided at first.
    parts: usize,
    /// Widths of an enclosure up to this hide nothing, relative to the range of the function in the step.
    usual_width: f64,
}

impl Resolution {
    /// For positions that follow from those at the end of the step.
    pub(crate) const OF_POSITIONS: Self = Self { parts: 2, usual_width: 8.0 };
    /// For velocities that are integrated over the step.
    #[cfg(feature = "std")]
    pub(crate) const OF_VELOCITIES: Self = Self { parts: PARTS, usual_width: 0.5 };
}

/// A function that has no enclosure even over a part as short as this, in the middle of the step, has none at all.
const MIN_PART: f64 = 1e-6;

/// Where the range is measured: at the ends of the step and at the middle one of the places at which it is looked into.
const MEASURED: [f64; 3] = [0.0, IRREGULAR_FRACTIONS[3], 1.0];

/// True if `is_near` is true wherever known functions may have a narrow feature within a step, whose first and last
/// instants are given.
#[cold]
#[inline(never)]
pub(crate) fn narrow_curves_are_followed<M: Mechanism>(
    mechanism: &M,
    parameters: &[f64],
    [from, to]: [&Instant<'_>; 2],
    span: Span<'_>,
    resolution: Resolution,
    is_near: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<bool, LengthError> {
    let nothing = M::KnownCurves::<f64>::filled(0.0);
    if nothing.as_ref().is_empty() {
        return Ok(true);
    }
    let [least, most] = range_of_curves(mechanism, parameters, [from, to], span)?;
    let ranges = [least.as_ref(), most.as_ref()];
    let known: M::Parameters<Interval> = Array::generate(Interval::ZERO, |k| Interval::from_f64(parameters[k]));
    let mut inputs = M::Inputs::<Interval>::filled(Signal::constant(Interval::ZERO));
    let mut box_of_part = M::Coordinates::<Interval>::filled(Interval::ZERO);
    let mut enclosures = M::KnownCurves::<Interval>::filled(Interval::ZERO);
    let mut write_excesses = |start: f64, width: f64, excesses: &mut [f64]| -> Result<(), LengthError> {
        hull(box_of_part.as_mut(), span, start, width);
        let place = Interval::new(start, start + width);
        write_inputs_within(inputs.as_mut(), [from.inputs, to.inputs], place, Interval::from_f64);
        let [first, last] = [Interval::from_f64(from.t), Interval::from_f64(to.t)];
        let at = Instant { t: first + place * (last - first), inputs: inputs.as_ref() };
        mechanism.known_curves_with(known.as_ref(), &at, box_of_part.as_ref(), enclosures.as_mut())?;
        for (function, x) in supplied(M::FUNCTIONS_IN_CURVES, enclosures.as_mut()) {
            *x = mechanism.enclose_function(function, *x);
        }
        write_ratios(excesses, enclosures.as_ref(), ranges, resolution.usual_width);
        Ok(())
    };
    let [mut whole, mut in_the_middle, mut of_part] = [nothing; 3];
    write_excesses(0.0, 1.0, whole.as_mut())?;
    if largest_known(whole.as_ref(), nothing.as_ref()) <= 1.0 {
        return Ok(true);
    }
    if !M::FUNCTIONS_IN_CURVES.is_empty() {
        write_excesses(0.5, MIN_PART, in_the_middle.as_mut())?;
        // A formula without a value there has a gap.
        let formulas = nothing.as_ref().len() - M::FUNCTIONS_IN_CURVES.len();
        in_the_middle.as_mut()[..formulas].fill(0.0);
    }
    let in_the_middle = in_the_middle.as_ref();
    if largest_known(whole.as_ref(), in_the_middle) <= 1.0 {
        return Ok(true);
    }
    let mut excess = |start: f64, width: f64| -> Result<f64, LengthError> {
        write_excesses(start, width, of_part.as_mut())?;
        Ok(largest_known(of_part.as_ref(), in_the_middle))
    };
    Ok(divide([resolution.parts, PARTS], &mut excess, is_near)?.unwrap_or(true))
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
    let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
    for s in MEASURED {
        on_cubic(q.as_mut(), span.ends, span.h, s);
        write_inputs_within(inputs.as_mut(), [from.inputs, to.inputs], s, f64::from);
        let at = Instant { t: from.t + s * (to.t - from.t), inputs: inputs.as_ref() };
        mechanism.known_curves_with(parameters, &at, q.as_ref(), curves.as_mut())?;
        for (function, x) in supplied(M::FUNCTIONS_IN_CURVES, curves.as_mut()) {
            let is_enclosed = mechanism.enclose_function(function, Interval::from(*x)).is_defined();
            let values = if is_enclosed { mechanism.evaluate_function(function, *x) } else { None };
            *x = match values {
                Some([value, ..]) => value,
                None => f64::NAN,
            };
        }
        widen([least.as_mut(), most.as_mut()], curves.as_ref());
    }
    Ok([least, most])
}

/// Widens ranges by one more value of each; NaN does not count.
fn widen([least, most]: [&mut [f64]; 2], values: &[f64]) {
    least.iter_mut().zip(values).for_each(|(least, value)| *least = value.min(*least));
    most.iter_mut().zip(values).for_each(|(most, value)| *most = value.max(*most));
}

/// Writes the widths of enclosures relative to those which hide nothing; infinity where one of them is not known.
fn write_ratios(excesses: &mut [f64], enclosures: &[Interval], [least, most]: [&[f64]; 2], usual_width: f64) {
    for ((excess, enclosure), (least, most)) in excesses.iter_mut().zip(enclosures).zip(least.iter().zip(most)) {
        let usual = usual_width * (most - least) + NEGLIGIBLE_WIDTH * least.abs().max(most.abs()) + f64::MIN_POSITIVE;
        let ratio = (enclosure.upper() - enclosure.lower()) / usual;
        *excess = if ratio.is_nan() { f64::INFINITY } else { ratio };
    }
}

/// The largest excess of those functions which have an enclosure in the middle of the step.
fn largest_known(excesses: &[f64], in_the_middle: &[f64]) -> f64 {
    let known = excesses.iter().zip(in_the_middle).filter(|(_, middle)| middle.is_finite());
    known.fold(0.0, |most, (excess, _)| excess.max(most))
}

/// The supplied functions among known curves, with the places of their arguments, which are the last ones.
fn supplied<'a, V>(functions: &'a [usize], curves: &'a mut [V]) -> impl Iterator<Item = (usize, &'a mut V)> {
    let first = curves.len() - functions.len();
    functions.iter().copied().zip(&mut curves[first..])
}
