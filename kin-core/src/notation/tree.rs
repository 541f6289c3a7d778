//! What a formula is made of.

use super::name::Name;

/// A formula as a person reads it: sums and products of several parts rather than trees of two.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// A number ≥ 0.
    Number(f64),
    /// A coordinate, a parameter, time, an input, or a rate of one.
    Name(Name),
    /// −a.
    Minus(Box<Formula>),
    /// Terms, each added or subtracted.
    Sum(Vec<(bool, Formula)>),
    /// Factors.
    Product(Vec<Formula>),
    /// a / b.
    Quotient(Box<Formula>, Box<Formula>),
    /// aⁿ with a constant n.
    Power(Box<Formula>, f64),
    /// A function of its arguments, with so many primes.
    Call(String, usize, Vec<Formula>),
}

impl Formula {
    /// How tightly it binds: sums least.
    pub(super) fn strength(&self) -> u8 {
        match self {
            Self::Sum(_) => 0,
            Self::Minus(_) => 1,
            Self::Product(_) | Self::Quotient(..) => 2,
            Self::Call(..) => 3,
            Self::Power(..) => 4,
            Self::Number(_) | Self::Name(_) => 5,
        }
    }

    /// 0, written out.
    pub fn is_zero(&self) -> bool {
        *self == Self::Number(0.0)
    }

    /// −a, with the signs of numbers and double signs gone.
    pub fn negated(self) -> Self {
        match self {
            Self::Minus(inner) => *inner,
            zero if zero.is_zero() => zero,
            other => Self::Minus(Box::new(other)),
        }
    }
}
