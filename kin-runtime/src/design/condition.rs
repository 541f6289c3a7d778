//! The conditions of a design: each is a list of slacks that must be positive.

use super::error::DesignError;
use super::objective::DesignQuantity;
use super::variables::parameter_index;
use crate::measure::Measure;
use crate::model::Model;
use core::ops::RangeInclusive;

/// Which length of a four-bar is the shortest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shortest {
    /// The ground: crank and rocker both turn fully.
    Ground,
    /// The crank, which turns fully.
    Crank,
    /// The coupler: crank and rocker both rock.
    Coupler,
    /// The rocker, which turns fully while the crank rocks.
    Rocker,
}

/// A condition.
#[derive(Clone, Debug)]
pub(crate) enum Condition {
    /// Σ factor · parameter ≥ least.
    Sum { name: String, terms: Vec<(usize, f64)>, least: f64 },
    /// Margins of the plan at instants.
    Margins { times: Vec<f64>, least: f64 },
    /// A quantity within a range at instants.
    Range { name: String, quantity: DesignQuantity, low: f64, high: f64, times: Vec<f64> },
}

/// Instants that are equally far apart, the ends of the period included.
fn spread(period: f64, instants: usize) -> Result<Vec<f64>, DesignError> {
    if !(period.is_finite() && period > 0.0) {
        return Err(DesignError::NotFinite { what: "the period" });
    }
    let last = instants.max(2) - 1;
    Ok((0..=last).map(|k| period * k as f64 / last as f64).collect())
}

impl Condition {
    pub(crate) fn sum(model: &'static Model, terms: &[(&str, f64)], least: f64) -> Result<Self, DesignError> {
        if !least.is_finite() || terms.iter().any(|(_, factor)| !factor.is_finite()) {
            return Err(DesignError::NotFinite { what: "a condition" });
        }
        let written = |(name, factor): &(&str, f64)| match *factor {
            1.0 => format!("+ {name}"),
            -1.0 => format!("- {name}"),
            factor => format!("{factor:+} {name}"),
        };
        let name = format!("{} >= {least}", terms.iter().map(written).collect::<Vec<_>>().join(" "));
        let terms = terms.iter().map(|(name, factor)| Ok((parameter_index(model, name)?, *factor)));
        Ok(Self::Sum { name, terms: terms.collect::<Result<_, DesignError>>()?, least })
    }

    /// With the shortest length s: s + a ≤ b + c for each other length a, which makes s the shortest.
    pub(crate) fn grashof(
        model: &'static Model,
        lengths: [&str; 4],
        shortest: Shortest,
    ) -> Result<Vec<Self>, DesignError> {
        let shortest = shortest as usize;
        let other_links = (0..4).filter(|k| *k != shortest);
        let condition = |long: usize| {
            let sign = |k: usize| if k == shortest || k == long { -1.0 } else { 1.0 };
            Self::sum(model, &core::array::from_fn::<_, 4, _>(|k| (lengths[k], sign(k))), 0.0)
        };
        other_links.map(condition).collect()
    }

    pub(crate) fn turns(period: f64, instants: usize, least: f64) -> Result<Self, DesignError> {
        if !least.is_finite() {
            return Err(DesignError::NotFinite { what: "the least margin" });
        }
        Ok(Self::Margins { times: spread(period, instants)?, least })
    }

    pub(crate) fn range(
        name: String,
        quantity: DesignQuantity,
        range: RangeInclusive<f64>,
        period: f64,
        instants: usize,
    ) -> Result<Self, DesignError> {
        let (low, high) = range.into_inner();
        if low.is_nan() || high.is_nan() || low >= high {
            return Err(DesignError::Bounds { parameter: name, low, high });
        }
        Ok(Self::Range { name, quantity, low, high, times: spread(period, instants)? })
    }

    pub(crate) fn transmission(
        model: &'static Model,
        joint: &str,
        least: f64,
        period: f64,
        instants: usize,
    ) -> Result<Vec<Self>, DesignError> {
        let angles = Measure::transmission_angles(model);
        let of_joint = |angle: &&Measure| {
            let end = angle.name().strip_prefix(joint).and_then(|end| end.strip_prefix(".transmission"));
            end.is_some_and(|end| end.is_empty() || end.starts_with('_'))
        };
        let found: Vec<&Measure> = angles.iter().filter(of_joint).collect();
        if found.is_empty() {
            let angles = angles.iter().map(|angle| angle.name().to_owned()).collect();
            return Err(DesignError::NoTransmission { joint: joint.to_owned(), angles });
        }
        let condition = |angle: &Measure| {
            let (name, quantity) = (angle.name().to_owned(), DesignQuantity::Named(angle.clone()));
            Self::range(name, quantity, least..=core::f64::consts::PI - least, period, instants)
        };
        found.into_iter().map(condition).collect()
    }

    /// Tightens the condition: a slack must be greater by this.
    pub(crate) fn tighten(&mut self, slack: f64) {
        match self {
            Self::Sum { .. } => {}
            Self::Margins { least, .. } => *least += slack,
            Self::Range { low, high, .. } => {
                let size = if (*high - *low).is_finite() { *high - *low } else { 1.0 };
                (*low, *high) = (*low + slack * size, *high - slack * size);
            }
        }
    }

    /// Its name; the bounds of an angle are in degrees.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Sum { name, .. } => name.clone(),
            Self::Margins { least, .. } => format!("turns with margins above {least}"),
            Self::Range {
                name,
                quantity: DesignQuantity::Named(quantity) | DesignQuantity::Angle(quantity),
                low,
                high,
                ..
            } if quantity.is_angle() => {
                // Rounded, because the conversion from degrees to radians has changed the last digits.
                let [low, high] = [low, high].map(|bound| (bound.to_degrees() * 1e9).round() / 1e9);
                format!("{name} in {low}°..{high}°")
            }
            Self::Range { name, low, high, .. } => format!("{name} in {low}..{high}"),
        }
    }
}
