//! Ranges, scores and the like as TOML values.

use super::node::Node;
use crate::error::StudyError;
use crate::sampling::Range;
use crate::scores::{Measure, Score};
use crate::study::{Closures, Histogram, Ramp};
use kin_runtime::Sign;

/// A parameter's range.
pub(super) fn range(node: &Node<'_>) -> Result<Range, StudyError> {
    let range = if node.is_list() {
        Range::List(node.numbers()?)
    } else if node.is_table() {
        node.only(&["from", "to", "values", "scale", "mean", "deviation", "mode"])?;
        let number = |key: &str| node.get(key).map(|value| value.number()).transpose();
        let (from, to) = (number("from")?, number("to")?);
        let log = match node.get("scale") {
            Some(scale) => scale.one_of(&[("log", true), ("linear", false)])?,
            None => false,
        };
        let values = node.get("values").map(|value| value.count()).transpose()?;
        match (number("mean")?, number("deviation")?, number("mode")?, from, to) {
            (Some(mean), Some(deviation), None, from, to) if values.is_none() && !log => Range::Normal {
                mean,
                deviation,
                from: from.unwrap_or(f64::NEG_INFINITY),
                to: to.unwrap_or(f64::INFINITY),
            },
            (None, None, Some(mode), Some(from), Some(to)) if values.is_none() && !log => {
                Range::Triangular { from, mode, to }
            }
            (None, None, None, Some(from), Some(to)) => match (values, log) {
                (Some(count @ 2..=1_000_000), false) if from < to => Range::steps(from, to, count as usize),
                (Some(_), _) => {
                    return Err(node.wrong("`values` needs from < to, 2 to 1000000 of them, and no logarithm"));
                }
                (None, true) => Range::LogUniform { from, to },
                (None, false) => Range::Uniform { from, to },
            },
            _ => {
                return Err(node.wrong(
                    "a range is { from = 1, to = 2 }, with `values = 5` or `scale = \"log\"` if you like, \
                     { mean = 1, deviation = 0.1 }, or { from = 1, mode = 1.2, to = 2 }",
                ));
            }
        }
    } else {
        Range::Fixed(node.number()?)
    };
    range.check().map_err(|message| node.wrong(message))?;
    Ok(range)
}

/// Makes a score of one quantity.
type OfQuantity = fn(String) -> Score;

/// A score.
pub(super) fn score(node: &Node<'_>) -> Result<Score, StudyError> {
    const RULES: [(&str, OfQuantity); 6] = [
        ("least", Score::Least),
        ("greatest", Score::Greatest),
        ("mean", Score::Mean),
        ("range", Score::Range),
        ("time_of_least", Score::TimeOfLeast),
        ("time_of_greatest", Score::TimeOfGreatest),
    ];
    let expected = "a score is { least = \"tip.x\" }, likewise greatest, mean, range, time_of_least, time_of_greatest; \
                    { at = 0.5, of = \"tip.x\" }; { distance = \"tip\", to = [[0, 1]] }; or { path = \"tip\" }";
    for (name, make) in RULES {
        if let Some(quantity) = node.get(name) {
            node.only(&[name])?;
            return Ok(make(quantity.text()?));
        }
    }
    if let (Some(at), Some(quantity)) = (node.get("at"), node.get("of")) {
        node.only(&["at", "of"])?;
        return Ok(Score::At { of: quantity.text()?, t: at.number()? });
    }
    if let Some(point) = node.get("path") {
        node.only(&["path", "normalised"])?;
        let normalised = node.get("normalised").map_or(Ok(false), |node| node.boolean())?;
        return Ok(Score::Path { point: point.text()?, normalised });
    }
    let (Some(point), Some(to)) = (node.get("distance"), node.get("to")) else { return Err(node.wrong(expected)) };
    node.only(&["distance", "to", "measure"])?;
    let pair = |item: &Node<'_>| match item.numbers()?[..] {
        [x, y] => Ok([x, y]),
        _ => Err(item.wrong("a point is a pair of numbers")),
    };
    let measure = match node.get("measure") {
        Some(node) => node.one_of(&[("greatest", Measure::Greatest), ("rms", Measure::RootMeanSquare)])?,
        None => Measure::Greatest,
    };
    let to = to.items()?.iter().map(pair).collect::<Result<_, _>>()?;
    Ok(Score::Distance { point: point.text()?, to, measure })
}

/// Which closures.
pub(super) fn closures(node: &Node<'_>) -> Result<Closures, StudyError> {
    if !node.is_table() {
        return node.one_of(&[("all", true), ("guess", false)]).map(|all| match all {
            true => Closures::All,
            false => Closures::OfGuess,
        });
    }
    let sign = |(name, value): (String, Node<'_>)| Ok((name, value.one_of(&[("+", Sign::Plus), ("-", Sign::Minus)])?));
    Ok(Closures::Signs(node.entries()?.into_iter().map(sign).collect::<Result<_, StudyError>>()?))
}

/// An input.
pub(super) fn ramp(node: &Node<'_>) -> Result<Ramp, StudyError> {
    if !node.is_table() {
        return node.number().map(|value| Ramp { from: value, to: value });
    }
    node.only(&["from", "to"])?;
    match (node.get("from"), node.get("to")) {
        (Some(from), Some(to)) => Ok(Ramp { from: from.number()?, to: to.number()? }),
        _ => Err(node.wrong("an input is a number or { from = 0, to = 1 }")),
    }
}

/// A histogram.
pub(super) fn histogram(node: &Node<'_>) -> Result<Histogram, StudyError> {
    node.only(&["of", "from", "to", "bins"])?;
    let (Some(column), Some(from), Some(to), Some(bins)) =
        (node.get("of"), node.get("from"), node.get("to"), node.get("bins"))
    else {
        return Err(node.wrong("a histogram is { of = \"swing\", from = 0, to = 1, bins = 20 }"));
    };
    let bins = usize::try_from(bins.count()?).unwrap_or(usize::MAX);
    Ok(Histogram { of: column.text()?, from: from.number()?, to: to.number()?, bins })
}
