//! The values of options: numbers, `name=value` lists, times, signals.

use super::failure::{Failure, Ledger};
use super::names::{NameKind, find};
use super::number::{Amount, Measured, amount, converted};
use crate::model::Model;
use crate::planned::Sign;
use crate::present::number::plain;
use crate::present::units::ResultUnits;
use crate::signal::Signal;
use kin_core::units::Unit;

/// Largest number of steps of one sweep.
const MOST_STEPS: usize = 1_000_000;

/// A finite number, in the unit of its quantity.
pub(super) fn number(option: &str, text: &str, measured: Measured<'_>) -> Result<f64, Failure> {
    let amount = written(option, text)?;
    let value = converted(amount, measured)
        .map_err(|message| Failure::option(option, format!("`{}`: {message}", text.trim())))?;
    if value.is_finite() { Ok(value) } else { Err(not_finite(option, text)) }
}

/// An instant: a time, or the angle by which the driven crank has turned since t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TimeOrAngle {
    At(f64),
    /// An angle in radians.
    Turned(f64),
}

/// An instant.
pub(super) fn moment(option: &str, text: &str, model: &Model) -> Result<TimeOrAngle, Failure> {
    let amount = written(option, text)?;
    if amount.unit.is_some_and(Unit::is_number) {
        let angle = Measured { name: "t", unit: Some("rad"), ..Measured::default() };
        return number(option, text, angle).map(TimeOrAngle::Turned);
    }
    number(option, text, Measured { name: "t", unit: ResultUnits::of(model).time(), ..Measured::default() })
        .map(TimeOrAngle::At)
}

fn not_finite(option: &str, text: &str) -> Failure {
    Failure::option(option, format!("`{}` is not finite; a finite number is needed", text.trim()))
}

/// A number with its unit.
fn written(option: &str, text: &str) -> Result<Amount, Failure> {
    let text = text.trim();
    if text.is_empty() {
        return Err(Failure::option(option, "a number is missing"));
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Amount { value, ..Amount::default() }),
        Ok(_) if text.bytes().any(|b| b.is_ascii_digit()) => {
            Err(Failure::option(option, format!("`{text}` is too large for a number")))
        }
        Ok(_) => Err(not_finite(option, text)),
        Err(_) if text.replacen(',', ".", 1).parse::<f64>().is_ok() => Err(Failure::option(
            option,
            format!("`{text}` is not a number (decimals have a point: {})", text.replacen(',', ".", 1)),
        )),
        Err(_) => match amount(text) {
            Ok(amount) if amount.value.is_finite() => Ok(amount),
            Ok(_) => Err(not_finite(option, text)),
            Err(Some(message)) => Err(Failure::option(option, format!("`{text}`: {message}"))),
            Err(None) => {
                let message = format!("`{text}` is not a number (numbers are written like -0.25, pi/2 or 60deg)");
                Err(Failure::option(option, message))
            }
        },
    }
}

/// The parameters and the assembly modes in a json file of `design`, in the form of the values of `--set` and `--mode`.
pub(super) fn of_file(option: &str, file: &str) -> Result<[Vec<String>; 2], Failure> {
    let cannot = |why: String| Failure::option(option, format!("cannot read `{file}`: {why}"));
    let text = std::fs::read_to_string(file).map_err(|error| match file.split_once(',') {
        Some((file, values)) => cannot(format!("{error}; write {option} @{file} {option} {values}")),
        None => cannot(error.to_string()),
    })?;
    let found: serde_json::Value = serde_json::from_str(&text).map_err(|error| cannot(error.to_string()))?;
    let object = |key: &str| found.get(key).and_then(serde_json::Value::as_object);
    let parameters = object("parameters").ok_or_else(|| cannot("it has no `parameters`".to_owned()))?;
    let number = |name: &str| cannot(format!("the parameter `{name}` is no number"));
    let parameters = (parameters.iter())
        .map(|(name, value)| value.as_f64().map(|value| format!("{name}={value:?}")).ok_or_else(|| number(name)));
    let parameters = parameters.collect::<Result<_, _>>()?;
    let modes = object("modes").into_iter().flatten();
    let modes = modes.map(|(name, sign)| sign.as_str().map(|sign| format!("{name}={sign}")));
    let modes = modes.collect::<Option<_>>().ok_or_else(|| cannot("a mode is neither \"+\" nor \"-\"".to_owned()))?;
    Ok([parameters, modes])
}

