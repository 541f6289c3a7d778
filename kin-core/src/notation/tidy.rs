//! Simplifies the form of formulas: redundant brackets and double signs are removed, equal terms and factors
//! collected, several fractions combined into one, multiples of π and fractions of parameters recognised, rounding errors
//! of products of decimal numbers removed, functions placed last.
//!
//! Nothing is expanded or cancelled, so the formula still shows the operations that were derived.

use super::name::Name;
use super::tree::FormulaTree;

impl FormulaTree {
    /// The formula in tidied form.
    ///
    /// ```
    /// use kin_core::notation::{FormulaTree, Notation};
    ///
    /// let gamma = FormulaTree::parse("-(l1*cos(phi)*phi_dot*phi_dot + a - (b - c))")?.tidied();
    /// assert_eq!(gamma.write(Notation::Unicode), "−l₁ φ̇² cos φ − a + b − c");
    /// # Ok::<(), kin_core::notation::ParseError>(())
    /// ```
    #[must_use]
    pub fn tidied(self) -> Self {
        self.ordered().with_fractions()
    }

    /// Puts signs, terms and factors in order.
    fn ordered(self) -> Self {
        match self {
            Self::Number(value) => of_pi(value).unwrap_or(Self::Number(without_rounding(value))),
            Self::Name(_) => self,
            Self::Minus(a) => match a.ordered() {
                Self::Sum(terms) => sum(vec![(true, Self::Sum(terms))]),
                other => other.negated(),
            },
            Self::Sum(terms) => sum(terms.into_iter().map(|(minus, term)| (minus, term.ordered())).collect()),
            Self::Product(factors) => product(factors.into_iter().map(Self::ordered).collect()),
            Self::Quotient(a, b) => match (a.ordered(), b.ordered()) {
                (Self::Minus(a), Self::Minus(b)) => Self::Quotient(a, b),
                (Self::Minus(a), b) => Self::Quotient(a, Box::new(b)).negated(),
                (a, Self::Minus(b)) => Self::Quotient(Box::new(a), b).negated(),
                (a, b) => Self::Quotient(Box::new(a), Box::new(b)),
            },
            Self::Power(a, n) => Self::Power(Box::new(a.ordered()), n),
            Self::Call(name, primes, arguments) => {
                Self::Call(name, primes, arguments.into_iter().map(Self::ordered).collect())
            }
        }
    }
}

impl FormulaTree {
    /// Writes `l/2` for `0.5 l` if the number is a multiple of a half, a quarter or an eighth of a parameter.
    fn with_fractions(self) -> Self {
        let all = |formulas: Vec<Self>| formulas.into_iter().map(Self::with_fractions).collect::<Vec<_>>();
        match self {
            Self::Number(_) | Self::Name(_) => self,
            Self::Minus(a) => Self::Minus(Box::new(a.with_fractions())),
            Self::Sum(terms) => {
                Self::Sum(terms.into_iter().map(|(minus, term)| (minus, term.with_fractions())).collect())
            }
            Self::Product(factors) => fraction(all(factors)),
            Self::Quotient(a, b) => Self::Quotient(Box::new(a.with_fractions()), Box::new(b.with_fractions())),
            Self::Power(a, n) => Self::Power(Box::new(a.with_fractions()), n),
            Self::Call(name, primes, arguments) => Self::Call(name, primes, all(arguments)),
        }
    }
}

/// The denominators that are written as a fraction of a parameter instead of a decimal number.
const PARTS: [f64; 3] = [2.0, 4.0, 8.0];

/// True for a parameter or a power of one.
fn is_parameter(formula: &FormulaTree) -> bool {
    match formula {
        FormulaTree::Name(name) => name.order == 0 && !name.written.contains('.'),
        FormulaTree::Power(base, _) => matches!(base.as_ref(), FormulaTree::Name(_)) && is_parameter(base),
        _ => false,
    }
}

