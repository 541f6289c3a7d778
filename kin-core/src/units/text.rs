//! Prints a unit.

use super::parse;
use super::unit::{Unit, near};
use core::fmt;

impl fmt::Display for Unit {
    /// A common symbol if there is one: `m/s`, `mm`, `deg`; otherwise SI units with a factor: `0.1 m`. The unit of
    /// plain numbers is `a number or rad`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_number() {
            return match (self.scale, parse::symbol_of(*self)) {
                (_, Some(symbol)) => f.write_str(symbol),
                (Some(scale), _) if !near(scale, 1.0) => {
                    let digits = (2.0 - scale.log10().floor()).clamp(3.0, 12.0) as usize;
                    write!(f, "{scale:.digits$} rad")
                }
                _ => f.write_str("a number or rad"),
            };
        }
        if let Some(symbol) = parse::symbol_of(*self) {
            return f.write_str(symbol);
        }
        // A unit per degree or per revolution.
        for angle in ["deg", "rev"] {
            if let Some(symbol) = parse::parse(angle).ok().and_then(|angle| parse::symbol_of(self.times(angle))) {
                return write!(f, "{symbol}/{angle}");
            }
        }
        if let Some(scale) = self.scale
            && !near(scale, 1.0)
        {
            write!(f, "{scale} ")?;
        }
        let named = || self.powers.iter().zip(["m", "s", "kg"]).filter(|(p, _)| p.abs() >= 1e-9);
        let factor = |f: &mut fmt::Formatter<'_>, p: f64, name: &str| match p {
            p if near(p, 1.0) => write!(f, "{name}"),
            p => write!(f, "{name}^{}", (p * 1e6).round() / 1e6),
        };
        let mut first = true;
        for (p, name) in named().filter(|(p, _)| **p > 0.0) {
            f.write_str(if first { "" } else { "·" })?;
            factor(f, *p, name)?;
            first = false;
        }
        if first {
            f.write_str("1")?;
        }
        for (p, name) in named().filter(|(p, _)| **p < 0.0) {
            f.write_str("/")?;
            factor(f, -p, name)?;
        }
        Ok(())
    }
}
