//! Units of parameters, checked for consistency where an expression adds, compares or equates quantities.
//!
//! A lint that is asked for: kin computes with plain numbers in any consistent units. Rules:
//!
//! - Lengths, times, masses and angles; an angle is a number, and radians are its unit. Different scales of one kind
//!   (mm and m, deg and rad) are inconsistent.
//! - x and y of bodies and points, and distances, are lengths in the first unit of length among the parameters; φ is an
//!   angle; t is a time in the first unit of time, or s; `dot` divides by it.
//! - A plain number takes the unit that its surroundings want: in `l + 0.1` it is a length, in `2*l` a factor; with
//!   time or with another number, as in `2*t` and `0.1*sin(a)`, the product is as free as the number. A factor of a
//!   conversion (powers of ten, 12, 25.4, 30, 60, 180, …) leaves the scale open: `l_mm/1000`, `n*2*pi/60`.
//! - Parameters without a unit, scalar coordinates, inputs and supplied functions fit everywhere.
//! - Arguments of sin, cos, tan, asin, acos, atan, exp and ln are numbers; so are their results.

mod check;
mod parse;
mod quantity;

pub use check::check;
pub use parse::{UnknownUnit, parse};

use core::fmt;

/// A unit: powers of length, time and mass, and how many SI units it is; an open scale fits every other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Exponents of length, time and mass.
    pub powers: [f64; 3],
    /// In SI units; `None` after a conversion.
    pub scale: Option<f64>,
}

/// Exponents and scales that differ by rounding are equal.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-300) || (a - b).abs() < 1e-12 && a.abs() < 1e-12
}

impl Unit {
    /// A number; an angle in radians.
    pub const NUMBER: Self = Self { powers: [0.0; 3], scale: Some(1.0) };

    /// The base unit of length (0), time (1) or mass (2), `scale` SI units large.
    const fn base(kind: usize, scale: f64) -> Self {
        let mut powers = [0.0; 3];
        powers[kind] = 1.0;
        Self { powers, scale: Some(scale) }
    }

    /// The product of two units.
    fn times(self, other: Self) -> Self {
        let [a, b, c] = self.powers;
        let [d, e, f] = other.powers;
        let scale = self.scale.zip(other.scale).map(|(a, b)| a * b);
        Self { powers: [a + d, b + e, c + f], scale }
    }

    /// The unit to a power.
    fn power(self, n: f64) -> Self {
        Self { powers: self.powers.map(|p| p * n), scale: self.scale.map(|s| s.powf(n)) }
    }

    /// True for what has no length, time or mass in it.
    fn is_number(self) -> bool {
        self.powers.iter().all(|p| p.abs() < 1e-9)
    }

    /// True for time and its powers alone.
    fn is_time(self) -> bool {
        self.powers[0].abs() < 1e-9 && self.powers[2].abs() < 1e-9 && self.powers[1] > 1e-9
    }

    /// True when quantities in the two units can be added.
    pub fn agrees(self, other: Self) -> bool {
        let powers = self.powers.iter().zip(&other.powers).all(|(a, b)| (a - b).abs() < 1e-9);
        powers && self.scale.zip(other.scale).is_none_or(|(a, b)| near(a, b))
    }
}

impl fmt::Display for Unit {
    /// In SI units, after their factor: `m/s`, `0.001 m`; an angle or a number is called so.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_number() {
            return match (self.scale, parse::symbol_of(*self)) {
                (_, Some(symbol)) => f.write_str(symbol),
                (Some(scale), _) if !near(scale, 1.0) => write!(f, "{scale} rad"),
                _ => f.write_str("a number or rad"),
            };
        }
        if let Some(symbol) = parse::symbol_of(*self) {
            return f.write_str(symbol);
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
