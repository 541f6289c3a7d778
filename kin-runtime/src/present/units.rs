//! Units of what is shown, as the description says them.

use crate::model::{self, Model};
use crate::serial::Named;

/// The units of what a mechanism reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Units {
    units: model::Units,
    /// Whether angles are shown in degrees.
    degrees: bool,
}

/// The units of a result, for another program.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct UnitsRecord {
    length: Option<&'static str>,
    time: Option<&'static str>,
    angle: &'static str,
    /// Of scalar coordinates, inputs and defines by their names without index.
    named: Named<&'static str>,
}

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// Something whose unit is known.
    In(&'static str),
    /// Something that nobody has named.
    Unknown,
}

impl Units {
    /// Those of a mechanism.
    pub(crate) fn of(model: &Model) -> Self {
        Self { units: model.units, degrees: false }
    }

    /// With angles in degrees, if they are to be.
    pub(crate) fn in_degrees(self, degrees: bool) -> Self {
        Self { degrees, ..self }
    }

    /// For another program.
    pub(crate) fn record(&self) -> UnitsRecord {
        let angle = if self.degrees { "deg" } else { "rad" };
        let shown = |unit: &'static str| if unit == "rad" { angle } else { unit };
        let named = self.units.named.iter().map(|(name, unit)| (*name, shown(unit))).collect();
        UnitsRecord { length: self.units.length, time: self.time(), angle, named }
    }

    /// The unit of time: s unless another is written.
    pub(crate) fn time(&self) -> Option<&'static str> {
        self.units.time.or(Some("s"))
    }

    /// What a quantity measures that is called so: `crank.x`, `B.angle`, `reach`.
    pub(crate) fn measure(&self, name: &str) -> Measure {
        match name.rsplit_once('.') {
            Some((_, "x" | "y" | "stroke" | "distance" | "length")) => Measure::Length,
            Some((_, "phi" | "angle" | "theta")) => Measure::Angle,
            _ => match self.units.of(name) {
                Some("rad") => Measure::Angle,
                Some(unit) => Measure::In(unit),
                None => Measure::Unknown,
            },
        }
    }

    /// The unit of the derivative of an order.
    pub(crate) fn derivative(&self, measure: Measure, order: usize) -> Option<String> {
        let base = match measure {
            Measure::Length => self.units.length?,
            Measure::Angle if self.degrees => "°",
            Measure::Angle => "rad",
            Measure::In(unit) => unit,
            Measure::Unknown => return None,
        };
        let time = self.time();
        // The rate of m/s is in m/s².
        let (above, power) = match time.and_then(|time| base.strip_suffix(time)?.strip_suffix('/')) {
            Some(above) => (above, order + 1),
            None => (base, order),
        };
        match (power, time) {
            (0, _) => Some(base.to_owned()),
            (1, Some(time)) => Some(format!("{above}/{time}")),
            (2, Some(time)) => Some(format!("{above}/{time}²")),
            (3, Some(time)) => Some(format!("{above}/{time}³")),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_in_units_of_time() {
        let named = &[("reach", "mm"), ("speed", "mm/s"), ("turn", "rad")];
        let units = Units { units: model::Units { length: Some("m"), time: Some("s"), named }, degrees: false };
        let shown = |name, order| units.derivative(units.measure(name), order).unwrap_or_default();
        assert_eq!(
            ["crank.x", "crank.phi", "reach", "speed", "turn", "other"].map(|name| shown(name, 1)),
            ["m/s", "rad/s", "mm/s", "mm/s²", "rad/s", ""]
        );
        assert_eq!([shown("speed", 0), shown("speed", 2), shown("reach", 2)], ["mm/s", "mm/s³", "mm/s²"]);
        let degrees = Units { degrees: true, ..units };
        assert_eq!(degrees.derivative(degrees.measure("turn"), 1).as_deref(), Some("°/s"));
        let none = Units { units: model::Units::NONE, ..units };
        assert_eq!(
            [none.derivative(Measure::Length, 0), none.derivative(Measure::Angle, 1)],
            [None, Some("rad/s".to_owned())]
        );
    }
}
