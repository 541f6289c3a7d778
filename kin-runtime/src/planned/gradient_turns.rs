//! Bends of the rows between the ends of a step.
//!
//! A curve may be straight at both ends of a step and at every place between them that is looked at, and still bend
//! somewhere else; an iteration then finds a solution behind a dead centre. Therefore the turn of the gradients of
//! iterated rows is bounded over whole parts of the step, in interval arithmetic:
//!
//! ```text
//! turn ≤ max over k of (upper end of wₖ over the box) · (width of the box along k)
//! ```
//!
//! wₖ is the turn per unit of a coordinate ([`turns_with`](Mechanism::turns_with)), and the box contains the cubic
//! through both ends (see [`interior`](super::interior)) over the part. A part in which the gradients turn little hides
//! nothing. Any other part is halved, and the branch values are looked at in its middle; if the whole step is such a
//! part, they are also looked at in the usual places.

use super::inputs::write_inputs_within;
use super::interior::{certainty_between, even_fractions, on_cubic, time_within};
use super::lists::{BranchValues, Modes};
use super::parts::{MOST_PARTS, Span, halve, hull};
use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// The largest number of parts of the same length. If more of them would have to be looked at, the step is too long.
const PARTS: usize = MOST_PARTS;

/// The largest number of parts that are looked at if there is no bound even over a part as short as [`MIN_PART`], as
/// for a function that the program supplies, which has no enclosure.
const PARTS_WITHOUT_BOUND: usize = 16;
const MIN_PART: f64 = 1e-6;

/// Width of the box along a coordinate that rests, relative to the coordinate, and the least width.
const RESTING_WIDTH: f64 = 1e-12;
const LEAST_WIDTH: f64 = 1e-100;

/// The largest turn of a part that is not halved, relative to the largest rotation of a step.
const UNDIVIDED_TURN: f64 = 2.0;

/// Writes enclosures of the turns per unit over a part of the step, given by its place and its box.
pub(crate) type TurnsOver<'a> = dyn FnMut(Interval, &[Interval], &mut [Interval]) -> Result<(), LengthError> + 'a;

