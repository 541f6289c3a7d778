//! Building a sequence, segment by segment.

use super::Sequence;
use super::segment::{Course, Segment};
use crate::function::FunctionError;
use crate::function::law::MotionLaw;
use crate::text::counted;
use alloc::vec::Vec;
use core::fmt;

/// A sequence in the making; [`periodic`](Self::periodic) or [`build`](Self::build) completes it, and reports the first
/// mistake.
#[derive(Clone, Debug)]
#[must_use = "a sequence is complete after `build` or `periodic`"]
pub struct SequenceBuilder {
    start: (f64, f64),
    segments: Vec<Segment>,
    error: Option<FunctionError>,
}

impl SequenceBuilder {
    pub(super) fn new(x: f64, position: f64) -> Self {
        let error =
            (!x.is_finite() || !position.is_finite()).then_some(FunctionError::NonFiniteSegment { segment: None });
        Self { start: (x, position), segments: Vec::new(), error }
    }

    /// Where the next segment begins: x and position.
    fn here(&self) -> (f64, f64) {
        match self.segments.last() {
            None => self.start,
            Some(last) => (last.start + last.duration, last.position + last.course.rise()),
        }
    }

    /// Rests for `duration`.
    pub fn dwell(self, duration: f64) -> Self {
        self.segment(Course::Dwell, duration)
    }

    /// Moves by `height`, up or (negative) down.
    pub fn rise(self, law: MotionLaw, height: f64, duration: f64) -> Self {
        self.segment(Course::Law(law, height), duration)
    }

    /// Moves down by `height`: a rise by −`height`.
    pub fn fall(self, law: MotionLaw, height: f64, duration: f64) -> Self {
        self.rise(law, -height, duration)
    }

    /// Moves to `position`.
    pub fn to(self, law: MotionLaw, position: f64, duration: f64) -> Self {
        let height = position - self.here().1;
        self.rise(law, height, duration)
    }

    /// Moves to the position at which the sequence starts.
    pub fn return_to_start(self, law: MotionLaw, duration: f64) -> Self {
        let position = self.start.1;
        self.to(law, position, duration)
    }

    /// Moves by Σ c_k τ^k, τ from 0 to 1 over the duration; c_0 is 0, since the motion begins where it stands.
    pub fn polynomial(self, coefficients: &[f64], duration: f64) -> Self {
        self.segment(Course::Polynomial(coefficients.to_vec()), duration)
    }

    fn segment(mut self, course: Course, duration: f64) -> Self {
        let (start, position) = self.here();
        let number = self.segments.len();
        let constant = match &course {
            Course::Polynomial(coefficients) => coefficients.first().copied().unwrap_or(0.0),
            Course::Dwell | Course::Law(..) => 0.0,
        };
        let end = (start + duration, position + course.rise());
        let error = if !duration.is_finite() || !end.0.is_finite() || !end.1.is_finite() {
            Some(FunctionError::NonFiniteSegment { segment: Some(number) })
        } else if duration <= 0.0 || end.0 <= start {
            Some(FunctionError::Duration { segment: number, duration })
        } else if constant != 0.0 {
            Some(FunctionError::Jump { segment: number, by: constant })
        } else {
            None
        };
        self.error = self.error.or(error);
        self.segments.push(Segment { start, duration, position, course });
        self
    }

    /// The sequence, run through once.
    ///
    /// # Errors
    /// The first mistake: no segment, numbers that are not finite, a duration that is not greater than 0, a polynomial
    /// that jumps.
    pub fn build(self) -> Result<Sequence, FunctionError> {
        self.complete(false)
    }

    /// The sequence, repeated forever.
    ///
    /// # Errors
    /// As [`build`](Self::build), and when it does not end where it begins.
    pub fn periodic(self) -> Result<Sequence, FunctionError> {
        self.complete(true)
    }

    fn complete(self, periodic: bool) -> Result<Sequence, FunctionError> {
        let (end, position) = self.here();
        if let Some(error) = self.error {
            return Err(error);
        }
        if self.segments.is_empty() {
            return Err(FunctionError::Empty);
        }
        let start = self.start.1;
        let largest = self.segments.iter().fold(0.0_f64, |m, s| m.max(s.position.abs()).max(s.course.rise().abs()));
        if periodic && (position - start).abs() > 1e-12 * largest {
            return Err(FunctionError::NotPeriodic { first: start, last: position });
        }
        Ok(Sequence { segments: self.segments, domain: (self.start.0, end), periodic })
    }
}

/// How many segments so far.
impl fmt::Display for SequenceBuilder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sequence from x = {}, ", self.start.0)?;
        counted(f, self.segments.len(), "segment")?;
        self.error.as_ref().map_or(Ok(()), |error| write!(f, "; {error}"))
    }
}
