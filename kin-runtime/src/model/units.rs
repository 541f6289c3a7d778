//! Units of the quantities of a mechanism.

/// Units that are written in a description, and those that follow from them. Numbers are never converted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Of x, y and distances: the unit of length that most of the written units contain.
    pub length: Option<&'static str>,
    /// Of t: the unit of time that most of the written units contain, or s where units are written and none of them is a time.
    pub time: Option<&'static str>,
    /// Of scalar coordinates, inputs and defines, by their names without index; only those with a unit.
    pub named: &'static [(&'static str, &'static str)],
}

impl Units {
    /// No unit is known.
    pub const NONE: Self = Self { length: None, time: None, named: &[] };

    /// The unit of a scalar coordinate, an input or a define, with or without its index.
    pub fn of(&self, name: &str) -> Option<&'static str> {
        let family = name.split_once('[').map_or(name, |(family, _)| family);
        self.named.iter().find(|(other, _)| *other == family).map(|(_, unit)| *unit)
    }
}

impl core::fmt::Display for Units {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let common = [("lengths", self.length), ("time", self.time)];
        let common = common.into_iter().filter_map(|(noun, unit)| Some((noun, unit?)));
        let mut any = false;
        for (name, unit) in common.chain(self.named.iter().copied()) {
            write!(f, "{}{name} in {unit}", if any { ", " } else { "" })?;
            any = true;
        }
        if any { Ok(()) } else { f.write_str("no units") }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::Units;
    use std::string::ToString;

    #[test]
    fn members_have_the_unit_of_their_family() {
        let units = Units { named: &[("u", "m"), ("reach", "mm")], ..Units::NONE };
        assert_eq!([units.of("u[3]"), units.of("reach"), units.of("v")], [Some("m"), Some("mm"), None]);
        assert_eq!(Units { time: Some("s"), ..units }.to_string(), "time in s, u in m, reach in mm");
        assert_eq!(Units::NONE.to_string(), "no units");
    }
}
