//! A reader that evaluates formulas in LaTeX. It follows the rules of LaTeX and is independent of the writer.

use std::collections::HashMap;

/// A value with the size of the terms of which it is the sum, for the tolerance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value {
    pub(super) value: f64,
    pub(super) size: f64,
}

impl Value {
    pub(super) fn of(value: f64) -> Self {
        Self { value, size: value.abs() }
    }

    fn times(self, other: Self) -> Self {
        Self { value: self.value * other.value, size: self.size * other.size }
    }
}

/// A supplied function: arguments are its name, the order of its derivative, and its argument.
pub(super) type Function<'a> = dyn Fn(&str, usize, f64) -> Option<f64> + 'a;

pub(super) struct Reader<'a> {
    pub(super) symbols: &'a HashMap<String, Value>,
    pub(super) function: &'a Function<'a>,
}

type Read<'t> = Result<(Value, &'t str), String>;

impl Reader<'_> {
    /// The value of a complete formula.
    pub(super) fn read(&mut self, text: &str) -> Result<Value, String> {
        let (value, rest) = self.sum(text)?;
        if rest.trim().is_empty() { Ok(value) } else { Err(format!("`{rest}` is left over")) }
    }

    fn sum<'t>(&mut self, text: &'t str) -> Read<'t> {
        let (mut sum, mut rest) = (Value { value: 0.0, size: 0.0 }, text.trim_start());
        let mut sign = 1.0;
        if let Some(after) = rest.strip_prefix('-') {
            (sign, rest) = (-1.0, after);
        }
        loop {
            let (term, after) = self.product(rest)?;
            sum = Value { value: sum.value + sign * term.value, size: sum.size + term.size };
            let after = after.trim_start();
            (sign, rest) = match after.chars().next() {
                Some('+') => (1.0, &after[1..]),
                Some('-') => (-1.0, &after[1..]),
                _ => return Ok((sum, after)),
            };
        }
    }

    fn product<'t>(&mut self, text: &'t str) -> Read<'t> {
        let (mut product, mut rest) = self.power(text)?;
        loop {
            let after = rest.trim_start();
            let (factor, after) = match after.strip_prefix(r"\,").or_else(|| after.strip_prefix(r"\cdot")) {
                Some(after) => self.power(after)?,
                None => return Ok((product, after)),
            };
            (product, rest) = (product.times(factor), after);
        }
    }

    fn power<'t>(&mut self, text: &'t str) -> Read<'t> {
        let (base, rest) = self.atom(text.trim_start())?;
        let Some(after) = rest.strip_prefix("^{") else { return Ok((base, rest)) };
        let (n, rest) = self.sum(after)?;
        let rest = rest.strip_prefix('}').ok_or("a power ends with }")?;
        let value = if n.value.fract() == 0.0 { base.value.powi(n.value as i32) } else { base.value.powf(n.value) };
        Ok((Value { value, size: value.abs().max(base.size.powf(n.value)) }, rest))
    }

    /// The value of the expression before the closing mark `end`.
    fn within<'t>(&mut self, text: &'t str, end: &str) -> Read<'t> {
        let (value, rest) = self.sum(text)?;
        rest.trim_start().strip_prefix(end).map(|rest| (value, rest)).ok_or_else(|| format!("no {end} before `{rest}`"))
    }

    fn atom<'t>(&mut self, text: &'t str) -> Read<'t> {
        if let Some(rest) = text.strip_prefix(r"\left(") {
            return self.within(rest, r"\right)");
        }
        if let Some(rest) = text.strip_prefix(r"\left|") {
            let (value, rest) = self.within(rest, r"\right|")?;
            return Ok((Value { value: value.value.abs(), ..value }, rest));
        }
        if let Some(rest) = text.strip_prefix(r"\frac{") {
            let (above, rest) = self.within(rest, "}{")?;
            let (below, rest) = self.within(rest, "}")?;
            let value = above.value / below.value;
            return Ok((
                Value { value, size: above.size / below.value.abs() * (below.size / below.value.abs()) },
                rest,
            ));
        }
        if let Some(rest) = text.strip_prefix(r"\sqrt{") {
            let (of, rest) = self.within(rest, "}")?;
            return Ok((Value { value: of.value.sqrt(), size: of.size.sqrt() * (of.size / of.value) }, rest));
        }
        if let Some(rest) = text.strip_prefix(r"\operatorname{") {
            return self.supplied(rest);
        }
        if let Some(rest) = text.strip_prefix('{') {
            return self.within(rest, "}");
        }
        if text.starts_with(|c: char| c.is_ascii_digit()) {
            let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
            let value = text[..end].parse().map_err(|_| format!("`{text}` begins with no number"))?;
            return Ok((Value::of(value), &text[end..]));
        }
        for (name, function) in FUNCTIONS {
            if let Some(rest) = text.strip_prefix(name).filter(|rest| !rest.starts_with(|c: char| c.is_alphabetic())) {
                let (x, rest) = self.atom(rest.trim_start())?;
                let value = function(x.value);
                // The error of the argument is not multiplied by the slope of the function.
                return Ok((Value { value, size: value.abs().max(1.0) * x.size.max(1.0) }, rest));
            }
        }
        self.symbol(text)
    }

    fn supplied<'t>(&mut self, text: &'t str) -> Read<'t> {
        let (name, rest) = text.split_once('}').ok_or("a name ends with }")?;
        let name = name.replace(r"\_", "_");
        let order = rest.len() - rest.trim_start_matches('\'').len();
        let rest = rest[order..].strip_prefix(r"\left(").ok_or("a function has an argument")?;
        let (x, rest) = self.sum(rest)?;
        if let Some(second) = rest.trim_start().strip_prefix(',') {
            let (y, rest) = self.within(second, r"\right)")?;
            let size = 4.0 + (x.size + y.size) / x.value.hypot(y.value);
            return Ok((Value { value: x.value.atan2(y.value), size }, rest));
        }
        let rest = rest.trim_start().strip_prefix(r"\right)").ok_or("an argument ends")?;
        let value = match name.as_str() {
            "sign" => x.value.signum(),
            _ => (self.function)(&name, order, x.value).ok_or_else(|| format!("no function {name}"))?,
        };
        Ok((Value { value, size: 1e3 * value.abs().max(1.0) * x.size.max(1.0) }, rest))
    }

    /// The value of the longest name with which the text begins.
    fn symbol<'t>(&mut self, text: &'t str) -> Read<'t> {
        let known = self.symbols.iter().filter(|(name, _)| text.starts_with(name.as_str()));
        let (name, value) =
            known.max_by_key(|(name, _)| name.len()).ok_or_else(|| format!("`{text}` begins with no name"))?;
        Ok((*value, &text[name.len()..]))
    }
}

/// A command of LaTeX with the function that it denotes.
type Known = (&'static str, fn(f64) -> f64);

const FUNCTIONS: [Known; 8] = [
    (r"\sin", f64::sin),
    (r"\cos", f64::cos),
    (r"\tan", f64::tan),
    (r"\arcsin", f64::asin),
    (r"\arccos", f64::acos),
    (r"\arctan", f64::atan),
    (r"\exp", f64::exp),
    (r"\ln", f64::ln),
];
