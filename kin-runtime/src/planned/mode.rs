//! Assembly modes by name and sign.

use crate::plan::ModeInfo;
use core::fmt;

/// Which of its two closures a group has.
///
/// The sign is that of the root in the closed form of the group; it has no general geometric meaning. The modes of a
/// known configuration show which sign belongs to which closure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Sign {
    /// +1.
    #[cfg_attr(feature = "serde", serde(rename = "+"))]
    Plus,
    /// −1.
    #[cfg_attr(feature = "serde", serde(rename = "-"))]
    Minus,
}

impl Sign {
    /// The sign of a branch value ([`Mechanism::branches_with`](crate::Mechanism::branches_with)); `None` for 0 and
    /// NaN.
    pub fn of(closure: f64) -> Option<Self> {
        if closure > 0.0 {
            Some(Self::Plus)
        } else if closure < 0.0 {
            Some(Self::Minus)
        } else {
            None
        }
    }

    /// +1 or −1.
    pub const fn value(self) -> f64 {
        match self {
            Self::Plus => 1.0,
            Self::Minus => -1.0,
        }
    }

    /// The opposite sign.
    #[must_use]
    pub const fn flipped(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
}

impl fmt::Display for Sign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Self::Plus { "+" } else { "-" })
    }
}

/// A mode by its name or by its index in [`Plan::modes`](crate::plan::Plan::modes).
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeKey<'a> {
    /// The name of the mode.
    Name(&'a str),
    /// The index of the mode.
    Index(usize),
}

impl ModeKey<'_> {
    /// The index of the mode among `modes`.
    pub fn index_in(self, modes: &[ModeInfo]) -> Option<usize> {
        match self {
            Self::Name(name) => modes.iter().position(|mode| mode.name == name),
            Self::Index(index) => (index < modes.len()).then_some(index),
        }
    }
}

impl<'a> From<&'a str> for ModeKey<'a> {
    fn from(name: &'a str) -> Self {
        Self::Name(name)
    }
}

impl From<usize> for ModeKey<'_> {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

impl fmt::Display for ModeKey<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "`{name}`"),
            Self::Index(index) => write!(f, "{index}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closure_has_the_sign_of_its_number_and_none_where_there_is_none() {
        assert_eq!([Some(Sign::Plus), Some(Sign::Minus)], [1e-300, -1e-300].map(Sign::of));
        assert_eq!([None; 3], [0.0, -0.0, f64::NAN].map(Sign::of));
        assert_eq!([1.0, -1.0], [Sign::Plus, Sign::Minus].map(Sign::value));
        assert_eq!([Sign::Minus, Sign::Plus], [Sign::Plus, Sign::Minus].map(Sign::flipped));
    }

    #[test]
    fn a_mode_is_found_by_its_name_or_its_index() {
        let mode = |name| ModeInfo { name, step: 0, margin: 0 };
        let modes = [mode("A-B-D"), mode("E-F")];
        let index = |key: ModeKey<'_>| key.index_in(&modes);
        assert_eq!([Some(0), Some(1), None], ["A-B-D", "E-F", "E"].map(|name| index(name.into())));
        assert_eq!([Some(0), Some(1), None, None], [0, 1, 2, usize::MAX].map(|k| index(k.into())));
    }
}
