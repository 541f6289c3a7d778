//! The dimensions of quantities, and their units.

use crate::model::{Component, CoordinateKind, JointKind, Model, Units};

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

    /// The dimension of a coordinate.
    pub(super) fn of_coordinate(model: &Model, index: usize) -> Self {
        let coordinate = &model.coordinates[index];
        match coordinate.kind {
            CoordinateKind::Pose { component: Component::Phi, .. } => Self::Angle,
            CoordinateKind::Pose { .. } => Self::Length,
            CoordinateKind::Scalar => Self::named(&model.units, coordinate.name),
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

/// The dimension of what a driving row prescribes, that of a displacement where it is a speed. A row that a driver or
/// an equation writes prescribes a coordinate, or a sum or difference of coordinates of one dimension; the dimension of any
/// other expression is not known.
pub(super) fn driven_dimension(model: &Model, row: usize) -> Dimension {
    let info = &model.rows[row];
    let joint = &model.joints[info.joint];
    if joint.keeps_distance() || joint.kind.prescribes_length() || joint.kind == JointKind::Speed {
        return Dimension::Length;
    }
    if joint.kind.prescribes_angle() {
        return Dimension::Angle;
    }
    // The rows of guides, welds and rolling discs that have an angle or an offset.
    match info.name.strip_prefix(joint.name) {
        Some(".angle") => return Dimension::Angle,
        Some(".roll") => return Dimension::Length,
        _ => {}
    }
    let pattern = &model.constraint_pattern;
    let is_unit = |entry: usize| pattern.constants.iter().any(|&(index, value)| index == entry && value.abs() == 1.0);
    let entries = pattern.entries.iter().enumerate().filter(|(_, (other, _))| *other == row);
    let mut dimensions = entries
        .map(|(k, (_, column))| if is_unit(k) { Dimension::of_coordinate(model, *column) } else { Dimension::Unknown });
    let first = dimensions.next().unwrap_or(Dimension::Unknown);
    if dimensions.all(|dimension| dimension == first) { first } else { Dimension::Unknown }
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