/// True if `stays_at` is true wherever the gradients of the rows turn by more than [`UNDIVIDED_TURN`] times `rotation`.
/// The buffers have a number for every coordinate.
pub(crate) fn stays_in_bends(
    span: Span<'_>,
    rotation: f64,
    [box_of_part, turns]: [&mut [Interval]; 2],
    turns_over: &mut TurnsOver<'_>,
    stays_at: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<bool, LengthError> {
    let mut is_small = |start: f64, width: f64| -> Result<Option<bool>, LengthError> {
        hull(box_of_part, span, start, width);
        turns_over(Interval::new(start, start + width), box_of_part, turns)?;
        let turn_by = |(turn, along): (&Interval, &Interval)| {
            // A turn without a bound counts for a coordinate that rests, too, because the curve itself may move.
            let least = RESTING_WIDTH * along.magnitude() + LEAST_WIDTH;
            turn.upper() * (along.upper() - along.lower()).max(least)
        };
        let mut all = turns.iter().zip(&*box_of_part).map(turn_by);
        let largest = all.try_fold(0.0, |largest: f64, turn| (!turn.is_nan()).then(|| largest.max(turn)));
        Ok(largest.map(|largest| largest <= UNDIVIDED_TURN * rotation))
    };
    if is_small(0.0, 1.0)? == Some(true) {
        return Ok(true);
    }
    for s in core::iter::once(0.5).chain(even_fractions()) {
        if !stays_at(s)? {
            return Ok(false);
        }
    }
    let most = if is_small(0.5, MIN_PART)?.is_none() { PARTS_WITHOUT_BOUND } else { PARTS };
    let mut excess = |start, width| Ok(if is_small(start, width)? == Some(true) { 0.0 } else { f64::INFINITY });
    // A step with so many bends is too long; without a bound no step would be short enough.
    Ok(halve(most, &mut excess, stays_at)?.unwrap_or(most < PARTS))
}

/// True if no iterated group comes much nearer to its limit in a bend of the rows than at the ends of the step. The
/// instant is that of the end.
#[cold]
#[inline(never)]
pub(crate) fn bends_are_followed<M: Mechanism>(
    mechanism: &M,
    (parameters, at): (&[f64], &Instant<'_>),
    modes: &Modes<M>,
    span: Span<'_>,
    rotation: f64,
) -> Result<bool, LengthError> {
    let known: M::Parameters<Interval> = Array::generate(Interval::ZERO, |k| Interval::from_f64(parameters[k]));
    let ends = [span.inputs, at.inputs];
    let branch_values_at = |s: f64, q: &[f64]| {
        let mut inputs = M::Inputs::<f64>::filled(Signal::constant(0.0));
        write_inputs_within(inputs.as_mut(), ends, s, f64::from);
        let instant = Instant { t: time_within(at.t, span.h, s), inputs: inputs.as_ref() };
        BranchValues::at(mechanism, parameters, &instant, q)
    };
    let (first, last) = (branch_values_at(0.0, span.ends[0])?, branch_values_at(1.0, span.ends[2])?);
    let zeros = M::Coordinates::<Interval>::filled(Interval::ZERO);
    let (mut box_of_part, mut turns) = (zeros, zeros);
    let mut q = M::Coordinates::<f64>::filled(0.0);
    stays_in_bends(
        span,
        rotation,
        [box_of_part.as_mut(), turns.as_mut()],
        &mut |place, part, turns| {
            let mut inputs = M::Inputs::<Interval>::filled(Signal::constant(Interval::ZERO));
            write_inputs_within(inputs.as_mut(), ends, place, Interval::from_f64);
            let t = time_within(Interval::from_f64(at.t), span.h, place);
            mechanism.turns_with(known.as_ref(), &Instant { t, inputs: inputs.as_ref() }, part, turns)
        },
        &mut |s| {
            on_cubic(q.as_mut(), span.ends, span.h, s);
            let between = branch_values_at(s, q.as_ref())?;
            let branch_values = [first.as_ref(), between.as_ref(), last.as_ref()];
            Ok(certainty_between(modes.as_ref(), branch_values, M::model().plan.modes.len()) >= 0.0)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::{PARTS_WITHOUT_BOUND, Span, stays_in_bends};
    use crate::mechanism::LengthError;
    use crate::planned::parts::HALVINGS;
    use crate::scalar::Interval;

    /// A step of the length 2 in which one coordinate goes from 0 to 2 at the rate 1.
    const UNIFORM: Span<'_> = Span { ends: [&[0.0], &[1.0], &[2.0], &[1.0]], inputs: &[], h: 2.0 };

    /// The verdict, the number of enclosures and the places that are looked at, where the turn per unit over a box is
    /// `turn`; at the places for which `limit` is true there is a limit.
    fn look(turn: impl Fn(Interval) -> f64, limit: impl Fn(f64) -> bool) -> (bool, usize, Vec<f64>) {
        let (mut enclosures, mut places) = (0, Vec::new());
        let [mut part, mut turns] = [[Interval::ZERO]; 2];
        let mut over = |place: Interval, part: &[Interval], turns: &mut [Interval]| -> Result<(), LengthError> {
            enclosures += 1;
            // The motion is uniform, so the box is the part of the step.
            assert!((part[0].lower() - 2.0 * place.lower()).abs() < 1e-15, "{place} {}", part[0]);
            assert!((part[0].upper() - 2.0 * place.upper()).abs() < 1e-15, "{place} {}", part[0]);
            turns[0] = Interval::new(0.0, turn(part[0]));
            Ok(())
        };
        let mut stays_at = |s: f64| {
            places.push(s);
            Ok(!limit(s))
        };
        let stays = stays_in_bends(UNIFORM, 0.3, [&mut part, &mut turns], &mut over, &mut stays_at);
        (stays.expect("the lengths are right"), enclosures, places)
    }

    #[test]
    fn a_step_without_bends_is_not_looked_at() {
        // 0.3 per unit along 2 units is twice the rotation of 0.3.
        assert_eq!((true, 1, vec![]), look(|_| 0.299, |_| true));
        let (stays, enclosures, places) = look(|_| 0.301, |_| false);
        assert!(stays && enclosures == 4, "{enclosures}");
        assert_eq!(vec![0.5, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875], places);
        // A limit in the middle is seen.
        assert!(!look(|_| 0.301, |s| s == 0.5).0 && !look(|_| 0.301, |s| s == 0.625).0);
    }

    /// A bend in which the gradients turn by 1e5 per unit, between 1.2345 and 1.2346: by 10 rad.
    #[test]
    fn a_narrow_bend_is_found() {
        let bend = |part: Interval| if part.lower() < 1.2346 && part.upper() > 1.2345 { 1e5 } else { 0.0 };
        let is_inside = |s: f64| (1.2345..1.2346).contains(&(2.0 * s));
        let (stays, enclosures, places) = look(bend, is_inside);
        assert!(!stays && enclosures < 60, "{enclosures}");
        assert!(places.last().is_some_and(|s| is_inside(*s)), "{places:?}");
        // Without a limit in it the step is accepted.
        let (stays, enclosures, _) = look(bend, |_| false);
        assert!(stays && enclosures < 120, "{enclosures}");
    }

    /// A turn without a bound at one place: halving ends. Without a bound anywhere it ends early.
    #[test]
    fn halving_comes_to_an_end() {
        let (stays, enclosures, _) = look(|part| if part.contains(0.7) { f64::NAN } else { 0.0 }, |_| false);
        assert!(stays && enclosures <= 2 * (HALVINGS as usize + 1), "{enclosures}");
        let (stays, enclosures, places) = look(|_| f64::NAN, |_| false);
        // The whole step, its middle, and 2, 4, 8 and 16 parts, of which the ninth is one too many; 7 usual places.
        let looks = 1 + 2 + 4 + 8 + 9 + 7;
        assert!(stays && enclosures == 2 * PARTS_WITHOUT_BOUND && places.len() == looks, "{enclosures} {places:?}");
    }
}
