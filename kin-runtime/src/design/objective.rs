//! What a mechanism is to do: quantities that are to have given values at instants that are given or free, and
//! functions of quantities that are to be 0 or least.

use super::error::DesignError;
use crate::measure::{Measure, Needs};
use crate::model::Model;
use crate::results::varied::{Number, Varied};
use core::f64::consts::TAU;
use core::fmt;
use std::sync::Arc;

/// In which direction of time a path is to be passed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// With time.
    #[default]
    Forward,
    /// Against it.
    Backward,
    /// Either way: every start takes one of them at random.
    Either,
}

/// A number of the motion.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum DesignQuantity {
    /// A quantity by name.
    Named(Measure),
    /// The angle of a body, of which whole turns do not count.
    Angle(Measure),
    /// x, y or φ of a body.
    Pose(usize, usize),
}

impl DesignQuantity {
    /// The quantity of this name.
    pub(crate) fn named(model: &'static Model, name: &str) -> Result<Self, DesignError> {
        if let Some(measure) = Measure::named(model, name) {
            if !measure.has_derivatives() {
                return Err(DesignError::NoDerivatives { quantity: name.to_owned() });
            }
            let angle = model.coordinates.iter().any(|info| info.name == name && info.kind.is_angle());
            return Ok(if angle { Self::Angle(measure) } else { Self::Named(measure) });
        }
        let pose = name.rsplit_once('.').and_then(|(body, component)| {
            let axis = ["x", "y", "phi"].iter().position(|axis| *axis == component)?;
            Some(Self::Pose(model.bodies.iter().position(|info| info.name == body)?, axis))
        });
        pose.ok_or_else(|| DesignError::UnknownQuantity { quantity: name.to_owned() })
    }

    /// Both components of a point.
    pub(crate) fn point(model: &'static Model, name: &str) -> Result<Vec<Self>, DesignError> {
        if !model.points.iter().any(|info| info.name == name) {
            return Err(DesignError::UnknownQuantity { quantity: name.to_owned() });
        }
        ["x", "y"].iter().map(|axis| Self::named(model, &format!("{name}.{axis}"))).collect()
    }

    /// x, y and φ of a body.
    pub(crate) fn pose(model: &'static Model, name: &str) -> Result<Vec<Self>, DesignError> {
        let index = model.bodies.iter().position(|info| info.name == name);
        let index = index.ok_or_else(|| DesignError::UnknownQuantity { quantity: name.to_owned() })?;
        Ok((0..3).map(|axis| Self::Pose(index, axis)).collect())
    }

    /// What its value needs.
    pub(crate) fn needs(&self) -> Needs {
        match self {
            Self::Named(measure) | Self::Angle(measure) => measure.needs(),
            Self::Pose(..) => Needs { observed: true, ..Needs::LEAST },
        }
    }

    /// The number with its derivatives with respect to parameters.
    pub(crate) fn varied(&self, model: &Model, varied: &Varied) -> Option<Number> {
        match self {
            Self::Named(measure) | Self::Angle(measure) => measure.varied(model, varied),
            Self::Pose(index, axis) => Some(varied.observed.get(model.bodies[*index].observables[*axis])?.value),
        }
    }

    /// ∂/∂t of a component of a point; other quantities have no free instants.
    pub(crate) fn rate(&self, model: &Model, varied: &Varied) -> f64 {
        let Self::Named(measure) = self else { return f64::NAN };
        measure.next_order().and_then(|rate| rate.varied(model, varied)).map_or(f64::NAN, Number::value)
    }

    /// By how much a value misses another.
    pub(crate) fn miss(&self, value: f64, wanted: f64) -> f64 {
        let miss = value - wanted;
        match self {
            Self::Angle(_) | Self::Pose(_, 2) => miss - TAU * (miss / TAU).round(),
            _ => miss,
        }
    }
}

/// Instants that are variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FreeInstants {
    pub(crate) period: f64,
    pub(crate) direction: Direction,
}

/// A function of quantities at all instants, which gives numbers that are to be 0.
pub(crate) type Residuals = Arc<dyn Fn(&[Vec<Number>]) -> Vec<Number> + Send + Sync>;

