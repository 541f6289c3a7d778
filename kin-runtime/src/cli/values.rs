//! The values of options: numbers, `name=value` lists, times, signals.

use super::failure::Failure;
use crate::planned::Sign;
use crate::workspace::Signal;

/// Values of a parameter that one diagram shows at most.
#[cfg(feature = "plot")]
const MOST_VALUES: usize = 14;

/// The most instants that one sweep computes.
const MOST_STEPS: usize = 1_000_000;

/// A finite number.
pub(super) fn number(option: &str, text: &str) -> Result<f64, Failure> {
    let text = text.trim();
    if text.is_empty() {
        return Err(Failure::option(option, "a number is missing"));
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) if text.bytes().any(|b| b.is_ascii_digit()) => {
            Err(Failure::option(option, format!("`{text}` is too large for a number")))
        }
        Ok(_) => Err(Failure::option(option, format!("`{text}` is not finite; a finite number is needed"))),
        Err(_) => Err(Failure::option(option, format!("`{text}` is not a number (numbers are written like -0.25)"))),
    }
}

/// `name=value` pairs from all occurrences of an option; no name twice.
pub(super) fn assignments(option: &str, example: &str, texts: &[String]) -> Result<Vec<(String, String)>, Failure> {
    let mut pairs: Vec<(String, String)> = Vec::new();
    for piece in texts.iter().flat_map(|t| t.split(',')) {
        let piece = piece.trim();
        let Some((name, value)) = piece.split_once('=') else {
            let what = if piece.is_empty() {
                format!("an assignment is missing; write {option} {example}")
            } else {
                format!("`{piece}` is no assignment; write {option} {example}")
            };
            return Err(Failure::option(option, what));
        };
        let (name, value) = (name.trim(), value.trim());
        if name.is_empty() {
            return Err(Failure::option(option, format!("`{piece}` has no name; write {option} {example}")));
        }
        if value.is_empty() {
            return Err(Failure::option(option, format!("`{name}` has no value; write {option} {example}")));
        }
        if value.starts_with('[') {
            let what = format!("an array is set member by member; write {option} {name}[0]=…,{name}[1]=…");
            return Err(Failure::option(option, what));
        }
        if pairs.iter().any(|(other, _)| other == name) {
            return Err(Failure::option(option, format!("`{name}` is set twice")));
        }
        pairs.push((name.to_owned(), value.to_owned()));
    }
    Ok(pairs)
}

/// `+` or `-`.
pub(super) fn sign(option: &str, text: &str) -> Result<Sign, Failure> {
    match text {
        "+" | "+1" | "1" => Ok(Sign::Plus),
        "-" | "-1" | "−" => Ok(Sign::Minus),
        _ => Err(Failure::option(option, format!("`{text}` is no sign; write + or -"))),
    }
}

/// `value`, `value:rate` or `value:rate:acceleration`; what is missing is zero.
pub(super) fn signal(option: &str, name: &str, parts: &[&str]) -> Result<Signal, Failure> {
    let mut numbers = [0.0; 3];
    if parts.len() > numbers.len() {
        let what = format!("`{name}` has {} numbers; at most value, rate and acceleration", parts.len());
        return Err(Failure::option(option, what));
    }
    for (place, part) in numbers.iter_mut().zip(parts) {
        *place = number(option, part)?;
    }
    let [value, rate, acceleration] = numbers;
    Ok(Signal { value, rate, acceleration })
}

/// `u=value,rate,acceleration` from all occurrences of an option; a piece with `=` starts the next input.
pub(super) fn inputs(option: &str, texts: &[String]) -> Result<Vec<(String, Signal)>, Failure> {
    let mut signals: Vec<(String, Signal)> = Vec::new();
    for text in texts {
        let mut pending: Option<(&str, Vec<&str>)> = None;
        for piece in text.split(',') {
            match (piece.split_once('='), &mut pending) {
                (Some((name, value)), open) => {
                    if let Some((name, parts)) = open.take() {
                        finish(option, name, &parts, &mut signals)?;
                    }
                    *open = Some((name.trim(), vec![value]));
                }
                (None, Some((_, parts))) => parts.push(piece),
                (None, None) => {
                    let what = format!("`{piece}` names no input; write {option} u=value,rate,acceleration");
                    return Err(Failure::option(option, what));
                }
            }
        }
        if let Some((name, parts)) = pending {
            finish(option, name, &parts, &mut signals)?;
        }
    }
    Ok(signals)
}

