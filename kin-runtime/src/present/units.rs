//! The units of results, from the description.

use super::json::{Record, record};
use crate::measure::{Dimension, Measure};
use crate::model::{self, Model};
use crate::serial::NamedValues;

/// The units of the results of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ResultUnits {
    units: model::Units,
    /// Whether angles are shown in degrees.
    degrees: bool,
}

impl ResultUnits {
    /// The units of a mechanism.
    pub(crate) fn of(model: &Model) -> Self {
        Self { units: model.units, degrees: false }
    }

    /// With angles in degrees, if `degrees` is true.
    pub(crate) fn in_degrees(self, degrees: bool) -> Self {
        Self { degrees, ..self }
    }

    /// The units as a record; those of scalar coordinates, inputs and defines by their names without index.
    pub(crate) fn record(&self) -> Record {
        let angle = if self.degrees { "deg" } else { "rad" };
        let shown = |unit: &'static str| if unit == "rad" { angle } else { unit };
        let named: NamedValues<&str> = self.units.named.iter().map(|(name, unit)| (*name, shown(unit))).collect();
        record! { length: self.units.length, time: self.time(), angle: angle, named: named }
    }

    /// The unit of time: s unless the description has another.
    pub(crate) fn time(&self) -> Option<&'static str> {
        self.units.time.or(Some("s"))
    }

    /// The dimension of a quantity by its name: `crank.x`, `B.angle`, `reach`.
    pub(crate) fn dimension(&self, name: &str) -> Dimension {
        Dimension::named(&self.units, name)
    }

    /// The unit of a value of this dimension; empty if it is not known.
    pub(crate) fn of_dimension(&self, dimension: Dimension) -> String {
        dimension.unit(&self.units, 0, self.degrees).unwrap_or_default()
    }

    /// The unit of a quantity by its name; empty if it is not known.
    pub(crate) fn of_name(&self, name: &str) -> String {
        self.of_dimension(self.dimension(name))
    }

    /// The unit of a quantity.
    pub(crate) fn of_measure(&self, measure: &Measure) -> Option<String> {
        measure.unit_in(&self.units, self.degrees).filter(|unit| !unit.is_empty())
    }
}
