//! Formulas as a person would leave them: signs and brackets of sums gone, equal factors as powers, functions last.
//!
//! Nothing is expanded and nothing cancelled, so that what is written has the operations of what was derived.

use super::tree::Formula;

impl Formula {
    /// The same formula, tidied.
    ///
    /// ```
    /// use kin_core::notation::{Formula, Notation};
    ///
    /// let gamma = Formula::parse("-(l1*cos(phi)*phi_dot*phi_dot + a - (b - c))")?.tidied();
    /// assert_eq!(gamma.write(Notation::Unicode), "−l₁ φ̇² cos φ − a + b − c");
    /// # Ok::<(), kin_core::notation::ParseError>(())
    /// ```
    #[must_use]
    pub fn tidied(self) -> Self {
        match self {
            Self::Number(_) | Self::Name(_) => self,
            Self::Minus(a) => match a.tidied() {
                Self::Sum(terms) => sum(vec![(true, Self::Sum(terms))]),
                other => other.negated(),
            },
            Self::Sum(terms) => sum(terms.into_iter().map(|(minus, term)| (minus, term.tidied())).collect()),
            Self::Product(factors) => product(factors.into_iter().map(Self::tidied).collect()),
            Self::Quotient(a, b) => match (a.tidied(), b.tidied()) {
                (Self::Minus(a), Self::Minus(b)) => Self::Quotient(a, b),
                (Self::Minus(a), b) => Self::Quotient(a, Box::new(b)).negated(),
                (a, Self::Minus(b)) => Self::Quotient(Box::new(a), b).negated(),
                (a, b) => Self::Quotient(Box::new(a), Box::new(b)),
            },
            Self::Power(a, n) => Self::Power(Box::new(a.tidied()), n),
            Self::Call(name, primes, arguments) => {
                Self::Call(name, primes, arguments.into_iter().map(Self::tidied).collect())
            }
        }
    }
}

/// Sums within a sum become its terms, and signs go to the terms. What is subtracted never stands first where there is
/// anything that is added, unless it did.
fn sum(terms: Vec<(bool, Formula)>) -> Formula {
    let mut flat: Vec<(bool, Formula)> = Vec::new();
    for (minus, term) in terms {
        match term {
            Formula::Sum(inner) => flat.extend(inner.into_iter().map(|(own, term)| (own != minus, term))),
            Formula::Minus(inner) => flat.push((!minus, *inner)),
            other => flat.push((minus, other)),
        }
    }
    match flat.len() {
        1 => {
            let (minus, term) = flat.remove(0);
            if minus { term.negated() } else { term }
        }
        _ => Formula::Sum(flat),
    }
}

/// Numbers first, functions last, equal factors next to one another as powers; the sign in front of all.
fn product(factors: Vec<Formula>) -> Formula {
    let (mut flat, mut minus) = (Vec::new(), false);
    for factor in factors {
        let positive = match factor {
            Formula::Minus(inner) => {
                minus = !minus;
                *inner
            }
            other => other,
        };
        match positive {
            Formula::Product(inner) => flat.extend(inner),
            other => flat.push(other),
        }
    }
    flat.sort_by_key(class);
    let mut powers: Vec<(Formula, f64)> = Vec::new();
    for factor in flat {
        let (base, n) = match factor {
            Formula::Power(base, n) if n > 0.0 && n.fract() == 0.0 => (*base, n),
            other => (other, 1.0),
        };
        // Numbers stay as they were written.
        match powers.iter_mut().find(|(other, _)| *other == base && !matches!(base, Formula::Number(_))) {
            Some((_, times)) => *times += n,
            None => powers.push((base, n)),
        }
    }
    let power = |(base, n): (Formula, f64)| if n == 1.0 { base } else { Formula::Power(Box::new(base), n) };
    let mut factors: Vec<Formula> = powers.into_iter().map(power).collect();
    let product = if factors.len() == 1 { factors.remove(0) } else { Formula::Product(factors) };
    if minus { product.negated() } else { product }
}

fn class(factor: &Formula) -> u8 {
    match factor {
        Formula::Number(_) => 0,
        Formula::Name(_) | Formula::Quotient(..) => 1,
        Formula::Power(base, _) => class(base),
        Formula::Sum(_) => 2,
        _ => 3,
    }
}
