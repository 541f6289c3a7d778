//! Motion laws of cams: the normalised displacement of a rise over its duration.

mod cycloidal;
mod harmonic;
mod modified_sine;
mod modified_trapezoidal;
mod polynomials;
#[cfg(test)]
mod tests;
mod wave;

use super::ScalarFunction;
use super::polynomial::all_derivatives;
use crate::scalar::Interval;
use core::fmt;
use wave::Wave;

/// A normalised motion law s(τ) with s(0) = 0 and s(1) = 1 for τ in [0, 1].
///
/// A rise h over a duration β has position h s(τ), velocity h s′(τ)/β and acceleration h s″(τ)/β² with τ = x/β. The
/// peaks of s′ and s″ measure the load that a law puts on the machine (Norton, *Cam Design and Manufacturing Handbook*,
/// 2009, chapters 3 and 4; VDI 2143):
///
/// | law | peak s′ | peak s″ | at its ends |
/// |---|---|---|---|
/// | `ConstantVelocity` | 1 | 0 | velocity jumps |
/// | `Harmonic` | π/2 = 1.5708 | π²/2 = 4.9348 | acceleration jumps beside a dwell |
/// | `Cycloidal` | 2 | 2π = 6.2832 | C² |
/// | `Polynomial345` | 1.875 | 5.7735 | C² |
/// | `Polynomial4567` | 2.1875 | 7.5132 | C³ |
/// | `ModifiedSine` | 1.7596 | 5.5280 | C² |
/// | `ModifiedTrapezoidal` | 2 | 4.8881 | C² |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MotionLaw {
    /// s = τ.
    ConstantVelocity,
    /// s = (1 − cos πτ)/2.
    Harmonic,
    /// s = τ − sin(2πτ)/2π.
    Cycloidal,
    /// s = 10τ³ − 15τ⁴ + 6τ⁵.
    Polynomial345,
    /// s = 35τ⁴ − 84τ⁵ + 70τ⁶ − 20τ⁷.
    Polynomial4567,
    /// The acceleration is a sine over the inner three quarters and a steeper sine at the ends.
    ModifiedSine,
    /// The acceleration has constant pieces connected by quarter sines.
    ModifiedTrapezoidal,
}

impl MotionLaw {
    /// Every law.
    pub const ALL: [Self; 7] = [
        Self::ConstantVelocity,
        Self::Harmonic,
        Self::Cycloidal,
        Self::Polynomial345,
        Self::Polynomial4567,
        Self::ModifiedSine,
        Self::ModifiedTrapezoidal,
    ];

    /// (s, s′, s″) at τ. Before τ = 0 and after τ = 1 the motion rests at 0 and 1.
    pub fn normalised(self, tau: f64) -> [f64; 3] {
        if tau < 0.0 {
            return [0.0; 3];
        }
        if tau > 1.0 {
            return [1.0, 0.0, 0.0];
        }
        match self {
            Self::ConstantVelocity => [tau, 1.0, 0.0],
            Self::Harmonic => harmonic::law(tau),
            Self::Cycloidal => cycloidal::law(tau),
            Self::Polynomial345 => polynomials::law_345(tau),
            Self::Polynomial4567 => polynomials::law_4567(tau),
            Self::ModifiedSine => modified_sine::law(tau),
            Self::ModifiedTrapezoidal => modified_trapezoidal::law(tau),
        }
    }

    /// Writes s, s′, s″, s‴, … at τ, as many as `out` has room for. Where a derivative jumps between two pieces of a
    /// law, the value is that of the later piece.
    pub fn derivatives(self, tau: f64, out: &mut [f64]) {
        let waves = match self {
            // Before and after the interval the motion rests.
            _ if !(0.0..=1.0).contains(&tau) => Wave::default(),
            Self::ConstantVelocity => Wave::default(),
            Self::Harmonic => harmonic::wave(tau),
            Self::Cycloidal => cycloidal::wave(tau),
            Self::ModifiedSine => modified_sine::wave(tau),
            Self::ModifiedTrapezoidal => modified_trapezoidal::wave(tau),
            Self::Polynomial345 => {
                all_derivatives(&polynomials::LAW_345, tau, out);
                return;
            }
            Self::Polynomial4567 => {
                all_derivatives(&polynomials::LAW_4567, tau, out);
                return;
            }
        };
        let [s, s_1, s_2] = self.normalised(tau);
        let Wave { mut sine, mut cosine, omega } = waves;
        for (order, place) in out.iter_mut().enumerate() {
            *place = match order {
                0 => s,
                1 => s_1,
                2 => s_2,
                _ => {
                    (sine, cosine) = (omega * cosine, -omega * sine);
                    sine
                }
            };
        }
    }
}

/// The normalised law itself: a rise from 0 to 1 while its argument goes from 0 to 1, as in `stroke * rise(t /
/// duration)`.
impl ScalarFunction for MotionLaw {
    #[inline]
    fn evaluate(&self, tau: f64) -> [f64; 3] {
        self.normalised(tau)
    }

    fn derivatives(&self, tau: f64, out: &mut [f64]) -> usize {
        Self::derivatives(*self, tau, out);
        out.len()
    }

    /// Every law rises from 0 to 1.
    fn enclose(&self, tau: Interval) -> Interval {
        let [from, to] = [tau.lower(), tau.upper()].map(|tau| self.normalised(tau)[0]);
        Interval::from(from).hull(Interval::from(to))
    }
}

/// The name of the law.
impl fmt::Display for MotionLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ConstantVelocity => "constant velocity",
            Self::Harmonic => "harmonic",
            Self::Cycloidal => "cycloidal",
            Self::Polynomial345 => "polynomial 3-4-5",
            Self::Polynomial4567 => "polynomial 4-5-6-7",
            Self::ModifiedSine => "modified sine",
            Self::ModifiedTrapezoidal => "modified trapezoidal",
        })
    }
}