/// `name=value` pairs from all occurrences of an option; no name twice.
pub(super) fn assignments(option: &str, example: &str, texts: &[String]) -> Result<Vec<(String, String)>, Failure> {
    let mut pairs: Vec<(String, String)> = Vec::new();
    let mut ledger = Ledger::default();
    let mut in_array = false;
    for piece in texts.iter().flat_map(|t| t.split(',')) {
        if in_array {
            // The rest of an array that was rejected as a whole.
            in_array = !piece.contains(']');
            continue;
        }
        in_array = piece.split_once('=').is_some_and(|(_, v)| v.trim().starts_with('[') && !v.contains(']'));
        let pair = assignment(option, example, piece.trim()).and_then(|(name, value)| {
            match pairs.iter().any(|(other, _)| *other == name) {
                true => Err(Failure::option(option, format!("`{name}` is set twice"))),
                false => Ok((name, value)),
            }
        });
        pairs.extend(ledger.take(pair));
    }
    ledger.close(Some(pairs))
}

/// The values of `name=value` pairs with the places of the names; errors go to the ledger.
pub(super) fn of_names<T>(
    ledger: &mut Ledger,
    (option, kind, example): (&str, NameKind, &str),
    texts: &[String],
    model: &Model,
    read: impl Fn(&str, &str) -> Result<T, Failure>,
) -> Vec<(usize, T)> {
    let pairs = ledger.take(assignments(option, &example_of(kind, model, example), texts)).unwrap_or_default();
    let one = |(name, value): (String, String)| {
        let (place, value) = (find(model, option, kind, &name), read(&name, &value));
        ledger.take(place).zip(ledger.take(value))
    };
    pairs.into_iter().filter_map(one).collect()
}

/// An example of an assignment, for error messages.
pub(super) fn example_of(kind: NameKind, model: &Model, value: &str) -> String {
    format!("{}={value}", kind.names(model).first().unwrap_or(&"NAME"))
}

fn assignment(option: &str, example: &str, piece: &str) -> Result<(String, String), Failure> {
    let fault = |message: String| Err(Failure::option(option, format!("{message}; write {option} {example}")));
    let Some((name, value)) = piece.split_once('=') else {
        return match piece {
            "" => fault("an assignment is missing".to_owned()),
            _ if written(option, piece).is_ok() && option == "--given" => {
                fault(format!("`{piece}` has no name (a rate and an acceleration follow colons, NAME=0.3:{piece})"))
            }
            _ if written(option, piece).is_ok() => {
                fault(format!("`{piece}` has no name (arrays are set member by member, decimals have a point)"))
            }
            _ => fault(format!("`{piece}` is no assignment")),
        };
    };
    let (name, value) = (name.trim(), value.trim());
    if name.is_empty() {
        return fault(format!("`{piece}` has no name"));
    }
    if value.is_empty() {
        return fault(format!("`{name}` has no value"));
    }
    if value.starts_with('[') {
        let message = format!("an array is set member by member; write {option} {name}[0]=…,{name}[1]=…");
        return Err(Failure::option(option, message));
    }
    Ok((name.to_owned(), value.to_owned()))
}

/// `+` or `-`.
pub(super) fn sign(option: &str, text: &str) -> Result<Sign, Failure> {
    match text {
        "+" | "+1" | "1" => Ok(Sign::Plus),
        "-" | "-1" | "−" => Ok(Sign::Minus),
        _ => Err(Failure::option(option, format!("`{text}` is no sign; write + or -"))),
    }
}

