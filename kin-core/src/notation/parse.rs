//! Parses the text of an expression.
//!
//! ```text
//! sum     = product { ("+" | "-") product }          product = unary { ("*" | "/") unary }
//! unary   = "-" unary | power                        power   = atom [ "^" [ "-" ] number ]
//! atom    = number | name [ "(" sum { "," sum } ")" ] | "(" sum ")"
//! ```

use super::name::Name;
use super::tree::FormulaTree;
use core::fmt;

/// The error for a text that is not a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// The position in bytes.
    pub at: usize,
    /// The expected token.
    pub expected: &'static str,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is expected at byte {}", self.expected, self.at)
    }
}

impl std::error::Error for ParseError {}

/// Maximum nesting depth; deeper formulas are not readable.
const DEPTH: usize = 200;

impl FormulaTree {
    /// Parses the text that [`Shown`](crate::expr::Shown) prints.
    ///
    /// # Errors
    /// The text is not a formula, for example because it was cut off at the maximum length.
    pub fn parse(text: &str) -> Result<Self, ParseError> {
        let mut reader = FormulaParser { text, at: 0, depth: 0 };
        let formula = reader.sum()?;
        reader.spaces();
        if reader.at < text.len() { reader.error("the end") } else { Ok(formula) }
    }
}

struct FormulaParser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
}

type Read = Result<FormulaTree, ParseError>;

impl<'t> FormulaParser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn spaces(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    fn take(&mut self, mark: char) -> bool {
        self.spaces();
        let found = self.rest().starts_with(mark);
        self.at += if found { mark.len_utf8() } else { 0 };
        found
    }

    fn error<T>(&self, expected: &'static str) -> Result<T, ParseError> {
        Err(ParseError { at: self.at, expected })
    }

    fn sum(&mut self) -> Read {
        self.depth += 1;
        if self.depth > DEPTH {
            return self.error("a formula that a person can read");
        }
        let mut terms = vec![(false, self.product()?)];
        loop {
            let minus = match () {
                () if self.take('+') => false,
                () if self.take('-') => true,
                () => break,
            };
            terms.push((minus, self.product()?));
        }
        self.depth -= 1;
        // Brackets around the first sum are redundant.
        if let (false, FormulaTree::Sum(_)) = &terms[0] {
            let (_, FormulaTree::Sum(first)) = terms.remove(0) else { return self.error("a sum") };
            terms.splice(0..0, first);
        }
        Ok(if terms.len() == 1 { terms.remove(0).1 } else { FormulaTree::Sum(terms) })
    }

    fn product(&mut self) -> Read {
        let mut whole = self.unary()?;
        loop {
            if self.take('*') {
                let factor = self.unary()?;
                whole = times(whole, factor);
            } else if self.take('/') {
                let below = self.unary()?;
                whole = match whole {
                    FormulaTree::Minus(above) => FormulaTree::Quotient(above, Box::new(below)).negated(),
                    above => FormulaTree::Quotient(Box::new(above), Box::new(below)),
                };
            } else {
                return Ok(whole);
            }
        }
    }

    fn unary(&mut self) -> Read {
        let mut minus = false;
        while self.take('-') {
            minus = !minus;
        }
        let power = self.power()?;
        Ok(if minus { power.negated() } else { power })
    }

    fn power(&mut self) -> Read {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        let minus = self.take('-');
        let n = self.number()?;
        Ok(FormulaTree::Power(Box::new(base), if minus { -n } else { n }))
    }

    fn atom(&mut self) -> Read {
        self.spaces();
        match self.rest().chars().next() {
            Some('(') => {
                self.at += 1;
                let inner = self.sum()?;
                if self.take(')') { Ok(inner) } else { self.error("`)`") }
            }
            Some(c) if c.is_ascii_digit() => Ok(FormulaTree::Number(self.number()?)),
            Some(c) if is_of_name(c) => self.named(),
            _ => self.error("a number, a name or `(`"),
        }
    }

    fn named(&mut self) -> Read {
        let within = |c: char| is_of_name(c) || c.is_ascii_digit() || matches!(c, '.' | '[' | ']' | '#');
        let length = self.rest().find(|c| !within(c)).unwrap_or(self.rest().len());
        let name = &self.rest()[..length];
        self.at += length;
        let primes = self.rest().len() - self.rest().trim_start_matches('\'').len();
        self.at += primes;
        if !self.rest().starts_with('(') {
            return if primes > 0 { self.error("`(`") } else { Ok(FormulaTree::Name(Name::new(name))) };
        }
        self.at += 1;
        let mut arguments = vec![self.sum()?];
        while self.take(',') {
            arguments.push(self.sum()?);
        }
        if !self.take(')') {
            return self.error("`)`");
        }
        Ok(match (name, arguments.as_slice()) {
            // The rate of something for which the name `u_dot` is taken.
            ("dot" | "ddot", [FormulaTree::Name(own)]) if primes == 0 => {
                FormulaTree::Name(Name::new(&format!("{name}({})", own.written)))
            }
            _ => FormulaTree::Call(name.to_owned(), primes, arguments),
        })
    }

    fn number(&mut self) -> Result<f64, ParseError> {
        self.spaces();
        let rest = self.rest();
        let mut length = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        if rest[length..].starts_with(['e', 'E']) {
            let after = rest[length + 1..].trim_start_matches(['-', '+']);
            let digits = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            length = if digits > 0 { rest.len() - after.len() + digits } else { length };
        }
        let Ok(value) = rest[..length].parse() else { return self.error("a number") };
        self.at += length;
        Ok(value)
    }
}

/// True for letters and the marks that names may have above them, as in x̄: all that is not ASCII, except for the ellipsis
/// of a text that was cut off.
fn is_of_name(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_' || !c.is_ascii() && c != '…'
}

/// The product a·b without nested products, with the sign moved to the front.
fn times(a: FormulaTree, b: FormulaTree) -> FormulaTree {
    match (a, b) {
        (FormulaTree::Minus(a), b) => times(*a, b).negated(),
        (a, FormulaTree::Minus(b)) => times(a, *b).negated(),
        (FormulaTree::Product(mut a), FormulaTree::Product(b)) => {
            a.extend(b);
            FormulaTree::Product(a)
        }
        (FormulaTree::Product(mut a), b) => {
            a.push(b);
            FormulaTree::Product(a)
        }
        (a, FormulaTree::Product(mut b)) => {
            b.insert(0, a);
            FormulaTree::Product(b)
        }
        (a, b) => FormulaTree::Product(vec![a, b]),
    }
}
