//! One segment of a sequence.

use crate::function::ScalarFunction;
use crate::function::law::MotionLaw;
use crate::function::polynomial::{self, all_derivatives, horner};
use crate::scalar::Interval;
use alloc::vec::Vec;

/// A piece of a motion over [start, start + duration].
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) start: f64,
    pub(super) duration: f64,
    /// The position at the start.
    pub(super) position: f64,
    pub(super) course: Displacement,
}

/// The displacement of a segment from its position at the start, over τ in [0, 1].
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Displacement {
    Dwell,
    /// A motion law and the height of the rise.
    Law(MotionLaw, f64),
    /// The coefficients of Σ c_k τ^k.
    Polynomial(Vec<f64>),
}

impl Displacement {
    /// The displacement and its first two derivatives with respect to τ.
    fn evaluate(&self, tau: f64) -> [f64; 3] {
        match self {
            Self::Dwell => [0.0; 3],
            Self::Law(law, rise) => law.normalised(tau).map(|s| rise * s),
            Self::Polynomial(coefficients) => horner(coefficients, tau),
        }
    }

    /// The displacement and its derivatives of all orders with respect to τ.
    fn derivatives(&self, tau: f64, out: &mut [f64]) {
        match self {
            Self::Dwell => out.fill(0.0),
            Self::Law(law, rise) => {
                law.derivatives(tau, out);
                out.iter_mut().for_each(|s| *s *= rise);
            }
            Self::Polynomial(coefficients) => _ = all_derivatives(coefficients, tau, out),
        }
    }

    /// The displacement over the whole segment.
    pub(super) fn rise(&self) -> f64 {
        match self {
            Self::Dwell => 0.0,
            Self::Law(_, rise) => *rise,
            Self::Polynomial(coefficients) => coefficients.iter().sum(),
        }
    }
}

impl Segment {
    pub(super) fn evaluate(&self, x: f64) -> [f64; 3] {
        // Rounding must not move τ beyond 1, where a law is at rest.
        self.at(((x - self.start) / self.duration).clamp(0.0, 1.0))
    }

    /// Writes f, f′, f″, … at x.
    pub(super) fn derivatives(&self, x: f64, out: &mut [f64]) {
        self.course.derivatives(((x - self.start) / self.duration).clamp(0.0, 1.0), out);
        let mut scale = 1.0;
        for (order, place) in out.iter_mut().enumerate() {
            *place = if order == 0 { self.position + *place } else { *place / scale };
            scale *= self.duration;
        }
    }

    /// The values over an interval of x.
    pub(super) fn enclose(&self, x: Interval) -> Interval {
        let [from, to] = [x.lower(), x.upper()].map(|x| ((x - self.start) / self.duration).clamp(0.0, 1.0));
        let tau = Interval::new(from, to);
        let moved = match &self.course {
            Displacement::Dwell => Interval::ZERO,
            Displacement::Law(law, rise) => law.enclose(tau) * Interval::from(*rise),
            Displacement::Polynomial(coefficients) => polynomial::enclose(coefficients, tau),
        };
        Interval::from(self.position) + moved
    }

    pub(super) fn at_start(&self) -> [f64; 3] {
        self.at(0.0)
    }

    pub(super) fn at_end(&self) -> [f64; 3] {
        self.at(1.0)
    }

    fn at(&self, tau: f64) -> [f64; 3] {
        let [s, s_1, s_2] = self.course.evaluate(tau);
        [self.position + s, s_1 / self.duration, s_2 / self.duration / self.duration]
    }
}