/// `value`, `value:rate` or `value:rate:acceleration`; missing numbers are zero.
pub(super) fn signal(option: &str, name: &str, parts: &[&str], measured: Measured<'_>) -> Result<Signal, Failure> {
    let mut numbers = [0.0; 3];
    if parts.len() > numbers.len() {
        let message = format!("`{name}` has {} numbers; at most value, rate and acceleration", parts.len());
        return Err(Failure::option(option, message));
    }
    let mut ledger = Ledger::default();
    for ((place, part), order) in numbers.iter_mut().zip(parts).zip(0..) {
        let measured = Measured { rate: (order, measured.rate.1), ..measured };
        ledger.take(number(option, part, measured)).into_iter().for_each(|value| *place = value);
    }
    ledger.close(Some(()))?;
    let [value, rate, acceleration] = numbers;
    Ok(Signal { value, rate, acceleration })
}

/// `u=value,rate,acceleration` from all occurrences of an option, with colons as in the values of `--given`, too; a piece
/// with `=` starts the next input.
pub(super) fn inputs(option: &str, texts: &[String], model: &Model) -> Result<Vec<(String, Signal)>, Failure> {
    let mut signals: Vec<(String, Signal)> = Vec::new();
    let mut ledger = Ledger::default();
    for text in texts {
        let mut pending: Option<(&str, Vec<&str>)> = None;
        let mut lost = false;
        for piece in text.split([',', ':']) {
            match (piece.split_once('='), &mut pending) {
                (Some((name, value)), open) => {
                    if let Some((name, parts)) = open.take() {
                        ledger.take(finish(option, name, &parts, model, &mut signals));
                    }
                    *open = Some((name.trim(), vec![value]));
                }
                (None, Some((_, parts))) => parts.push(piece),
                // Only the first number without a name is reported.
                (None, None) if lost => {}
                (None, None) => {
                    lost = true;
                    ledger.fault(option, format!("`{piece}` names no input; write {option} u=value,rate,acceleration"));
                }
            }
        }
        if let Some((name, parts)) = pending {
            ledger.take(finish(option, name, &parts, model, &mut signals));
        }
    }
    ledger.close(Some(signals))
}

fn finish(
    option: &str,
    name: &str,
    parts: &[&str],
    model: &Model,
    signals: &mut Vec<(String, Signal)>,
) -> Result<(), Failure> {
    if signals.iter().any(|(other, _)| other == name) {
        return Err(Failure::option(option, format!("`{name}` is given twice")));
    }
    signals.push((name.to_owned(), signal(option, name, parts, Measured::quantity(model, name))?));
    Ok(())
}

/// The instants of `--times`.
pub(super) fn times(option: &str, text: &str, model: &Model) -> Result<Vec<TimeOrAngle>, Failure> {
    let mut ledger = Ledger::default();
    let texts: Vec<&str> = text.split(',').collect();
    let times: Vec<TimeOrAngle> = texts.iter().filter_map(|t| ledger.take(moment(option, t, model))).collect();
    let times = ledger.close(Some(times))?;
    for (pair, text) in times.windows(2).zip(&texts) {
        if let [a, b] = pair
            && a == b
        {
            return Err(given_twice(option, text.trim()));
        }
    }
    Ok(times)
}

/// The error about an instant that follows itself.
pub(super) fn given_twice(option: &str, instant: &str) -> Failure {
    Failure::option(option, format!("the instant {instant} is given twice in succession"))
}

/// If neighbouring `f64` near t differ by more than this, the error about equal instants states the difference.
const COARSE_SPACING: f64 = 1e-3;

