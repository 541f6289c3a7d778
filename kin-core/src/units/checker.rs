//! The state of the check of units.

use super::parse::{UnknownUnit, angle_factor, factors, parse};
use super::unit::Unit;
use crate::error::{ModelError, Origin};
use crate::mechanism::{Formula, Mechanism, Member};
use QuantityUnit::{Any, Of};
use std::collections::BTreeMap;

/// The unit of a quantity, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub(super) enum QuantityUnit {
    /// Not known: it agrees with every unit.
    Any,
    /// A plain number, which takes any unit that is expected.
    Plain,
    /// t or a power of it: in products a time; in sums and comparisons it takes any unit, as a number does, so that
    /// `phi = t` means one radian per unit of time.
    Clock(Unit),
    /// A number times an angle in rad, as in `2*crank.phi`: it takes any unit that is expected, as a plain number does,
    /// except degrees and turns.
    MultipleOfAngle,
    /// A quantity with this unit.
    Of(Unit),
}

/// The state of checking units.
pub(super) struct Checker<'m> {
    pub(super) mechanism: &'m Mechanism,
    /// The written units of parameters, scalar coordinates, inputs and defines.
    pub(super) written: [Vec<Option<WrittenUnit>>; 4],
    /// The units with which scalar coordinates and inputs without a unit are compared, by kind, family and index; `None`
    /// for units that do not agree with one another.
    pub(super) compared: BTreeMap<(Named, usize, [i64; 2]), Option<WrittenUnit>>,
    /// The unit of positions.
    pub(super) length: Unit,
    /// The first name whose unit contains that unit, in words: ``the unit of `l1` ``.
    pub(super) first_length: Option<String>,
    /// The unit of t.
    pub(super) time: Unit,
    /// The unit of masses: the one that is written, or the one that follows from the units of loads.
    pub(super) mass: Unit,
    /// True if a unit of mass is written.
    pub(super) mass_is_written: bool,
    /// The units of the defines that have been checked.
    pub(super) defines: Vec<Option<(QuantityUnit, f64)>>,
    /// The origin of the current formula.
    pub(super) at: Origin,
    pub(super) errors: Vec<ModelError>,
}

/// A unit as it is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct WrittenUnit {
    pub(super) unit: Unit,
    /// The exponent of angles in it.
    pub(super) angle: f64,
}

impl WrittenUnit {
    /// The unit of what is compared with both; `None` if they do not agree.
    fn and(self, other: Self) -> Option<Self> {
        let unit = if self.unit.scale.is_some() { self.unit } else { other.unit };
        self.unit.agrees(other.unit).then_some(Self { unit, angle: self.angle.max(other.angle) })
    }
}

/// Kinds of names that may have a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Named {
    Parameter,
    Scalar,
    Input,
    Define,
}

/// All written units, with the names that have them.
pub(super) fn texts(mechanism: &Mechanism) -> impl Iterator<Item = (&str, &str)> {
    let m = mechanism;
    let parameters = m.parameters.iter().map(|p| (&p.name, &p.unit));
    let scalars_and_inputs =
        m.scalars.iter().map(|s| (&s.name, &s.unit)).chain(m.inputs.iter().map(|u| (&u.name, &u.unit)));
    let all = parameters.chain(scalars_and_inputs).chain(m.defines.iter().map(|d| (&d.name, &d.unit)));
    all.filter_map(|(name, unit)| Some((name.as_str(), unit.as_deref()?)))
}

/// A unit of length, time or mass in which a mechanism is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct BaseUnit<'m> {
    /// The first name whose unit contains it.
    pub(super) name: &'m str,
    pub(super) scale: f64,
    pub(super) symbol: &'m str,
    /// True if the unit of that name is this unit alone, as `mm` and not `N/mm`.
    pub(super) alone: bool,
}

/// The unit of length (0), time (1) or mass (2) that most of the written units contain, the first of these if several
/// are equally frequent: whoever writes one wrong unit gets an error at that one.
pub(super) fn base(mechanism: &Mechanism, kind: usize) -> Option<BaseUnit<'_>> {
    let all: Vec<BaseUnit<'_>> = texts(mechanism).filter_map(|(name, text)| base_in(name, text, kind)).collect();
    let uses = |base: &BaseUnit<'_>| all.iter().filter(|other| other.scale == base.scale).count();
    // Of equal elements, `max_by_key` returns the last.
    all.iter().rev().max_by_key(|base| uses(base)).copied()
}