/// A function of quantities at all instants, which gives a number that is to be least.
pub(crate) type Least = Arc<dyn Fn(&[Vec<f64>]) -> f64 + Send + Sync>;

/// What is wanted of quantities.
#[derive(Clone)]
pub(crate) enum Requirement {
    /// For every instant the values of all quantities, and the weight of each quantity.
    Values(Vec<Vec<f64>>, Vec<f64>),
    /// Such that these are 0.
    Zeros(Residuals),
    /// Such that this is least.
    Least(Least),
}

/// Quantities at instants.
#[derive(Clone)]
pub(crate) struct Objective {
    pub(crate) quantities: Vec<DesignQuantity>,
    pub(crate) wanted: Requirement,
    /// The instants; empty where they are free.
    pub(crate) times: Vec<f64>,
    pub(crate) free: Option<FreeInstants>,
}

impl Objective {
    pub(crate) fn timed(
        quantities: Vec<DesignQuantity>,
        weights: Vec<f64>,
        wanted: impl Iterator<Item = (f64, Vec<f64>)>,
    ) -> Result<Self, DesignError> {
        let (times, values): (Vec<f64>, Vec<Vec<f64>>) = wanted.unzip();
        Self { quantities, wanted: Requirement::Values(values, weights), times, free: None }.checked()
    }

    pub(crate) fn untimed(
        quantities: Vec<DesignQuantity>,
        values: Vec<Vec<f64>>,
        period: f64,
        direction: Direction,
    ) -> Result<Self, DesignError> {
        if !(period.is_finite() && period > 0.0) {
            return Err(DesignError::NotFinite { what: "the period" });
        }
        let weights = vec![1.0; quantities.len()];
        // A path without places has no instants either.
        let free = (!values.is_empty()).then_some(FreeInstants { period, direction });
        Self { quantities, wanted: Requirement::Values(values, weights), times: Vec::new(), free }.checked()
    }

    pub(crate) fn zeros(
        quantities: Vec<DesignQuantity>,
        times: &[f64],
        residuals: Residuals,
    ) -> Result<Self, DesignError> {
        Self { quantities, wanted: Requirement::Zeros(residuals), times: times.to_vec(), free: None }.checked()
    }

    pub(crate) fn least(quantities: Vec<DesignQuantity>, times: &[f64], least: Least) -> Result<Self, DesignError> {
        Self { quantities, wanted: Requirement::Least(least), times: times.to_vec(), free: None }.checked()
    }

    fn checked(self) -> Result<Self, DesignError> {
        if !self.times.iter().all(|t| t.is_finite()) {
            return Err(DesignError::NotFinite { what: "the instants" });
        }
        match &self.wanted {
            Requirement::Values(values, weights)
                if !values.iter().flatten().chain(weights).all(|value| value.is_finite()) =>
            {
                Err(DesignError::NotFinite { what: "what is wanted" })
            }
            _ => Ok(self),
        }
    }

    /// How many instants it has.
    pub(crate) fn instants(&self) -> usize {
        match &self.wanted {
            Requirement::Values(values, _) => values.len(),
            Requirement::Zeros(_) | Requirement::Least(_) => self.times.len(),
        }
    }

    /// Variables of its own: as many as it has instants that are free.
    pub(crate) fn variables(&self) -> usize {
        if self.free.is_some() { self.instants() } else { 0 }
    }

    /// The wanted values, each times its weight.
    pub(crate) fn weighted(&self) -> impl Iterator<Item = f64> + '_ {
        let (values, weights) = match &self.wanted {
            Requirement::Values(values, weights) => (&values[..], &weights[..]),
            Requirement::Zeros(_) | Requirement::Least(_) => (&[][..], &[][..]),
        };
        values.iter().flat_map(move |values| values.iter().zip(weights).map(|(value, weight)| value * weight))
    }

    /// What quantities need.
    pub(crate) fn needs(&self) -> Needs {
        self.quantities.iter().fold(Needs::LEAST, |needs, quantity| needs.and(quantity.needs()))
    }
}

/// All but the function.
impl fmt::Debug for Objective {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Objective").field("of", &self.quantities).field("times", &self.times).finish_non_exhaustive()
    }
}
