//! Examples for the help, with the names of the mechanism.

use super::engine::Engine;
use super::paint;
use super::trial::{ExampleValues, quoted};
use crate::measure::Measure;
use crate::model::{Level, Model};
use crate::present::number::{plain, rounded};

/// Width of the help in columns.
const COLUMNS: usize = 100;
/// Largest width of the command of an example that has its comment on the same line.
const MAX_WIDTH_WITH_COMMENT: usize = 62;

/// The arguments after the program's name, and a comment.
pub(super) type Example = (String, &'static str);

/// The text of `-h` and `--help` besides the options.
pub(super) struct Help {
    pub(super) examples: fn(&Names) -> Vec<Option<Example>>,
    pub(super) details: &'static str,
}

/// Names of this mechanism that examples can use, with values; `None` for what the mechanism does not have.
#[derive(Clone, Debug, Default)]
#[cfg_attr(not(all(feature = "plot", feature = "equations")), allow(dead_code, reason = "for their examples"))]
pub(super) struct Names {
    pub(super) program: String,
    /// `l1=0.1`
    pub(super) set: Option<String>,
    /// `l1=0.1,l2=0.4`
    pub(super) set_two: Option<String>,
    /// `l1=0.001`, a hundredth of the value
    pub(super) tolerance: Option<String>,
    /// `l1=0.09..0.11:5`
    pub(super) vary: Option<String>,
    pub(super) guess: Option<String>,
    pub(super) mode: Option<String>,
    /// The options that every analysis needs: inputs, and coordinates that the drivers leave open.
    needed: String,
    /// An instant within the motion, and one at its end.
    pub(super) at: String,
    pub(super) to: String,
    /// A coordinate that no driver prescribes directly.
    pub(super) coordinate: Option<&'static str>,
    /// A point, or a body whose origin moves.
    pub(super) path: Option<&'static str>,
    /// The first named point of a mechanism that t alone drives.
    #[cfg_attr(not(feature = "design"), allow(dead_code, reason = "examples of `design` alone have one"))]
    pub(super) point: Option<&'static str>,
    /// A quantity, and its velocity ratio to the first driver or input.
    pub(super) ratio: Option<String>,
    /// The first transmission angle.
    pub(super) transmission: Option<String>,
    pub(super) joints: Vec<&'static str>,
    /// Whether there are bodies or points to draw.
    pub(super) drawn: bool,
    /// Whether there are unilateral conditions.
    pub(super) conditions: bool,
    /// Whether there are masses or loads.
    pub(super) loads: bool,
    /// Whether parameters and t determine the position: there are no rows of velocity level.
    pub(super) determined: bool,
    /// Whether there are proofs of a configuration, of all closures, and of all limits.
    pub(super) proven: [bool; 3],
    /// Whether the motion along the arc closes.
    pub(super) arc: bool,
}

impl Names {
    /// `trial` has values that were found to work; without it general defaults are used.
    pub(super) fn new(program: String, engine: &dyn Engine, trial: Option<ExampleValues>) -> Self {
        let model = engine.model();
        let values = engine.parameters();
        let parameters: Vec<(&str, f64)> =
            model.parameters.iter().map(|p| p.name).zip(values).filter(|(_, value)| value.is_finite()).collect();
        let set = |many: usize| {
            let pairs = parameters.get(..many)?;
            let pairs: Vec<String> = pairs.iter().map(|(name, value)| format!("{name}={}", plain(*value))).collect();
            Some(quoted(pairs.join(",")))
        };
        let sized = parameters.iter().find(|(_, value)| *value != 0.0);
        let tolerance = sized.map(|(name, value)| quoted(format!("{name}={}", rounded(value.abs() / 100.0))));
        let trial = trial.unwrap_or_default();
        let guesses = engine.guesses();
        let guess = guesses.iter().zip(model.coordinates).find_map(|(guess, coordinate)| {
            guess.map(|guess| quoted(format!("{}={}", coordinate.name, rounded(guess))))
        });
        let (mode, vary) = (trial.mode.map(quoted), trial.vary.map(quoted));
        Self {
            program,
            proven: trial.proven,
            arc: trial.arc,
            set: set(1),
            set_two: set(2),
            tolerance,
            vary,
            guess,
            mode,
            needed: trial.needed,
            at: trial.at,
            to: trial.to,
            coordinate: undriven(model, &trial.unmoved),
            path: path(model),
            point: model.points.first().map(|point| point.name).filter(|_| model.inputs.is_empty()),
            ratio: ratio(model, &trial.unmoved),
            transmission: Measure::transmission_angles(model).first().map(|measure| measure.name().to_owned()),
            drawn: !model.bodies.is_empty() || !model.points.is_empty(),
            conditions: !model.conditions.is_empty(),
            loads: model.forces.is_some(),
            determined: model.rows.iter().all(|row| row.level != Level::Velocity),
            joints: model.joints.iter().map(|joint| joint.name).take(2).collect(),
        }
    }

    /// An example of an analysis, with the options that every analysis needs.
    pub(super) fn analysis(&self, args: &str, comment: &'static str) -> Option<Example> {
        Some((format!("{args}{}", self.needed).trim_start().to_owned(), comment))
    }

    /// As [`analysis`](Self::analysis), with a value at the end of `args`; `None` if there is no value.
    pub(super) fn with(&self, args: &str, value: &Option<String>, comment: &'static str) -> Option<Example> {
        self.analysis(&format!("{args} {}", value.as_ref()?), comment)
    }

    /// The examples below a heading.
    pub(super) fn render(&self, examples: &[Option<Example>]) -> String {
        let lines: Vec<(String, &str)> = (examples.iter().flatten())
            .map(|(args, comment)| (format!("{} {args}", self.program).trim_end().to_owned(), *comment))
            .collect();
        if lines.is_empty() {
            return String::new();
        }
        let width = |line: &str| line.chars().count();
        let longest =
            lines.iter().map(|(line, _)| width(line)).filter(|w| *w <= MAX_WIDTH_WITH_COMMENT).max().unwrap_or(0);
        let mut out = format!("{}\n", paint::heading("Examples:"));
        for (line, comment) in lines {
            let literal = paint::literal(&line);
            match width(&line) {
                _ if comment.is_empty() => out.push_str(&format!("  {literal}\n")),
                wide if wide > longest || longest + width(comment) + 4 > COLUMNS => {
                    out.push_str(&format!("  {literal}\n      {comment}\n"))
                }
                narrow => out.push_str(&format!("  {literal}{}  {comment}\n", " ".repeat(longest - narrow))),
            }
        }
        out
    }
}

/// A coordinate that no driver prescribes directly and that is not `unmoved`: the last angle, or else the last
/// coordinate.
fn undriven(model: &Model, unmoved: &[usize]) -> Option<&'static str> {
    let simply_driven = |index: usize| {
        model.rows.iter().enumerate().filter(|(_, row)| row.driving || row.rheonomic).any(|(row, _)| {
            let mut entries = model.constraint_pattern.entries.iter().filter(|(r, _)| *r == row);
            entries.next().is_some_and(|(_, column)| *column == index) && entries.next().is_none()
        })
    };
    let free = || model.coordinates.iter().enumerate().filter(|(index, _)| !simply_driven(*index)).rev();
    let mut moving = free().filter(|(index, _)| !unmoved.contains(index));
    let last = moving.clone().next().or_else(|| free().next());
    moving.find(|(_, c)| c.kind.is_angle()).or(last).map(|(_, c)| c.name).or(model.coordinates.first().map(|c| c.name))
}

/// `tip.x tip.x/drive`, or the same of a coordinate that no driver prescribes directly.
fn ratio(model: &'static Model, unmoved: &[usize]) -> Option<String> {
    let point = model.points.first().map(|point| format!("{}.x", point.name));
    let name = point.or_else(|| undriven(model, unmoved).map(str::to_owned))?;
    let ratio = format!("{name}/{}", Measure::drivers(model).first()?);
    Measure::named(model, &ratio).map(|_| format!("{} {}", quoted(name), quoted(ratio)))
}

fn path(model: &Model) -> Option<&'static str> {
    let moving = |name: &&str| model.coordinates.iter().any(|c| c.name.strip_prefix(name) == Some(".x"));
    let body = || model.bodies.iter().rev().map(|body| body.name).find(moving);
    model.points.first().map(|point| point.name).or_else(body)
}