/// The first unit of length, time or mass in a unit such as `mm/s`; none if such units cancel, as in `mm/m`.
fn base_in<'m>(name: &'m str, text: &'m str, kind: usize) -> Option<BaseUnit<'m>> {
    let read = |(symbol, power)| Some((parse(symbol).ok()?, symbol, power));
    let is_of_kind = |(unit, ..): &(Unit, &str, f64)| unit.is_like(Unit::base(kind, 1.0));
    let found: Vec<_> = factors(text).filter_map(read).filter(is_of_kind).collect();
    let &(unit, symbol, _) = found.first()?;
    let cancels = found.iter().map(|(.., power)| power).sum::<f64>() == 0.0;
    let scale = unit.scale.filter(|_| !cancels)?;
    Some(BaseUnit { name, scale, symbol, alone: symbol == text.trim() })
}

impl<'m> Checker<'m> {
    pub(super) fn new(mechanism: &'m Mechanism) -> Self {
        let mut checker = Self::with_units(mechanism, parse);
        if !checker.mass_is_written {
            checker.mass.scale = Self::mass_of_loads(mechanism);
        }
        checker
    }

    /// The state with units that `read` reads.
    pub(super) fn with_units(mechanism: &'m Mechanism, read: fn(&str) -> Result<Unit, UnknownUnit>) -> Self {
        let m = mechanism;
        let written = |unit: &Option<String>| {
            let text = unit.as_deref()?;
            Some(WrittenUnit { unit: read(text).ok()?, angle: angle_factor(text).exponent })
        };
        let [length, time, mass] = [0, 1, 2].map(|kind| base(m, kind));
        Self {
            mechanism,
            written: [
                m.parameters.iter().map(|p| written(&p.unit)).collect(),
                m.scalars.iter().map(|s| written(&s.unit)).collect(),
                m.inputs.iter().map(|u| written(&u.unit)).collect(),
                m.defines.iter().map(|d| written(&d.unit)).collect(),
            ],
            compared: BTreeMap::new(),
            length: Unit { powers: [1.0, 0.0, 0.0], scale: length.map(|base| base.scale) },
            first_length: length.map(|base| {
                let words = if base.alone { "the unit" } else { "the length in the unit" };
                format!("{words} of `{}`", base.name)
            }),
            time: Unit { powers: [0.0, 1.0, 0.0], scale: Some(time.map_or(1.0, |base| base.scale)) },
            mass: Unit { powers: [0.0, 0.0, 1.0], scale: mass.map(|base| base.scale) },
            mass_is_written: mass.is_some(),
            defines: vec![None; m.defines.len()],
            at: Origin::default(),
            errors: Vec::new(),
        }
    }

    /// The written unit of a name.
    pub(super) fn written(&self, named: Named, k: usize) -> Option<WrittenUnit> {
        self.written[named as usize].get(k).copied().flatten()
    }

    /// The quantity of a name, with or without a unit.
    pub(super) fn of(&self, named: Named, k: usize) -> QuantityUnit {
        self.written(named, k).map_or(Any, |written| Of(written.unit))
    }

    /// If the formula is the name of a scalar coordinate or an input alone, records the unit with which it is compared.
    /// Returns the unit with which it was compared before, if the two do not agree.
    pub(super) fn meets(&mut self, formula: &Formula, unit: Unit, angle: f64) -> Option<Unit> {
        let (named, member) = name_alone(formula)?;
        if self.written(named, member.family).is_some() {
            return None;
        }
        let met = WrittenUnit { unit, angle };
        let key = (named, member.family, [member.index.scale, member.index.offset]);
        let before = self.compared.entry(key).or_insert(Some(met)).as_mut()?;
        if let Some(both) = before.and(met) {
            *before = both;
            return None;
        }
        // In ranges one index may stand for different members.
        if member.index.scale == 0 {
            return Some(before.unit);
        }
        self.compared.insert(key, None);
        None
    }

    /// The unit with which all members of a family are compared.
    pub(super) fn compared(&self, named: Named, family: usize) -> Option<WrittenUnit> {
        let members = self.compared.range((named, family, [i64::MIN; 2])..=(named, family, [i64::MAX; 2]));
        members.map(|(_, met)| *met).reduce(|one, other| one?.and(other?)).flatten()
    }
}

/// The scalar coordinate or the input that a formula consists of, with any sign.
pub(super) fn name_alone(formula: &Formula) -> Option<(Named, &Member)> {
    match formula {
        Formula::Neg(a) => name_alone(a),
        Formula::Scalar(member) => Some((Named::Scalar, member)),
        Formula::Input(member) => Some((Named::Input, member)),
        _ => None,
    }
}