fn finish(option: &str, name: &str, parts: &[&str], signals: &mut Vec<(String, Signal)>) -> Result<(), Failure> {
    if signals.iter().any(|(other, _)| other == name) {
        return Err(Failure::option(option, format!("`{name}` is given twice")));
    }
    signals.push((name.to_owned(), signal(option, name, parts)?));
    Ok(())
}

/// The instants of `--times`.
pub(super) fn times(option: &str, text: &str) -> Result<Vec<f64>, Failure> {
    let times = text.split(',').map(|t| number(option, t)).collect::<Result<Vec<f64>, Failure>>()?;
    for pair in times.windows(2) {
        if let [a, b] = pair
            && a == b
        {
            return Err(Failure::option(option, format!("the instant {a} stands twice in a row")));
        }
    }
    Ok(times)
}

/// `steps` + 1 instants from `from` to `to`, both exactly.
pub(super) fn grid(from: f64, to: f64, steps: usize) -> Result<Vec<f64>, Failure> {
    if steps == 0 {
        return Err(Failure::option("--steps", "at least 1 is needed (N steps are N + 1 instants)"));
    }
    if steps > MOST_STEPS {
        return Err(Failure::option("--steps", format!("{steps} steps are too many; at most {MOST_STEPS}")));
    }
    let length = to - from;
    if length == 0.0 {
        let what =
            format!("--from and --to are both {from}; a sweep needs two different instants (or use `solve --at`)");
        return Err(Failure::Usage(what));
    }
    if !length.is_finite() || from + length / steps as f64 == from || to - length / steps as f64 == to {
        let what = format!("--from {from} --to {to} --steps {steps}: the instants cannot be told apart");
        return Err(Failure::Usage(what));
    }
    Ok((0..=steps).map(|i| if i == steps { to } else { from + length * i as f64 / steps as f64 }).collect())
}

/// The values of `--vary`: `l1=0.08..0.12:5`, both ends included, or `l1=0.08,0.1`.
#[cfg(feature = "plot")]
pub(super) fn variation(option: &str, text: &str) -> Result<(String, Vec<f64>), Failure> {
    let shape = || Failure::option(option, format!("`{text}`: write l1=0.08..0.12:5 or l1=0.08,0.1,0.12"));
    let (name, values) = text.split_once('=').ok_or_else(shape)?;
    let Some((from, rest)) = values.split_once("..") else {
        let values = values.split(',').map(|value| number(option, value)).collect::<Result<Vec<f64>, Failure>>()?;
        return Ok((name.trim().to_owned(), values));
    };
    let (to, count) = rest.split_once(':').ok_or_else(shape)?;
    let (from, to) = (number(option, from)?, number(option, to)?);
    let count = count.trim().parse::<usize>().ok().filter(|n| (2..=MOST_VALUES).contains(n));
    let Some(count) = count else {
        return Err(Failure::option(option, format!("`{text}`: between 2 and {MOST_VALUES} values can be told apart")));
    };
    let at = |k: usize| from + (to - from) * k as f64 / (count - 1) as f64;
    Ok((name.trim().to_owned(), (0..count).map(|k| if k + 1 == count { to } else { at(k) }).collect()))
}

/// The number of steps.
pub(super) fn steps(text: &str) -> Result<usize, Failure> {
    text.trim().parse::<usize>().map_err(|_| {
        Failure::option("--steps", format!("`{text}` is no number of steps; a whole number from 1 on is needed"))
    })
}

#[cfg(test)]
#[path = "values_tests.rs"]
mod tests;
