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

/// The value of a function by its name, the order of its derivative, and its arguments.
type Supplied<'f> = &'f dyn Fn(&str, usize, &[f64]) -> Option<f64>;

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

    /// The value, where `symbol` gives those of names and `function` those of functions that are not elementary.
    ///
    /// # Errors
    /// The name of what has no value.
    pub fn evaluate(&self, symbol: &dyn Fn(&Name) -> Option<f64>, function: Supplied<'_>) -> Result<f64, String> {
        let of = |formula: &Self| formula.evaluate(symbol, function);
        Ok(match self {
            Self::Number(value) => *value,
            Self::Name(name) => symbol(name).ok_or_else(|| name.written.clone())?,
            Self::Minus(a) => -of(a)?,
            Self::Sum(terms) => {
                let mut sum = 0.0;
                for (minus, term) in terms {
                    sum += if *minus { -of(term)? } else { of(term)? };
                }
                sum
            }
            Self::Product(factors) => {
                factors.iter().try_fold(1.0, |product, factor| Ok::<_, String>(product * of(factor)?))?
            }
            Self::Quotient(a, b) => of(a)? / of(b)?,
            Self::Power(a, n) if n.fract() == 0.0 && n.abs() < 1e9 => of(a)?.powi(*n as i32),
            Self::Power(a, n) => of(a)?.powf(*n),
            Self::Call(name, primes, arguments) => {
                let values = arguments.iter().map(of).collect::<Result<Vec<f64>, String>>()?;
                match elementary(name, *primes, &values) {
                    Some(value) => value,
                    None => function(name, *primes, &values).ok_or_else(|| name.clone())?,
                }
            }
        })
    }
}

/// The functions of the language.
fn elementary(name: &str, primes: usize, arguments: &[f64]) -> Option<f64> {
    if primes > 0 {
        return None;
    }
    Some(match (name, arguments) {
        ("sin", [x]) => x.sin(),
        ("cos", [x]) => x.cos(),
        ("tan", [x]) => x.tan(),
        ("asin", [x]) => x.asin(),
        ("acos", [x]) => x.acos(),
        ("atan", [x]) => x.atan(),
        ("sqrt", [x]) => x.sqrt(),
        ("exp", [x]) => x.exp(),
        ("ln", [x]) => x.ln(),
        ("abs", [x]) => x.abs(),
        ("sign", [x]) => x.signum(),
        ("atan2", [y, x]) => y.atan2(*x),
        _ => return None,
    })
}
