//! The range of a parameter: one value, several, an interval, or a distribution.

use statrs::function::erf::{erfc, erfc_inv};
use std::f64::consts::SQRT_2;

/// The values that a parameter may have. All numbers are in the unit of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Range {
    /// The same in every row.
    Fixed(f64),
    /// One of these values, each with the same probability.
    List(Vec<f64>),
    /// Uniformly distributed between two values.
    Uniform {
        /// The least value.
        from: f64,
        /// The greatest value.
        to: f64,
    },
    /// A value whose logarithm is uniformly distributed; both bounds are positive.
    LogUniform {
        /// The least value.
        from: f64,
        /// The greatest value.
        to: f64,
    },
    /// Normally distributed, truncated at two values.
    Normal {
        /// The mean before truncation.
        mean: f64,
        /// The standard deviation before truncation.
        deviation: f64,
        /// The least value, or −∞.
        from: f64,
        /// The greatest value, or ∞.
        to: f64,
    },
    /// A density that rises linearly up to its mode and falls linearly after it.
    Triangular {
        /// The least value.
        from: f64,
        /// The most frequent value.
        mode: f64,
        /// The greatest value.
        to: f64,
    },
}

impl Range {
    /// `count` values with equal steps from `from` to `to`, both included.
    pub fn steps(from: f64, to: f64, count: usize) -> Self {
        let last = count.saturating_sub(1).max(1) as f64;
        let at = |k: usize| if k + 1 == count && k > 0 { to } else { from + (to - from) * (k as f64 / last) };
        Self::List((0..count).map(at).collect())
    }

    /// What is wrong with it.
    pub(crate) fn check(&self) -> Result<(), String> {
        let finite = |values: &[f64]| match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(format!("{value} is no finite number")),
            None => Ok(()),
        };
        let upwards = |from: f64, to: f64| match from < to {
            true => Ok(()),
            false => Err(format!("from = {from} must be less than to = {to}")),
        };
        match *self {
            Self::Fixed(value) => finite(&[value]),
            Self::List(ref values) if values.is_empty() => Err("a list needs at least one value".to_owned()),
            Self::List(ref values) => finite(values),
            Self::Uniform { from, to } => finite(&[from, to]).and_then(|()| upwards(from, to)),
            Self::LogUniform { from, to } => finite(&[from, to]).and_then(|()| upwards(from, to)).and_then(|()| {
                if from > 0.0 { Ok(()) } else { Err(format!("from = {from} must be positive on a logarithmic scale")) }
            }),
            Self::Normal { mean, deviation, from, to } => {
                finite(&[mean, deviation])?;
                upwards(from, to)?;
                match deviation > 0.0 {
                    true if self.mass() > 1e-9 => Ok(()),
                    true => Err(format!("nothing of the distribution lies between {from} and {to}")),
                    false => Err(format!("deviation = {deviation} must be positive")),
                }
            }
            Self::Triangular { from, mode, to } => {
                finite(&[from, mode, to]).and_then(|()| upwards(from, to))?;
                match (from..=to).contains(&mode) {
                    true => Ok(()),
                    false => Err(format!("mode = {mode} must lie between from = {from} and to = {to}")),
                }
            }
        }
    }

    /// The number of values that a grid takes; `None` for an interval or a distribution.
    pub(super) fn count(&self) -> Option<u64> {
        match self {
            Self::Fixed(_) => Some(1),
            Self::List(values) => Some(values.len() as u64),
            _ => None,
        }
    }

    /// The share of the normal distribution that truncation leaves.
    fn mass(&self) -> f64 {
        match *self {
            Self::Normal { mean, deviation, from, to } => {
                below((to - mean) / deviation) - below((from - mean) / deviation)
            }
            _ => 1.0,
        }
    }

    /// The value with this share of the distribution below it, 0 < share < 1.
    pub(super) fn quantile(&self, share: f64) -> f64 {
        match *self {
            Self::Fixed(value) => value,
            Self::List(ref values) => values[((share * values.len() as f64) as usize).min(values.len() - 1)],
            Self::Uniform { from, to } => from + share * (to - from),
            Self::LogUniform { from, to } => (from.ln() + share * (to.ln() - from.ln())).exp().clamp(from, to),
            Self::Normal { mean, deviation, from, to } => {
                let (low, high) = (below((from - mean) / deviation), below((to - mean) / deviation));
                let share = low + share * (high - low);
                (mean - deviation * SQRT_2 * erfc_inv(2.0 * share)).clamp(from, to)
            }
            Self::Triangular { from, mode, to } => {
                let (rise, whole) = (mode - from, to - from);
                match share * whole < rise {
                    true => from + (share * whole * rise).sqrt(),
                    false => to - ((1.0 - share) * whole * (to - mode)).sqrt(),
                }
            }
        }
    }
}

/// The share of the standard normal distribution below x.
fn below(x: f64) -> f64 {
    match x {
        f64::INFINITY => 1.0,
        f64::NEG_INFINITY => 0.0,
        x => 0.5 * erfc(-x / SQRT_2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_distributions() {
        let normal = |from, to| Range::Normal { mean: 1.0, deviation: 2.0, from, to };
        let whole = normal(f64::NEG_INFINITY, f64::INFINITY);
        // 97.5 % of a normal distribution lie below 1.959 963 985 deviations above the mean.
        assert!((whole.quantile(0.975) - (1.0 + 2.0 * 1.959_963_984_540_054)).abs() < 1e-9);
        assert!((whole.quantile(0.5) - 1.0).abs() < 1e-12);
        assert!((normal(-1.0, 3.0).quantile(0.5) - 1.0).abs() < 1e-12);
        assert!(normal(-1.0, 3.0).quantile(1e-15) >= -1.0);
        let triangle = Range::Triangular { from: 0.0, mode: 1.0, to: 4.0 };
        assert_eq!([triangle.quantile(0.25), triangle.quantile(0.75)], [1.0, 4.0 - 3.0_f64.sqrt()]);
        let log = Range::LogUniform { from: 1.0, to: 100.0 };
        assert!((log.quantile(0.5) - 10.0).abs() < 1e-12);
        let list = Range::steps(0.0, 1.0, 5);
        assert_eq!(list, Range::List(vec![0.0, 0.25, 0.5, 0.75, 1.0]));
        assert_eq!([0.0, 0.39, 0.41, 0.999_999].map(|share| list.quantile(share)), [0.0, 0.25, 0.5, 1.0]);
    }

    #[test]
    fn ranges_that_make_no_sense_say_what_would() {
        let wrong = |range: Range| range.check().expect_err("it makes no sense");
        assert_eq!(wrong(Range::Uniform { from: 2.0, to: 1.0 }), "from = 2 must be less than to = 1");
        assert_eq!(wrong(Range::Uniform { from: f64::NAN, to: 1.0 }), "NaN is no finite number");
        assert_eq!(wrong(Range::List(vec![])), "a list needs at least one value");
        assert!(wrong(Range::LogUniform { from: 0.0, to: 1.0 }).contains("must be positive"));
        let far = Range::Normal { mean: 0.0, deviation: 1.0, from: 40.0, to: 41.0 };
        assert_eq!(wrong(far), "nothing of the distribution lies between 40 and 41");
        assert!(wrong(Range::Triangular { from: 0.0, mode: 2.0, to: 1.0 }).contains("must lie between"));
    }
}
