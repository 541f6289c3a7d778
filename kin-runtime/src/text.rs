//! How public types print numbers: with the precision of the format, as in `{:.3}`.

use core::fmt;

/// A number.
pub(crate) fn number<T: fmt::Display>(f: &mut fmt::Formatter<'_>, value: &T) -> fmt::Result {
    match f.precision() {
        Some(digits) => write!(f, "{value:.digits$}"),
        None => write!(f, "{value}"),
    }
}

/// Numbers in brackets: `(0.1, 0.2)`.
pub(crate) fn numbers<T: fmt::Display>(f: &mut fmt::Formatter<'_>, values: &[T]) -> fmt::Result {
    f.write_str("(")?;
    separated(f, values, number)?;
    f.write_str(")")
}

/// Items with commas between them.
pub(crate) fn separated<T>(
    f: &mut fmt::Formatter<'_>,
    items: impl IntoIterator<Item = T>,
    mut write: impl FnMut(&mut fmt::Formatter<'_>, T) -> fmt::Result,
) -> fmt::Result {
    items.into_iter().enumerate().try_for_each(|(k, item)| {
        if k > 0 {
            f.write_str(", ")?;
        }
        write(f, item)
    })
}

/// An entry of a list in the words of the description: `the input \`u\``, `t`, `Φ[8] (drive)`.
pub(crate) fn entry(f: &mut fmt::Formatter<'_>, list: &str, index: usize, name: &str) -> fmt::Result {
    match list {
        "t" => f.write_str("t"),
        "inputs" if !name.is_empty() => write!(f, "the input `{name}`"),
        "parameters" if !name.is_empty() => write!(f, "the parameter `{name}`"),
        "observables" if !name.is_empty() => write!(f, "the value or a rate of `{name}`"),
        _ if name.is_empty() => write!(f, "{list}[{index}]"),
        _ => write!(f, "{list}[{index}] ({name})"),
    }
}

/// `1 row`, `2 rows`.
pub(crate) fn counted(f: &mut fmt::Formatter<'_>, count: usize, noun: &str) -> fmt::Result {
    match (count, noun) {
        (1, _) => write!(f, "1 {noun}"),
        (_, "body") => write!(f, "{count} bodies"),
        (_, "entry") => write!(f, "{count} entries"),
        _ => write!(f, "{count} {noun}s"),
    }
}

/// A value with its first and second time derivative: `0.5 (rate 1, acceleration 0)`.
pub(crate) fn rates<T: fmt::Display>(f: &mut fmt::Formatter<'_>, [value, rate, acceleration]: [&T; 3]) -> fmt::Result {
    number(f, value)?;
    f.write_str(" (rate ")?;
    number(f, rate)?;
    f.write_str(", acceleration ")?;
    number(f, acceleration)?;
    f.write_str(")")
}

/// A time rounded to about six significant digits, for messages.
pub(crate) fn rounded(t: f64) -> f64 {
    if t == 0.0 || !t.is_finite() {
        return t;
    }
    // Thousandths are kept however large t is.
    let mut scale = if t.abs() < 1e5 { 1.0 } else { 1e3 };
    while t.abs() * scale < 1e5 && scale < 1e12 {
        scale *= 10.0;
    }
    // Adding and subtracting 1.5·2⁵² rounds to an integer without a call.
    const ROUND: f64 = 1.5 / f64::EPSILON;
    if t.abs() * scale < 1e15 { ((t * scale + ROUND) - ROUND) / scale } else { t }
}
