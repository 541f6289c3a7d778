//! The closed forms of the plan, read from LaTeX, agree with the solution by Newton's iteration.

use super::latex::{Reader, Value};
use super::{symbols, written};
use crate::When;
use crate::motion::grid;
use crate::plan::newton;
use kin_core::notation::{Name, Notation};
use kin_runtime::State;
use kin_tests::subject::Subject;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Evaluates every line of every step at instants of a motion; coordinates from other steps have the values of the
/// analysis.
pub(crate) fn typeset_solutions_are_the_analysis(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let plan = &model.plan;
    let lines = written(mechanism, "solution");
    if !plan.exists() {
        assert_eq!(lines, [""; 0]);
        return;
    }
    let mut compared = 0;
    for state in &newton(mechanism).sweep(&grid(from, to, 5)).unwrap() {
        let modes = mechanism.modes(&state.instant(), &state.q);
        let found = mechanism.by_plan(&state.instant(), &modes, &state.q);
        let margin = found.margins.iter().copied().fold(1.0, f64::min);
        if margin < 1e-4 {
            continue;
        }
        compared += 1;
        let mut sheet = Sheet::new(mechanism, state, &modes, margin);
        lines.iter().for_each(|line| sheet.line(line));
        assert_eq!(sheet.seen, 3 * model.coordinates.len(), "every coordinate, its rate and its acceleration");
    }
    assert!(compared > 0, "singular everywhere");
}

/// The state of reading a sheet from its beginning.
struct Sheet<'m> {
    mechanism: &'m dyn Subject,
    symbols: HashMap<String, Value>,
    /// The results of the analysis, with their orders of differentiation.
    expected: HashMap<String, (f64, usize)>,
    margin: f64,
    seen: usize,
}

impl<'m> Sheet<'m> {
    fn new(mechanism: &'m dyn Subject, state: &State, modes: &[f64], margin: f64) -> Self {
        let model = mechanism.model();
        let when = When::of(mechanism, state.t);
        let mut symbols = symbols(mechanism, &when, &[&state.q, &state.q_dot, &state.q_ddot]);
        for (mode, sign) in model.plan.modes.iter().zip(modes) {
            // The first name that the user has not used.
            let plain = format!("sigma_{}", mode.step + 1);
            let names = [plain.clone(), format!("{plain}[2]")].map(|name| Name::new(&name).write(Notation::Latex));
            let name = names.into_iter().find(|name| !symbols.contains_key(name)).expect("a free name");
            symbols.insert(name, Value::of(*sign));
        }
        let mut expected = HashMap::new();
        for (order, values) in [&state.q, &state.q_dot, &state.q_ddot].into_iter().enumerate() {
            for (info, value) in model.coordinates.iter().zip(values) {
                let name = format!("{}{}", info.name, ["", "_dot", "_ddot"][order]);
                expected.insert(Name::new(&name).write(Notation::Latex), (*value, order));
            }
        }
        Self { mechanism, symbols, expected, margin, seen: 0 }
    }

    fn read(&self, text: &str) -> Result<Value, String> {
        let function = |name: &str, order: usize, x: f64| {
            let place = self.mechanism.model().functions.iter().position(|function| *function == name)?;
            self.mechanism.evaluate_function(place, x)?.get(order).copied()
        };
        Reader { symbols: &self.symbols, function: &function }.read(text)
    }

    fn value(&self, text: &str) -> Value {
        self.read(text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    fn line(&mut self, line: &str) {
        let (left, right) = line.split_once(" &= ").unwrap_or_else(|| panic!("{line} is no equation"));
        if left.starts_with(r"\begin{pmatrix}") {
            return self.matrices(left, right);
        }
        if let Some(residual) = right.strip_suffix(" = 0") {
            self.seen += 1;
            return self.agree(line, self.value(residual), Value::of(0.0), 0);
        }
        let found = self.value(right);
        if let Some(&(expected, order)) = self.expected.get(left) {
            self.seen += 1;
            let expected = Value::of(expected);
            if !right.contains("atan2") || order > 0 {
                return self.agree(line, found, expected, order);
            }
            // Angles are compared modulo full turns; the angle of an n-fold one, which is divided by n, modulo the nth
            // part of a turn.
            let below = right.strip_suffix('}').and_then(|right| right.rsplit_once("}{"));
            let n = below.filter(|_| right.starts_with(r"\frac{")).and_then(|(_, n)| n.parse().ok()).unwrap_or(1.0);
            let turns: f64 = ((expected.value - found.value) * n / TAU).round() / n;
            let off = (found.value + turns * TAU - expected.value).abs();
            self.agree(line, Value { value: off, ..found }, Value { value: 0.0, ..expected }, order);
        } else if let Ok(product) = self.read(left) {
            self.seen += 1;
            self.agree(line, product, found, usize::from(left.contains("dot")) + usize::from(left.contains("ddot")));
        } else {
            self.symbols.insert(left.to_owned(), found);
        }
    }

    /// An equation matrix · unknowns = right-hand side.
    fn matrices(&mut self, left: &str, right: &str) {
        let both: Vec<Vec<Vec<&str>>> = left.split(r"\begin{pmatrix} ").skip(1).map(entries).collect();
        let [matrix, unknowns] = both.as_slice() else { panic!("{left}") };
        let right = entries(right.strip_prefix(r"\begin{pmatrix} ").expect("a column"));
        for (row, right) in matrix.iter().zip(&right) {
            let (mut sum, mut order) = (Value::of(0.0), 0);
            for (entry, unknown) in row.iter().zip(unknowns) {
                let (entry, x) = (self.value(entry), self.value(unknown[0]));
                sum = Value { value: sum.value + entry.value * x.value, size: sum.size + entry.size * x.size };
                order = self.expected[unknown[0]].1;
            }
            self.seen += 1;
            self.agree(left, sum, self.value(right[0]), order);
        }
    }

    fn agree(&self, line: &str, found: Value, expected: Value, order: usize) {
        let room = 1e-12 * found.size.max(expected.size).max(1.0) / self.margin.powf(0.5 + order as f64);
        assert!((found.value - expected.value).abs() <= room, "{line}: {found:?}, {expected:?}, {room:e}");
    }
}

/// The rows of a matrix, from the text after its beginning.
fn entries(inside: &str) -> Vec<Vec<&str>> {
    let inside = inside.split(r" \end{pmatrix}").next().unwrap_or_default();
    inside.split(r" \\ ").map(|row| row.split(" & ").collect()).collect()
}