/// An error if instants are not different `f64`, or if there are too many.
pub(super) fn grid_is_possible(from: f64, to: f64, steps: usize) -> Result<(), Failure> {
    if steps == 0 {
        return Err(Failure::option("--steps", "at least 1 is needed (N steps are N + 1 instants)"));
    }
    if steps > MOST_STEPS {
        return Err(Failure::option("--steps", format!("{steps} steps are too many; at most {MOST_STEPS}")));
    }
    let length = to - from;
    let [first, last] = [from, to].map(plain);
    if length == 0.0 {
        let spacing = from.abs().next_up() - from.abs();
        let apart = match spacing > COARSE_SPACING {
            true => format!(" (numbers of this size are {} apart)", plain(spacing)),
            false => String::new(),
        };
        let message = format!(
            "--from and --to are both {first}{apart}; a sweep needs two different instants (or use `solve --at`)"
        );
        return Err(Failure::usage(message));
    }
    if !length.is_finite() || from + length / steps as f64 == from || to - length / steps as f64 == to {
        let message = format!("--from {first} --to {last} --steps {steps}: the instants cannot be told apart");
        return Err(Failure::usage(message));
    }
    Ok(())
}

/// `steps` + 1 instants from `from` to `to`, both exactly.
pub(super) fn grid(from: f64, to: f64, steps: usize) -> Result<Vec<f64>, Failure> {
    grid_is_possible(from, to, steps)?;
    let length = to - from;
    Ok((0..=steps).map(|i| if i == steps { to } else { from + length * i as f64 / steps as f64 }).collect())
}

/// The values of `--vary`: `l1=0.08..0.12:5`, both ends included, or `l1=0.08,0.1`. More than `most` are an error,
/// which gives `why` as the reason.
pub(super) fn variation(
    option: &str,
    text: &str,
    model: &Model,
    (most, why): (usize, &str),
) -> Result<(String, Vec<f64>), Failure> {
    let shape = || {
        Failure::option(
            option,
            format!("`{text}`: write NAME=0.08..0.12:5 (both ends and how many) or NAME=0.08,0.1,0.12"),
        )
    };
    let (name, values) = text.split_once('=').ok_or_else(shape)?;
    if values.contains('=') {
        let message = format!("`{text}`: write {option} again for each further parameter");
        return Err(Failure::option(option, message));
    }
    let measured = Measured::parameter(model, name.trim());
    let Some((from, rest)) = values.split_once("..") else {
        let values =
            values.split(',').map(|value| number(option, value, measured)).collect::<Result<Vec<f64>, Failure>>()?;
        if values.len() > most {
            let message = format!("{} values of {}; at most {most}: {why}", values.len(), name.trim());
            return Err(Failure::option(option, message));
        }
        return Ok((name.trim().to_owned(), values));
    };
    let (to, count) = rest.split_once(':').ok_or_else(shape)?;
    let (from, to) = (number(option, from, measured)?, number(option, to, measured)?);
    let count = count.trim().parse::<usize>().ok().filter(|n| (2..=most).contains(n));
    let Some(count) = count else {
        return Err(Failure::option(option, format!("`{text}`: between 2 and {most} values are possible: {why}")));
    };
    let at = |k: usize| from + (to - from) * k as f64 / (count - 1) as f64;
    Ok((name.trim().to_owned(), (0..count).map(|k| if k + 1 == count { to } else { at(k) }).collect()))
}

/// A number of random configurations.
pub(super) fn configurations(text: &str) -> Result<usize, Failure> {
    text.trim().parse::<u32>().map(|number| number as usize).map_err(|_| {
        let message =
            format!("`{text}` is no number of configurations; a whole number from 0 to {} is needed", u32::MAX);
        Failure::option("--configurations", message)
    })
}

/// The number of steps.
pub(super) fn steps(text: &str) -> Result<usize, Failure> {
    text.trim().parse::<usize>().map_err(|_| {
        let message = format!("`{text}` is no number of steps; a whole number from 1 to {MOST_STEPS} is needed");
        Failure::option("--steps", message)
    })
}

#[cfg(test)]
#[path = "values_tests.rs"]
mod tests;
