//! The units of forces, moments, energies and powers, which follow from the written units of masses, lengths and times.

use super::checker::{Checker, base, texts};
use super::derived::derive;
use super::parse::parse;
use super::unit::Unit;
use crate::mechanism::Mechanism;

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

fn known(mechanism: &Mechanism) -> Option<ForceUnits> {
    let checker = Checker::new(mechanism);
    let (length, time) = (checker.length.scale?, checker.time.scale?);
    // If no mass has a unit, that of a force or a stiffness determines it.
    let units = texts(mechanism).filter_map(|(_, text)| parse(text).ok());
    let of_others = |unit: Unit| {
        let [a, b, c] = unit.powers;
        (c.abs() > 0.5).then_some(())?;
        Some((unit.scale? / (length.powf(a) * time.powf(b))).powf(1.0 / c))
    };
    let mass = checker.mass.scale.or_else(|| units.filter_map(of_others).next())?;
    let unit = |a: f64, b: f64| Unit { powers: [a, b, 1.0], scale: Some(mass * length.powf(a) * time.powf(b)) };
    let symbol = |unit: Unit| {
        let found = SYMBOLS.into_iter().find(|symbol| parse(symbol).is_ok_and(|known| known.agrees(unit)))?;
        Some(found.replace('u', "µ"))
    };
    let names = derive(mechanism);
    let (length, time) = (names.length?, names.time?);
    let force = symbol(unit(1.0, -2.0)).unwrap_or_else(|| {
        let mass = base(mechanism, 2).map_or("kg", |base| base.symbol);
        format!("{mass}·{length}/{time}²")
    });
    let moment = format!("{force}·{length}");
    let energy = symbol(unit(2.0, -2.0)).unwrap_or_else(|| moment.clone());
    let power = symbol(unit(2.0, -3.0)).unwrap_or_else(|| format!("{moment}/{time}"));
    Some(ForceUnits { force: Some(force), moment: Some(moment), energy: Some(energy), power: Some(power) })
}
