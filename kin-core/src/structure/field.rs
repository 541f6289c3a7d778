//! Arithmetic modulo the prime p = 2⁶¹ − 1, which is exact, so that rounding errors cannot affect a rank.
//!
//! A rational expression that is not identically zero has a non-zero residue at all points of F_p except a fraction
//! degree/p of them. Therefore one random point gives the generic rank of a matrix of such expressions almost certainly
//! (Schwartz 1980, Zippel 1979). Since p ≡ 3 (mod 4), −1 is not a square, and the rational parametrisation of the
//! circle has no pole.

use crate::expr::ROUNDING;
use core::ops::{Add, Mul, Neg, Sub};

/// p = 2⁶¹ − 1.
const P: u64 = (1 << 61) - 1;
/// The largest denominator of a fraction as which a decimal number is interpreted.
const DENOMINATOR: i64 = 1 << 20;

/// A residue modulo p.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Residue(u64);

impl Residue {
    pub(crate) const ZERO: Self = Self(0);
    pub(crate) const ONE: Self = Self(1);

    /// The residue of an integer.
    pub(crate) fn integer(value: i64) -> Self {
        let magnitude = Self(value.unsigned_abs() % P);
        if value < 0 { -magnitude } else { magnitude }
    }

    /// The residue of the number that `value` approximates: the fraction with the smallest denominator that agrees with it
    /// up to rounding (1/3, 0.1, and 0.3 for 0.1 + 0.2), or else its exact binary value.
    pub(crate) fn number(value: f64) -> Self {
        if let Some((p, q)) = fraction(value, ROUNDING) {
            return Self::integer(p) * Self::integer(q).inverse();
        }
        let bits = value.to_bits();
        let (exponent, mantissa) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = match exponent {
            0 => (mantissa, -1074),
            e => (mantissa | (1 << 52), i64::try_from(e).unwrap_or(0) - 1075),
        };
        // 2 has the multiplicative order 61, so its powers repeat with that period.
        let power = Self(1 << exponent.rem_euclid(61));
        let magnitude = Self(mantissa % P) * power;
        if value < 0.0 { -magnitude } else { magnitude }
    }

    pub(crate) fn is_zero(self) -> bool {
        self.0 == 0
    }

    /// 1/x by Fermat's little theorem; 0 for 0.
    pub(crate) fn inverse(self) -> Self {
        self.power(P - 2)
    }

    pub(crate) fn power(self, mut exponent: u64) -> Self {
        let (mut base, mut result) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * base;
            }
            base = base * base;
            exponent >>= 1;
        }
        result
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Self(if sum >= P { sum - P } else { sum })
    }
}

impl Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Self(if self.0 == 0 { 0 } else { P - self.0 })
    }
}

impl Mul for Residue {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // Since 2⁶¹ ≡ 1, the high part is added to the low part.
        let product = u128::from(self.0) * u128::from(other.0);
        let folded = (product as u64 & P) + (product >> 61) as u64;
        Self(if folded >= P { folded - P } else { folded })
    }
}

/// The fraction p/q with the smallest q that equals `value`, or is within the relative `tolerance`, by continued
/// fractions.
pub(crate) fn fraction(value: f64, tolerance: f64) -> Option<(i64, i64)> {
    if !value.is_finite() || value.abs() > 1e9 {
        return None;
    }
    let (mut before, mut last) = ((0_i64, 1_i64), (1_i64, 0_i64));
    let mut rest = value;
    for _ in 0..24 {
        let whole = rest.floor();
        if whole.abs() > 1e12 {
            return None;
        }
        let next = ((whole as i64).checked_mul(last.0)?.checked_add(before.0)?, (whole as i64) * last.1 + before.1);
        if next.1 > DENOMINATOR || next.0.abs() > 1 << 52 {
            return None;
        }
        let found = next.0 as f64 / next.1 as f64;
        if (found - value).abs() <= tolerance * value.abs() {
            return Some(next);
        }
        (before, last) = (last, next);
        rest = (rest - whole).recip();
    }
    None
}

/// Reproducible random values: each depends only on the seed and on the kind and number of the object.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draw(pub(crate) u64);

impl Draw {
    /// A random residue for object `key` of a kind.
    pub(crate) fn residue(self, kind: u64, key: u64) -> Residue {
        let mut state = self.0 ^ mixed(kind.wrapping_mul(0x9e37_79b9_7f4a_7c15)) ^ mixed(key);
        loop {
            state = mixed(state);
            let value = state >> 3;
            if value < P && value > 1 {
                return Residue(value);
            }
        }
    }
}

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014).
fn mixed(value: u64) -> u64 {
    let z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn field_laws_hold() {
        let draw = Draw(7);
        for k in 0..200 {
            let [a, b, c] = [0, 1, 2].map(|kind| draw.residue(kind, k));
            assert_eq!(a * (b + c), a * b + a * c);
            assert_eq!((a - b) + b, a);
            assert_eq!(a * a.inverse(), Residue::ONE);
            assert_eq!(a + -a, Residue::ZERO);
            assert!((a * a + b * b) != Residue::ZERO && a != b);
        }
        assert_eq!(Residue::integer(-3) * Residue::integer(-3), Residue::integer(9));
        assert_eq!(Residue::ZERO.inverse(), Residue::ZERO);
    }

    #[test]
    fn numbers_are_what_the_source_means() {
        let third = Residue::number(1.0 / 3.0);
        assert_eq!(third * Residue::integer(3), Residue::ONE);
        assert_eq!(Residue::number(0.3) * Residue::number(0.1), Residue::number(0.03));
        assert_eq!(Residue::number(-2.5), -Residue::number(2.5));
        assert_eq!(Residue::number(0.1 + 0.2), Residue::number(0.3));
        assert_eq!(Residue::number(0.7 * 0.1), Residue::number(0.07));
        assert_eq!(Residue::number(0.0), Residue::ZERO);
        assert_eq!(Residue::number(f64::MIN_POSITIVE) * Residue::integer(2), Residue::number(2.0 * f64::MIN_POSITIVE));
        let pi = std::f64::consts::PI;
        assert_eq!(Residue::number(2.0 * pi), Residue::number(pi) * Residue::integer(2));
        assert_eq!(fraction(2.0_f64.sqrt() / 2.0 / 0.5_f64.sqrt(), 1e-15), Some((1, 1)));
        assert_eq!(fraction(f64::NAN, 0.0), None);
    }
}
