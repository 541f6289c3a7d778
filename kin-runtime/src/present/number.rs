//! Numbers as text, for people and for other programs.

/// Significant digits that the largest number of a column gets at least.
const DIGITS: i32 = 6;
/// Decimals of a column of ordinary size.
const DECIMALS: i32 = 6;

/// The format of the numbers of one column, so that their decimal points are aligned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// This number of decimals.
    Fixed(usize),
    /// With an exponent: the numbers are too large or too small for plain decimals.
    Exponent,
}

impl Style {
    /// The style for these numbers: six decimals, more if all are small, fewer if some are large.
    pub(crate) fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let largest = values.into_iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        if largest < 1e-13 {
            return Self::Fixed(DECIMALS as usize);
        }
        match largest.log10().floor() as i32 {
            ..=-7 | 12.. => Self::Exponent,
            power @ ..=-3 => Self::Fixed((DIGITS - 1 - power) as usize),
            ..=4 => Self::Fixed(DECIMALS as usize),
            5..=7 => Self::Fixed(3),
            _ => Self::Fixed(1),
        }
    }

    /// The number in this style. A number that rounds to zero has no sign.
    pub(crate) fn write(self, value: f64) -> String {
        if !value.is_finite() {
            return unusual(value);
        }
        match self {
            Self::Exponent if value == 0.0 => "0".to_owned(),
            Self::Exponent => format!("{value:.5e}"),
            Self::Fixed(decimals) => {
                let text = format!("{value:.decimals$}");
                match text.strip_prefix('-') {
                    Some(digits) if digits.bytes().all(|b| matches!(b, b'0' | b'.')) => digits.to_owned(),
                    _ => text,
                }
            }
        }
    }
}

/// The shortest decimal text that reads back as the same `f64`; an exponent only instead of many zeros.
pub(crate) fn plain(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        unusual(value)
    } else if size == 0.0 {
        "0".to_owned()
    } else if !(1e-5..1e16).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// An error or a residual, of which only the order of magnitude matters.
pub(crate) fn magnitude(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        unusual(value)
    } else if (1e-3..1e6).contains(&size) {
        rounded(value)
    } else {
        format!("{value:.1e}")
    }
}

/// A single number with at least six significant digits, without trailing zeros.
pub(crate) fn rounded(value: f64) -> String {
    let style = Style::of([value]);
    let text = style.write(value);
    match style {
        Style::Fixed(_) => without_zeros(&text),
        Style::Exponent => text,
    }
}

/// The number with an exponent and this number of decimals, without trailing zeros.
#[cfg(feature = "plot")]
pub(crate) fn exponent(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    text.split_once('e').map_or_else(String::new, |(digits, power)| format!("{}e{power}", without_zeros(digits)))
}

/// Decimals without trailing zeros.
pub(crate) fn without_zeros(text: &str) -> String {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    }
}

/// Infinity and not-a-number.
fn unusual(value: f64) -> String {
    if value.is_nan() {
        "undefined".to_owned()
    } else if value > 0.0 {
        "infinite".to_owned()
    } else {
        "-infinite".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_numbers_have_six_decimals_and_no_exponent() {
        let style = Style::of([0.25, -13.5]);
        assert_eq!(style.write(0.25), "0.250000");
        assert_eq!(style.write(-13.5), "-13.500000");
        assert_eq!(style.write(-1e-17), "0.000000");
    }

    #[test]
    fn a_column_of_small_numbers_keeps_its_digits() {
        let style = Style::of([1.25e-5, 0.0]);
        assert_eq!(style.write(1.25e-5), "0.0000125000");
        assert_eq!(style.write(0.0), "0.0000000000");
    }

    #[test]
    fn rounding_noise_is_zero() {
        assert_eq!(Style::of([-3e-17]).write(-3e-17), "0.000000");
    }

    #[test]
    fn extreme_numbers_have_an_exponent() {
        assert_eq!(Style::of([1e15]).write(1e15), "1.00000e15");
        assert_eq!(["0", "0"], [0.0, -0.0].map(|zero| Style::of([1e15]).write(zero)));
        assert_eq!(plain(1e-17), "1e-17");
        assert_eq!(plain(1e300), "1e300");
    }

    #[test]
    fn plain_reads_back_as_the_same_number() {
        for v in [0.1, 1.0 / 3.0, -2.5e-9, 6.02e23, f64::MIN_POSITIVE, f64::MAX, 0.0, 1e-5, 123456.789] {
            assert_eq!(plain(v).parse::<f64>(), Ok(v));
        }
        assert_eq!(plain(0.1), "0.1");
        assert_eq!(plain(2.0), "2");
        assert_eq!(plain(-0.0), "0");
    }

    #[test]
    fn alone_without_trailing_zeros() {
        assert_eq!(rounded(0.5), "0.5");
        assert_eq!(rounded(120.0), "120");
        assert_eq!(rounded(0.0), "0");
        assert_eq!(magnitude(2.2e-16), "2.2e-16");
        assert_eq!(magnitude(f64::INFINITY), "infinite");
    }
}
