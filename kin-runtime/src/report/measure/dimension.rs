//! The dimensions of quantities, and their units.

use crate::model::Units;

/// The dimension of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dimension {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// Another dimension, given by its unit.
    In(&'static str),
    /// Not known.
    Unknown,
}

impl Dimension {
    /// The dimension of a quantity by its name: `crank.x`, `B.angle`, `reach`.
    pub(crate) fn named(units: &Units, name: &str) -> Self {
        match name.rsplit_once('.') {
            Some((_, "x" | "y" | "stroke" | "distance" | "length")) => Self::Length,
            Some((_, "phi" | "angle" | "theta")) => Self::Angle,
            _ => match units.of(name) {
                Some("rad") => Self::Angle,
                Some(unit) => Self::In(unit),
                None => Self::Unknown,
            },
        }
    }

    /// The unit of the derivative of an order, with angles in degrees if `degrees`.
    pub(crate) fn unit(self, units: &Units, order: usize, degrees: bool) -> Option<String> {
        let base = match self {
            Self::Length => units.length?,
            Self::Angle if degrees => "°",
            Self::Angle => "rad",
            Self::In(unit) => unit,
            Self::Unknown => return None,
        };
        let time = time(units);
        // The rate of m/s is in m/s².
        let (above, power) = match base.strip_suffix(time).and_then(|above| above.strip_suffix('/')) {
            Some(above) => (above, order + 1),
            None => (base, order),
        };
        match power {
            0 => Some(base.to_owned()),
            1 => Some(format!("{above}/{time}")),
            2 => Some(format!("{above}/{time}²")),
            3 => Some(format!("{above}/{time}³")),
            _ => None,
        }
    }
}

/// The unit of time: s unless the description has another.
pub(crate) fn time(units: &Units) -> &'static str {
    units.time.unwrap_or("s")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_in_units_of_time() {
        let named = &[("reach", "mm"), ("speed", "mm/s"), ("turn", "rad")];
        let units = Units { length: Some("m"), time: Some("s"), named };
        let shown = |name, order| Dimension::named(&units, name).unit(&units, order, false).unwrap_or_default();
        assert_eq!(
            ["crank.x", "crank.phi", "reach", "speed", "turn", "other"].map(|name| shown(name, 1)),
            ["m/s", "rad/s", "mm/s", "mm/s²", "rad/s", ""]
        );
        assert_eq!([shown("speed", 0), shown("speed", 2), shown("reach", 2)], ["mm/s", "mm/s³", "mm/s²"]);
        assert_eq!(Dimension::named(&units, "turn").unit(&units, 1, true).as_deref(), Some("°/s"));
        assert_eq!(Dimension::Length.unit(&Units::NONE, 0, false), None);
        assert_eq!(Dimension::Angle.unit(&Units::NONE, 1, false).as_deref(), Some("rad/s"));
    }
}
