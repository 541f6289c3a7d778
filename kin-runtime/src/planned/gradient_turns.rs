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
//! nothing. Any other part is halved, and the branch values are looked at in its middle; if the whole step is such a part,
//! they are also looked at in the usual places.

use super::interior::{LEAST, fractions, input_within, on_cubic, time_within};
use super::lists::{BranchValues, Modes};
use crate::mechanism::{LengthError, Mechanism};
use crate::scalar::{Interval, Scalar};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;

/// How often a part is halved at most.
const HALVINGS: u32 = 20;

/// The largest number of parts of the same length. If more of them would have to be looked at, the step is too long.
const PARTS: usize = 256;

/// The largest number of parts that are looked at if there is no bound even over a part as short as [`SHORTEST`], as for a
/// function that the program supplies, which has no enclosure.
const PARTS_WITHOUT_BOUND: usize = 16;
const SHORTEST: f64 = 1e-6;

/// The excess of a part that need not be halved, relative to the largest one.
const NEGLIGIBLE_EXCESS: f64 = 1e-3;

/// Width of the box along a coordinate that rests, relative to the coordinate, and the least width.
const RESTING: f64 = 1e-12;
const LEAST_WIDTH: f64 = 1e-100;

/// The largest turn of a part that is not halved, relative to the largest rotation of a step.
const SMALL: f64 = 2.0;

/// A step: q₀, q̇₀, q₁ and q̇₁, the inputs at its start, and its length.
#[derive(Clone, Copy)]
pub(crate) struct Span<'a> {
    /// The configurations and rates at both ends.
    pub(crate) ends: [&'a [f64]; 4],
    /// The inputs at the start.
    pub(crate) inputs: &'a [Signal],
    /// The length of the step.
    pub(crate) h: f64,
}

/// Writes enclosures of the turns per unit over a part of the step, given by its place and its box.
pub(crate) type TurnsOver<'a> = dyn FnMut(Interval, &[Interval], &mut [Interval]) -> Result<(), LengthError> + 'a;

/// True if `stays_at` is true wherever the gradients of the rows turn by more than [`SMALL`] times `rotation`. The buffers
/// have a number for every coordinate.
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
            let least = RESTING * along.magnitude() + LEAST_WIDTH;
            turn.upper() * (along.upper() - along.lower()).max(least)
        };
        let mut all = turns.iter().zip(&*box_of_part).map(turn_by);
        let largest = all.try_fold(0.0, |largest: f64, turn| (!turn.is_nan()).then(|| largest.max(turn)));
        Ok(largest.map(|largest| largest <= SMALL * rotation))
    };
    if is_small(0.0, 1.0)? == Some(true) {
        return Ok(true);
    }
    for s in core::iter::once(0.5).chain(fractions()) {
        if !stays_at(s)? {
            return Ok(false);
        }
    }
    let most = if is_small(0.5, SHORTEST)?.is_none() { PARTS_WITHOUT_BOUND } else { PARTS };
    let mut excess = |start, width| Ok(if is_small(start, width)? == Some(true) { 0.0 } else { f64::INFINITY });
    // A step with so many bends is too long; without a bound no step would be short enough.
    Ok(halve(most, &mut excess, stays_at)?.unwrap_or(most < PARTS))
}

/// Halves a step, and each part whose excess is above 1, and looks at the middle of every such part: false where
/// `stays_at` is false, `None` where more than `most` parts of the same length would have to be looked at. The whole step
/// has been looked at. The excess is a function of the beginning and the length of a part; parts are left out if it is
/// [`NEGLIGIBLE_EXCESS`] times the largest one.
pub(super) fn halve(
    most: usize,
    excess: &mut dyn FnMut(f64, f64) -> Result<f64, LengthError>,
    stays_at: &mut dyn FnMut(f64) -> Result<bool, LengthError>,
) -> Result<Option<bool>, LengthError> {
    // The parts are numbered from the beginning of the step.
    let (mut parts, mut count, mut width) = ([0_u32; PARTS], 2, 0.5);
    parts[1] = 1;
    for _ in 0..HALVINGS {
        let (mut excesses, mut halves, mut halved) = ([0.0; PARTS], [0_u32; PARTS], 0);
        for (&part, to) in parts[..count].iter().zip(&mut excesses) {
            *to = excess(f64::from(part) * width, width)?;
        }
        let least = NEGLIGIBLE_EXCESS * excesses.into_iter().fold(1.0 / NEGLIGIBLE_EXCESS, f64::max);
        for (&part, _) in parts[..count].iter().zip(excesses).filter(|(_, excess)| *excess > 1.0 && *excess >= least) {
            if !stays_at((f64::from(part) + 0.5) * width)? {
                return Ok(Some(false));
            }
            if halved + 2 > most {
                return Ok(None);
            }
            (halves[halved], halves[halved + 1]) = (2 * part, 2 * part + 1);
            halved += 2;
        }
        (parts, count, width) = (halves, halved, 0.5 * width);
    }
    Ok(Some(true))
}

