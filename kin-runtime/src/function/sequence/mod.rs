//! Rises, returns and dwells, one after another.

mod builder;
mod segment;
#[cfg(test)]
mod tests;

use super::{ScalarFunction, enclose_periodic, enclose_pieces, enclose_straight};
use crate::scalar::Interval;
use crate::text::counted;
use alloc::vec::Vec;
pub use builder::SequenceBuilder;
use core::fmt;
use segment::Segment;

/// A motion made of segments, over time or over a cam's angle.
///
/// ```
/// use kin_runtime::ScalarFunction;
/// use kin_runtime::function::{MotionLaw, Sequence};
///
/// # fn main() -> Result<(), kin_runtime::function::FunctionError> {
/// // Rest for 1 s at 0, rise by 30 mm in 2 s, rest for 0.5 s, return in 1.5 s; and again.
/// let lift = Sequence::starting_at(0.0, 0.0)
///     .dwell(1.0)
///     .rise(MotionLaw::Cycloidal, 0.03, 2.0)
///     .dwell(0.5)
///     .fall(MotionLaw::ModifiedSine, 0.03, 1.5)
///     .periodic()?;
/// let [s, velocity, _] = lift.evaluate(2.0);
/// assert!((s - 0.015).abs() < 1e-15 && (velocity - 0.03).abs() < 1e-15);
/// assert!((lift.evaluate(102.0)[0] - 0.015).abs() < 1e-15);
/// // Nothing jumps where the segments meet.
/// assert!(lift.junctions().all(|(_, [_, v_before, a_before], [_, v_after, a_after])| {
///     (v_after - v_before).abs() < 1e-14 && (a_after - a_before).abs() < 1e-13
/// }));
/// # Ok(())
/// # }
/// ```
///
/// The position is continuous. Velocity and acceleration may jump where two laws meet, see
/// [`junctions`](Self::junctions); then q̇ or q̈ of a driven coordinate jumps as well, and at the junction itself the
/// later segment applies, and at the end of a sequence that does not repeat the last one. A periodic sequence repeats
/// forever in both directions. Any other sequence continues straight before its start and after its end with the
/// velocity that it has there, which is zero beside a dwell. An argument of NaN gives NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    segments: Vec<Segment>,
    /// Start of the first segment and end of the last one.
    domain: (f64, f64),
    periodic: bool,
}

impl Sequence {
    /// Starts a sequence: at `x` (a time or an angle) the motion is at `position`.
    pub fn starting_at(x: f64, position: f64) -> SequenceBuilder {
        SequenceBuilder::new(x, position)
    }

    /// The x at which the sequence starts and ends.
    pub fn domain(&self) -> (f64, f64) {
        self.domain
    }

    /// True for a sequence that repeats.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// The junctions of segments, in order: x, then position, velocity and acceleration at the end of the segment
    /// before, and those at the start of the next. Both ends are included: in a periodic sequence the end meets the
    /// start, in any other one each end meets its straight continuation.
    pub fn junctions(&self) -> impl Iterator<Item = (f64, [f64; 3], [f64; 3])> {
        let (start, end) = self.domain;
        let (first, last) = (&self.segments[0], &self.segments[self.segments.len() - 1]);
        let straight = |[s, velocity, _]: [f64; 3]| [s, velocity, 0.0];
        let before = if self.periodic { last.at_end() } else { straight(first.at_start()) };
        let inner = self.segments.windows(2).map(|pair| (pair[1].start, pair[0].at_end(), pair[1].at_start()));
        let closing = (!self.periodic).then(|| (end, last.at_end(), straight(last.at_end())));
        core::iter::once((start, before, first.at_start())).chain(inner).chain(closing)
    }
}

impl Sequence {
    /// The segment at `x`, and `x` shifted into the first period; `None` on the straight continuations.
    fn segment_at(&self, x: f64) -> Option<(&Segment, f64)> {
        let (start, end) = self.domain;
        if x.is_nan() || !self.periodic && !(start..=end).contains(&x) {
            return None;
        }
        let x = if self.periodic { super::wrapped(x, start, end) } else { x };
        Some((&self.segments[self.index_at(x)], x))
    }

    /// The index of the segment at `x` within the domain.
    fn index_at(&self, x: f64) -> usize {
        self.segments[1..].partition_point(|segment| segment.start <= x)
    }
}

impl ScalarFunction for Sequence {
    /// Writes derivatives of any order. Where a derivative of a law jumps, the value is that of the later piece; at the
    /// end of a sequence that does not repeat it is that of the last one.
    fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
        match self.segment_at(x) {
            Some((segment, x)) => segment.derivatives(x, out),
            None => {
                out.fill(0.0);
                out.iter_mut().zip(self.evaluate(x)).for_each(|(index, value)| *index = value);
            }
        }
        out.len()
    }

    fn evaluate(&self, x: f64) -> [f64; 3] {
        let (start, end) = self.domain;
        let straight = |[s, velocity, _]: [f64; 3], from: f64| [s + velocity * (x - from), velocity, 0.0];
        if !self.periodic && x < start {
            return straight(self.segments[0].at_start(), start);
        }
        if !self.periodic && x > end {
            return straight(self.segments[self.segments.len() - 1].at_end(), end);
        }
        let x = if self.periodic { super::wrapped(x, start, end) } else { x };
        if x.is_nan() {
            // A dwell would ignore its argument, so NaN is handled here.
            return [f64::NAN; 3];
        }
        self.segments[self.index_at(x)].evaluate(x)
    }

    fn enclose(&self, x: Interval) -> Interval {
        let (start, end) = self.domain;
        let inside = |x: Interval| {
            let ends = [x.lower(), x.upper()].map(|x| self.index_at(x));
            enclose_pieces(x, ends, &|k| self.segments[k].start, &|k, x| self.segments[k].enclose(x))
        };
        match self.periodic {
            _ if !x.is_bounded() => Interval::UNDEFINED,
            true => enclose_periodic(x, [start, end], &inside),
            false => enclose_straight(x, [start, end], &inside, &|x| self.evaluate(x)[0]),
        }
    }
}

/// For example `4 segments from x = 0 to 360, periodic`.
impl fmt::Display for Sequence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        counted(f, self.segments.len(), "segment")?;
        write!(f, " from x = {} to {}{}", self.domain.0, self.domain.1, if self.periodic { ", periodic" } else { "" })
    }
}
