//! A reader of printed expressions, which evaluates them as it goes.

use super::{Bounded, Number, supplied};
use kin_core::mechanism::Function;

/// The value of an expression as it is printed with numbered names, `value` giving that of a name.
///
/// `+ −` bind least, then `* /`, then a leading minus, then `^`, which takes one signed number as its exponent.
pub fn read(text: &str, value: &dyn Fn(&str) -> Bounded) -> Bounded {
    let mut reader = Reader { rest: text, value };
    let sum = reader.sum();
    assert_eq!(reader.rest, "", "everything is read");
    sum
}

struct Reader<'a> {
    rest: &'a str,
    value: &'a dyn Fn(&str) -> Bounded,
}

impl<'a> Reader<'a> {
    fn take(&mut self, token: &str) -> bool {
        match self.rest.strip_prefix(token) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn word(&mut self, belongs: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !belongs(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    fn sum(&mut self) -> Bounded {
        let mut sum = self.product();
        loop {
            if self.take(" + ") {
                sum = sum + self.product();
            } else if self.take(" - ") {
                sum = sum - self.product();
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> Bounded {
        let mut product = self.unary();
        loop {
            if self.take("*") {
                product = product * self.unary();
            } else if self.take("/") {
                product = product / self.unary();
            } else {
                return product;
            }
        }
    }

    fn unary(&mut self) -> Bounded {
        if self.take("-") { -self.unary() } else { self.power() }
    }

    fn number(&mut self) -> f64 {
        let negative = self.take("-");
        let digits = self.word(|c| c.is_ascii_digit() || c == '.');
        let value: f64 = digits.parse().expect("a number");
        if negative { -value } else { value }
    }

    fn power(&mut self) -> Bounded {
        let base = self.atom();
        if !self.take("^") {
            return base;
        }
        let exponent = self.number();
        if exponent.fract() == 0.0 { base.powi(exponent as i32) } else { base.powf(exponent) }
    }

    fn atom(&mut self) -> Bounded {
        if self.take("(") {
            let inner = self.sum();
            assert!(self.take(")"), "a closing parenthesis before {:?}", self.rest);
            return inner;
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return Bounded::real(self.number());
        }
        let name = self.word(|c| c.is_ascii_alphanumeric() || c == '_' || c == '\'');
        assert!(!name.is_empty(), "an operand before {:?}", self.rest);
        if !self.take("(") {
            return (self.value)(name);
        }
        let first = self.sum();
        let second = self.take(", ").then(|| self.sum());
        assert!(self.take(")"), "a closing parenthesis before {:?}", self.rest);
        match (name, second) {
            ("atan2", Some(x)) => first.atan2(x),
            ("sign", None) => first.sign(),
            (_, None) => match Function::from_name(name) {
                Some(function) => first.call(function),
                None => {
                    let order = name.matches('\'').count() as u8;
                    let index: u32 = name.trim_end_matches('\'')[1..].parse().expect("a numbered function");
                    first.chain([0, 1, 2].map(|k| supplied(index, order + k, first.value)))
                }
            },
            (name, Some(_)) => panic!("`{name}` with two arguments"),
        }
    }
}
