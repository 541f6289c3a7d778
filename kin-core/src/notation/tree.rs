//! The syntax tree of formulas.

use super::name::Name;

/// A formula in which sums and products have any number of parts.
#[derive(Clone, Debug, PartialEq)]
pub enum FormulaTree {
    /// A non-negative number.
    Number(f64),
    /// A coordinate, a parameter, time, an input, or a rate of one of these.
    Name(Name),
    /// −a.
    Minus(Box<FormulaTree>),
    /// A sum of terms; the flag says that the term is subtracted.
    Sum(Vec<(bool, FormulaTree)>),
    /// A product of factors.
    Product(Vec<FormulaTree>),
    /// a / b.
    Quotient(Box<FormulaTree>, Box<FormulaTree>),
    /// aⁿ for a constant n.
    Power(Box<FormulaTree>, f64),
    /// A function with its number of primes and its arguments.
    Call(String, usize, Vec<FormulaTree>),
}

impl FormulaTree {
    /// The binding strength; a sum binds least tightly.
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

    /// Calls `visit` with every name.
    pub(crate) fn for_each_name(&mut self, visit: &mut dyn FnMut(&mut Name)) {
        match self {
            Self::Number(_) => {}
            Self::Name(name) => visit(name),
            Self::Minus(a) | Self::Power(a, _) => a.for_each_name(visit),
            Self::Sum(terms) => terms.iter_mut().for_each(|(_, term)| term.for_each_name(visit)),
            Self::Product(parts) | Self::Call(_, _, parts) => parts.iter_mut().for_each(|a| a.for_each_name(visit)),
            Self::Quotient(a, b) => [a, b].into_iter().for_each(|a| a.for_each_name(visit)),
        }
    }

    /// True for the literal 0.
    pub fn is_zero(&self) -> bool {
        *self == Self::Number(0.0)
    }

    /// −a, where double signs cancel and −0 is 0.
    pub fn negated(self) -> Self {
        match self {
            Self::Minus(inner) => *inner,
            zero if zero.is_zero() => zero,
            other => Self::Minus(Box::new(other)),
        }
    }
}
