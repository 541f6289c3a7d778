//! The units of forces, moments, energies and powers, which follow from the written units of masses, lengths and times.

use super::checker::{Checker, QuantityUnit::Of, base, texts};
use super::derived::derive;
use super::parse::{in_radians, parse};
use super::unit::{Unit, near};
use crate::mechanism::{Dimension, Mechanism};

/// The units of forces, as text; all `None` if no written unit determines that of masses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ForceUnits {
    /// Of forces.
    pub force: Option<String>,
    /// Of moments.
    pub moment: Option<String>,
    /// Of energies.
    pub energy: Option<String>,
    /// Of powers.
    pub power: Option<String>,
}

/// Symbols for forces, energies and powers.
const SYMBOLS: [&str; 14] = ["N", "kN", "mN", "MN", "uN", "J", "kJ", "mJ", "MJ", "W", "kW", "mW", "MW", "uW"];

/// The units of forces of a mechanism that has passed all checks.
pub fn force_units(mechanism: &Mechanism) -> ForceUnits {
    known(mechanism).unwrap_or_default()
}

impl Checker<'_> {
    /// The unit of masses, in kg, that follows from the units of loads where no unit of mass is written: that of most forces,
    /// couples, stiffnesses and dampings, the first of these if several are equally frequent. If no load has a known unit, it
    /// is that of the first unit that contains a mass.
    pub(super) fn mass_of_loads(mechanism: &Mechanism) -> Option<f64> {
        // Angles are in rad, so that N*m/deg says that couples are in N*m, and is itself a mistake.
        let mut checker = Checker::with_units(mechanism, in_radians);
        let (length, time) = (checker.length.scale?, checker.time.scale?);
        let mass_in = |unit: Unit| {
            let [a, b, c] = unit.powers;
            (c.abs() > 0.5).then_some(())?;
            Some((unit.scale? / (length.powf(a) * time.powf(b))).powf(1.0 / c))
        };
        let mut masses = Vec::new();
        for (slot, operand) in mechanism.loads.iter().flat_map(|load| load.operands.iter()) {
            let Dimension::Derived(powers) = slot.dimension else { continue };
            let [mass, length, time] = powers.map(f64::from);
            for formula in operand.formulas() {
                if let Of(unit) = checker.quantity(formula)
                    && unit.is_like(Unit { powers: [length, time, mass], scale: None })
                {
                    masses.extend(mass_in(unit));
                }
            }
        }
        let uses = |mass: &f64| masses.iter().filter(|other| near(**other, *mass)).count();
        // Of equal elements, `max_by_key` returns the last.
        let of_most = masses.iter().rev().max_by_key(|mass| uses(mass)).copied();
        of_most.or_else(|| texts(mechanism).filter_map(|(_, text)| in_radians(text).ok()).find_map(mass_in))
    }
}

fn known(mechanism: &Mechanism) -> Option<ForceUnits> {
    let checker = Checker::new(mechanism);
    let (length, time) = (checker.length.scale?, checker.time.scale?);
    let mass = checker.mass.scale?;
    let unit = |a: f64, b: f64| Unit { powers: [a, b, 1.0], scale: Some(mass * length.powf(a) * time.powf(b)) };
    let symbol = |unit: Unit| {
        let found = SYMBOLS.into_iter().find(|symbol| parse(symbol).is_ok_and(|known| known.agrees(unit)))?;
        Some(found.replace('u', "µ"))
    };
    let names = derive(mechanism);
    let (length, time) = (names.length?, names.time?);
    let mass_symbol = base(mechanism, 2).map(|base| base.symbol).or_else(|| near(mass, 1.0).then_some("kg"));
    let of_mass = || mass_symbol.map(|mass| format!("{mass}·{length}/{time}²"));
    let force = symbol(unit(1.0, -2.0)).or_else(of_mass)?;
    let moment = format!("{force}·{length}");
    let energy = symbol(unit(2.0, -2.0)).unwrap_or_else(|| moment.clone());
    let power = symbol(unit(2.0, -3.0)).unwrap_or_else(|| format!("{moment}/{time}"));
    Some(ForceUnits { force: Some(force), moment: Some(moment), energy: Some(energy), power: Some(power) })
}