/// A product whose number is a multiple of an eighth, with the denominator moved below the first parameter.
fn fraction(mut factors: Vec<FormulaTree>) -> FormulaTree {
    let below = |value: f64| PARTS.into_iter().find(|q| (value * q).fract() == 0.0 && value * q <= 12.0);
    if let [FormulaTree::Number(value), ..] = factors[..]
        && value.fract() != 0.0
        && let Some(below) = below(value)
        && let Some(index) = factors.iter().position(is_parameter)
    {
        let name = factors.remove(index);
        let part = FormulaTree::Quotient(Box::new(name), Box::new(FormulaTree::Number(below)));
        factors[0] = FormulaTree::Number(value * below);
        factors.insert(1, part);
        if factors[0] == FormulaTree::Number(1.0) {
            factors.remove(0);
        }
    }
    if factors.len() == 1 { factors.remove(0) } else { FormulaTree::Product(factors) }
}

/// A sum without nested sums; signs are moved to the terms.
fn sum(terms: Vec<(bool, FormulaTree)>) -> FormulaTree {
    let mut flat: Vec<(bool, FormulaTree)> = Vec::new();
    for (minus, term) in terms {
        match term {
            FormulaTree::Sum(inner) => flat.extend(inner.into_iter().map(|(negative, term)| (negative != minus, term))),
            FormulaTree::Minus(inner) => flat.push((!minus, *inner)),
            other => flat.push((minus, other)),
        }
    }
    let mut flat = counted(flat);
    match flat.len() {
        1 => {
            let (minus, term) = flat.remove(0);
            if minus { term.negated() } else { term }
        }
        _ => FormulaTree::Sum(flat),
    }
}

/// Collects equal terms of the same sign into a multiple; terms that would cancel are kept.
fn counted(terms: Vec<(bool, FormulaTree)>) -> Vec<(bool, FormulaTree)> {
    let mut out: Vec<(f64, FormulaTree, (bool, FormulaTree))> = Vec::new();
    for (minus, term) in terms {
        let (count, rest) = match &term {
            FormulaTree::Product(factors) => match factors.as_slice() {
                [FormulaTree::Number(count), rest] => (*count, rest.clone()),
                [FormulaTree::Number(count), rest @ ..] => (*count, FormulaTree::Product(rest.to_vec())),
                _ => (1.0, term.clone()),
            },
            other => (1.0, other.clone()),
        };
        let count = if minus { -count } else { count };
        let same = |(_, other, _): &&mut (f64, FormulaTree, (bool, FormulaTree))| {
            *other == rest && !matches!(rest, FormulaTree::Number(_))
        };
        match out.iter_mut().find(same) {
            Some((sum, rest, written)) if *sum * count > 0.0 && is_short(*sum + count) => {
                *sum += count;
                let product = product(vec![FormulaTree::Number(sum.abs()), rest.clone()]);
                *written = (*sum < 0.0, product);
            }
            _ => out.push((count, rest, (minus, term))),
        }
    }
    out.into_iter().map(|(_, _, written)| written).collect()
}

/// True for a number with few digits.
fn is_short(value: f64) -> bool {
    value.abs().to_string().len() <= 7
}

/// The number with at most twelve significant digits that is within four rounding errors of this one, or this one: the
/// product 0.2·0.2 is 0.04 and not 0.04000000000000001. Integers have no rounding errors.
fn without_rounding(value: f64) -> f64 {
    let short: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    let is_rounded = value.fract() != 0.0 && (short - value).abs() <= 4.0 * f64::EPSILON * value.abs();
    if is_rounded { short } else { value }
}

/// The number as p π/q with small integers p and q, if it equals that value to the last digit.
fn of_pi(value: f64) -> Option<FormulaTree> {
    let pi = core::f64::consts::PI;
    let near = value > 0.0 && value < 13.0 * pi;
    for q in [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 180.0] {
        let p = (value * q / pi).round();
        if near && (1.0..=12.0).contains(&p) && [p * pi / q, p * (pi / q), pi / (q / p)].contains(&value) {
            let pi = FormulaTree::Name(Name::new("pi"));
            let above = if p == 1.0 { pi } else { FormulaTree::Product(vec![FormulaTree::Number(p), pi]) };
            return Some(if q == 1.0 {
                above
            } else {
                FormulaTree::Quotient(Box::new(above), Box::new(FormulaTree::Number(q)))
            });
        }
    }
    None
}

