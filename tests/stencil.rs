//! Comparison of derivatives with central differences.

use crate::compare::Differences;

/// Seven instants around a middle one, for first and second derivatives of sixth order.
#[derive(Clone, Copy, Debug)]
pub struct Stencil {
    middle: f64,
    step: f64,
    span: f64,
}

impl Stencil {
    /// The number of instants on either side of the middle one.
    pub const REACH: usize = 3;

    /// Three stencils between two instants.
    #[must_use]
    pub fn several(from: f64, to: f64) -> [Self; 3] {
        let span = to - from;
        [0.21, 0.5, 0.83].map(|share| Self { middle: from + share * span, step: 2e-3 * span, span })
    }

    /// The stencil with half the step, for functions with larger higher derivatives.
    #[must_use]
    pub fn halved(self) -> Self {
        Self { step: 0.5 * self.step, ..self }
    }

    /// `first`, where the sweep starts, followed by the seven instants.
    #[must_use]
    pub fn times(&self, first: f64) -> Vec<f64> {
        let around = (-3..=3).map(|k| self.middle + f64::from(k) * self.step);
        std::iter::once(first).chain(around).collect()
    }

    /// The seven values of a function at the shifts of the instants from the middle one.
    #[must_use]
    pub fn around(&self, value: impl Fn(f64) -> f64) -> Vec<f64> {
        (-3..=3).map(|k| value(f64::from(k) * self.step)).collect()
    }

    /// The first derivative by differences of the seven `samples`.
    ///
    /// # Panics
    /// If there are not seven samples.
    #[must_use]
    pub fn rate(&self, samples: &[f64]) -> f64 {
        let &[a, b, c, _, e, f, g] = samples else { panic!("{} samples", samples.len()) };
        (45.0 * (e - c) - 9.0 * (f - b) + (g - a)) / (60.0 * self.step)
    }

    /// Compares rate and acceleration with differences of the seven `samples`. `scales` are the sizes of rate and
    /// acceleration in this motion; the differences are accurate to 1e-9 and 1e-7 of these sizes, or of one unit per
    /// span.
    ///
    /// # Panics
    /// If there are not seven samples.
    pub fn compare(
        &self,
        differences: &mut Differences,
        name: &str,
        samples: &[f64],
        [rate, acceleration]: [f64; 2],
        scales: [f64; 2],
    ) {
        let &[a, b, c, d, e, f, g] = samples else { panic!("{} samples", samples.len()) };
        let first = self.rate(samples);
        let second = (270.0 * (e + c) - 27.0 * (f + b) + 2.0 * (g + a) - 490.0 * d) / (180.0 * self.step * self.step);
        let slow = scales[0].max(1.0 / self.span);
        let slower = scales[1].max(1.0 / (self.span * self.span));
        differences.number(format_args!("rate of {name}"), first, rate, 1e-9 * slow);
        differences.number(format_args!("acceleration of {name}"), second, acceleration, 1e-7 * slower);
    }
}