/// Writes a box that contains the cubic from a place over a part of the step: the hull of its Bézier points.
pub(super) fn hull(to: &mut [Interval], Span { ends: [q0, v0, q1, v1], h, .. }: Span<'_>, start: f64, width: f64) {
    for ((to, (q0, v0)), (q1, v1)) in to.iter_mut().zip(q0.iter().zip(v0)).zip(q1.iter().zip(v1)) {
        let at = |s: f64| {
            let rest = 1.0 - s;
            let q = rest * rest * ((1.0 + 2.0 * s) * q0 + h * s * v0) + s * s * ((3.0 - 2.0 * s) * q1 - h * rest * v1);
            let slope = 6.0 * s * rest * (q1 - q0) + h * (rest * (1.0 - 3.0 * s) * v0 - s * (2.0 - 3.0 * s) * v1);
            [q, slope * width / 3.0]
        };
        let ([a, beyond_a], [b, before_b]) = (at(start), at(start + width));
        let points = [a, a + beyond_a, b - before_b, b];
        let [least, most] = [f64::min, f64::max].map(|choose| points.into_iter().fold(a, choose));
        *to = Interval::new(least, most);
    }
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
    let ends = |k: usize| [&span.inputs[k], &at.inputs[k]];
    let of = |s: f64, q: &[f64]| {
        let inputs = M::Inputs::<f64>::generate(Signal::constant(0.0), |k| input_within(ends(k), s));
        let there = Instant { t: time_within(at.t, span.h, s), inputs: inputs.as_ref() };
        BranchValues::at(mechanism, parameters, &there, q)
    };
    let (first, last) = (of(0.0, span.ends[0])?, of(1.0, span.ends[2])?);
    let zeros = M::Coordinates::<Interval>::filled(Interval::ZERO);
    let (mut box_of_part, mut turns) = (zeros, zeros);
    let mut q = M::Coordinates::<f64>::filled(0.0);
    let groups = M::model().plan.modes.len()..M::model().plan.signs();
    stays_in_bends(
        span,
        rotation,
        [box_of_part.as_mut(), turns.as_mut()],
        &mut |place, part, turns| {
            let inputs = M::Inputs::<Interval>::generate(Signal::constant(Interval::ZERO), |k| {
                let [from, to] = ends(k).map(|input| input.map(Interval::from_f64));
                input_within([&from, &to], place)
            });
            let t = time_within(Interval::from_f64(at.t), span.h, place);
            mechanism.turns_with(known.as_ref(), &Instant { t, inputs: inputs.as_ref() }, part, turns)
        },
        &mut |s| {
            on_cubic(q.as_mut(), span.ends, span.h, s);
            let between = of(s, q.as_ref())?;
            Ok(groups.clone().all(|group| {
                let w = |list: &BranchValues<M>| modes.as_ref()[group] * list.as_ref()[group];
                w(&between) >= LEAST * f64::min(w(&first), w(&last))
            }))
        },
    )
}

#[cfg(test)]
mod tests {
    use super::{HALVINGS, PARTS_WITHOUT_BOUND, Span, hull, stays_in_bends};
    use crate::mechanism::LengthError;
    use crate::planned::interior::on_cubic;
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
    fn a_box_contains_the_cubic() {
        let ends: [&[f64]; 4] = [&[0.3, -2.0], &[-4.0, 1.0], &[0.5, 3.0], &[7.0, -30.0]];
        for h in [1.5, -0.7] {
            for (start, width) in [(0.0, 1.0), (0.25, 0.25), (0.875, 0.125)] {
                let mut part = [Interval::ZERO; 2];
                hull(&mut part, Span { ends, inputs: &[], h }, start, width);
                for k in 0..=20 {
                    let mut q = [f64::NAN; 2];
                    on_cubic(&mut q, ends, h, start + width * f64::from(k) / 20.0);
                    for (part, q) in part.iter().zip(q) {
                        assert!(part.lower() - 1e-12 <= q && q <= part.upper() + 1e-12, "{h} {start} {k}: {part} {q}");
                    }
                }
                // Over short parts the box is little larger than the cubic.
                let mut halves = [[Interval::ZERO; 2]; 2];
                hull(&mut halves[0], Span { ends, inputs: &[], h }, start, 0.5 * width);
                hull(&mut halves[1], Span { ends, inputs: &[], h }, start + 0.5 * width, 0.5 * width);
                for k in 0..2 {
                    let both = halves[0][k].hull(halves[1][k]);
                    assert!(part[k].lower() - 1e-12 <= both.lower() && both.upper() <= part[k].upper() + 1e-12, "{k}");
                }
            }
        }
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