/// A product with numbers first, functions last, equal factors collected as powers, and the sign in front.
fn product(factors: Vec<FormulaTree>) -> FormulaTree {
    let (mut flat, mut minus) = (Vec::new(), false);
    for factor in factors {
        let positive = match factor {
            FormulaTree::Minus(inner) => {
                minus = !minus;
                *inner
            }
            other => other,
        };
        match positive {
            FormulaTree::Product(inner) => flat.extend(inner.into_iter().flat_map(multiple)),
            other => flat.extend(multiple(other)),
        }
    }
    if let Some(index) = flat.iter().position(|factor| matches!(factor, FormulaTree::Quotient(..)))
        && flat.len() > 1
        && let FormulaTree::Quotient(above, below) = flat.remove(index)
    {
        flat.insert(index.min(flat.len()), *above);
        let (above, below) = match (product(flat), *below) {
            // There is another fraction among the factors.
            (FormulaTree::Quotient(above, other), below) => (above, product(vec![*other, below])),
            (above, below) => (Box::new(above), below),
        };
        let quotient = match *above {
            FormulaTree::Minus(above) => FormulaTree::Quotient(above, Box::new(below)).negated(),
            above => FormulaTree::Quotient(Box::new(above), Box::new(below)),
        };
        return if minus { quotient.negated() } else { quotient };
    }
    flat.sort_by_key(class);
    let flat = multiplied(flat);
    let mut powers: Vec<(FormulaTree, f64)> = Vec::new();
    for factor in flat {
        let (base, n) = match factor {
            FormulaTree::Power(base, n) if n > 0.0 && n.fract() == 0.0 => (*base, n),
            other => (other, 1.0),
        };
        // Numbers whose product would have too many digits remain separate.
        match powers.iter_mut().find(|(other, _)| *other == base && !matches!(base, FormulaTree::Number(_))) {
            Some((_, times)) => *times += n,
            None => powers.push((base, n)),
        }
    }
    let power = |(base, n): (FormulaTree, f64)| if n == 1.0 { base } else { FormulaTree::Power(Box::new(base), n) };
    let mut factors: Vec<FormulaTree> = powers.into_iter().map(power).collect();
    let product = if factors.len() == 1 { factors.remove(0) } else { FormulaTree::Product(factors) };
    if minus { product.negated() } else { product }
}

/// Splits a fraction of a parameter into a number and the parameter, so that the number can be combined with others.
fn multiple(factor: FormulaTree) -> Vec<FormulaTree> {
    match factor {
        FormulaTree::Quotient(above, below) => match (*above, *below) {
            (name, FormulaTree::Number(part)) if is_parameter(&name) && PARTS.contains(&part) => {
                vec![FormulaTree::Number(1.0 / part), name]
            }
            (above, below) => vec![FormulaTree::Quotient(Box::new(above), Box::new(below))],
        },
        other => vec![other],
    }
}

/// Multiplies the leading numbers as long as the product has few digits, and drops a factor of 1.
fn multiplied(mut factors: Vec<FormulaTree>) -> Vec<FormulaTree> {
    while let [FormulaTree::Number(a), FormulaTree::Number(b), ..] = factors[..] {
        if a != 1.0 && b != 1.0 && !is_short(a * b) {
            break;
        }
        factors.splice(0..2, [FormulaTree::Number(a * b)]);
    }
    if factors.len() > 1 && factors[0] == FormulaTree::Number(1.0) {
        factors.remove(0);
    }
    factors
}

fn class(factor: &FormulaTree) -> u8 {
    match factor {
        FormulaTree::Number(_) => 0,
        FormulaTree::Name(_) | FormulaTree::Quotient(..) => 1,
        FormulaTree::Power(base, _) => class(base),
        FormulaTree::Sum(_) => 2,
        _ => 3,
    }
}
