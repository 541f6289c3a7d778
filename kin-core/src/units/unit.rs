//! The type of units.

/// A unit: powers of length, time and mass, and its size in SI units; an open scale agrees with every other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Exponents of length, time and mass.
    pub powers: [f64; 3],
    /// Its size in SI units; `None` (open) after multiplication by a typical factor of conversions.
    pub scale: Option<f64>,
}

/// True for exponents or scales that are equal up to rounding.
pub(super) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-300) || (a - b).abs() < 1e-12 && a.abs() < 1e-12
}

impl Unit {
    /// The unit of numbers, and of angles in radians.
    pub const NUMBER: Self = Self { powers: [0.0; 3], scale: Some(1.0) };

    /// The base unit of length (0), time (1) or mass (2), `scale` SI units large.
    pub(super) const fn base(kind: usize, scale: f64) -> Self {
        let mut powers = [0.0; 3];
        powers[kind] = 1.0;
        Self { powers, scale: Some(scale) }
    }

    /// The product of two units.
    pub fn times(self, other: Self) -> Self {
        let [a, b, c] = self.powers;
        let [d, e, f] = other.powers;
        let scale = self.scale.zip(other.scale).map(|(a, b)| a * b);
        Self { powers: [a + d, b + e, c + f], scale }
    }

    /// The unit to a power.
    pub fn power(self, n: f64) -> Self {
        Self { powers: self.powers.map(|p| p * n), scale: self.scale.map(|s| s.powf(n)) }
    }

    /// True for a unit without length, time and mass.
    pub fn is_number(self) -> bool {
        self.powers.iter().all(|p| p.abs() < 1e-9)
    }

    /// True for positive powers of time.
    #[cfg(feature = "compiler")]
    pub(super) fn is_time(self) -> bool {
        self.powers[0].abs() < 1e-9 && self.powers[2].abs() < 1e-9 && self.powers[1] > 1e-9
    }

    /// True for a unit that contains a length.
    #[cfg(feature = "compiler")]
    pub(super) fn has_length(self) -> bool {
        self.powers[0].abs() > 1e-9
    }

    /// True for units of one kind, whatever their scales.
    pub fn is_like(self, other: Self) -> bool {
        self.powers.iter().zip(&other.powers).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    /// True when quantities in the two units can be added.
    pub fn agrees(self, other: Self) -> bool {
        self.is_like(other) && self.scale.zip(other.scale).is_none_or(|(a, b)| near(a, b))
    }
}
