//! The builder of a sequence, which adds segment by segment.

use super::Sequence;
use super::segment::{Displacement, Segment};
use crate::function::FunctionError;
use crate::function::law::MotionLaw;
use crate::text::counted;
use alloc::vec::Vec;
use core::fmt;

/// A builder of a sequence. [`periodic`](Self::periodic) or [`build`](Self::build) completes the sequence and reports
/// the first mistake.
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

    /// The x and the position at which the next segment begins.
    fn here(&self) -> (f64, f64) {
        match self.segments.last() {
            None => self.start,
            Some(last) => (last.start + last.duration, last.position + last.course.rise()),
        }
    }

    /// Adds a segment of length `duration` without motion.
    pub fn dwell(self, duration: f64) -> Self {
        self.segment(Displacement::Dwell, duration)
    }

    /// Adds a motion by `height`, up or (if negative) down.
    pub fn rise(self, law: MotionLaw, height: f64, duration: f64) -> Self {
        self.segment(Displacement::Law(law, height), duration)
    }

    /// Adds a motion down by `height`, which is a rise by −`height`.
    pub fn fall(self, law: MotionLaw, height: f64, duration: f64) -> Self {
        self.rise(law, -height, duration)
    }

    /// Adds a motion to `position`.
    pub fn to(self, law: MotionLaw, position: f64, duration: f64) -> Self {
        let height = position - self.here().1;
        self.rise(law, height, duration)
    }

    /// Adds a motion to the position at which the sequence starts.
    pub fn return_to_start(self, law: MotionLaw, duration: f64) -> Self {
        let position = self.start.1;
        self.to(law, position, duration)
    }

    /// Adds a motion by Σ c_k τ^k, where τ goes from 0 to 1 over the duration; c_0 must be 0, since the motion begins
    /// at the current position.
    pub fn polynomial(self, coefficients: &[f64], duration: f64) -> Self {
        self.segment(Displacement::Polynomial(coefficients.to_vec()), duration)
    }

    fn segment(mut self, course: Displacement, duration: f64) -> Self {
        let (start, position) = self.here();
        let number = self.segments.len();
        let constant = match &course {
            Displacement::Polynomial(coefficients) => coefficients.first().copied().unwrap_or(0.0),
            Displacement::Dwell | Displacement::Law(..) => 0.0,
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

    /// Completes a sequence that is run through once.
    ///
    /// # Errors
    /// The first mistake: no segment, numbers that are not finite, a duration that is not positive, or a polynomial
    /// with a constant term.
    pub fn build(self) -> Result<Sequence, FunctionError> {
        self.complete(false)
    }

    /// Completes a sequence that is repeated forever.
    ///
    /// # Errors
    /// As [`build`](Self::build), and where the end position differs from the start position.
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

/// The start and the number of segments so far, with the first mistake.
impl fmt::Display for SequenceBuilder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sequence from x = {}, ", self.start.0)?;
        counted(f, self.segments.len(), "segment")?;
        self.error.as_ref().map_or(Ok(()), |error| write!(f, "; {error}"))
    }
}
