//! Laws of typeset equations: the printed LaTeX, read and evaluated, agrees with the code.

mod latex;
mod plan;

pub(crate) use plan::typeset_solutions_are_the_analysis;

use crate::{When, random_configuration};
use kin_core::notation::{Name, Notation};
use kin_runtime::Subset;
use kin_tests::random::Random;
use kin_tests::subject::Subject;
use latex::{Reader, Value};
use std::collections::HashMap;
use std::fs;

/// The lines of all displayed equations in a document.
fn lines(document: &str) -> Vec<String> {
    let displays = document.split("\\begin{align*}\n").skip(1);
    let inside = displays.filter_map(|text| text.split("\n\\end{align*}").next());
    // The right-hand side of an equation may continue on the next line.
    let whole = inside.map(|text| text.replace(" \\\\\n&\\quad {} ", " "));
    let whole = whole.map(|text| text.replace(r"\bigl(", r"\left(").replace(r"\bigr)", r"\right)"));
    whole.flat_map(|text| text.split(" \\\\\n").map(str::to_owned).collect::<Vec<_>>()).collect()
}

/// The lines that the program writes for a part of the equations.
fn written(mechanism: &dyn Subject, part: &str) -> Vec<String> {
    let model = mechanism.model();
    let name = format!("kin-typeset-{}-{}-{part}.tex", std::process::id(), model.name);
    let file = std::env::temp_dir().join(name);
    let out = file.display().to_string();
    let _ = mechanism.run(["program", "equations", "--part", part, "--out", &out].map(Into::into).to_vec());
    let document = fs::read_to_string(&file).expect("the document is written");
    fs::remove_file(&file).expect("the file is there");
    lines(&document)
}

/// The values of all symbols: t, parameters, inputs, and coordinates with the given derivatives.
fn symbols(mechanism: &dyn Subject, when: &When, q: &[&[f64]]) -> HashMap<String, Value> {
    let (mut symbols, model) = (HashMap::new(), mechanism.model());
    let mut put = |name: &str, value: f64| symbols.insert(Name::new(name).write(Notation::Latex), Value::of(value));
    put("t", when.t);
    put("pi", std::f64::consts::PI);
    for (info, value) in model.parameters.iter().zip(&mechanism.parameters()) {
        put(info.name, *value);
    }
    let suffixes = ["", "_dot", "_ddot"];
    for (k, info) in model.coordinates.iter().enumerate() {
        for (order, suffix) in q.iter().zip(suffixes) {
            put(&format!("{}{suffix}", info.name), order[k]);
        }
    }
    for (name, u) in model.inputs.iter().zip(&when.inputs) {
        for (value, suffix) in [u.value, u.rate, u.acceleration].into_iter().zip(suffixes) {
            put(&format!("{name}{suffix}"), value);
        }
    }
    symbols
}

fn close(found: Value, expected: f64) -> bool {
    (found.value - expected).abs() <= 1e-12 * found.size.max(expected.abs()).max(1.0)
}

/// Compares Φ, every entry of Φ_q, Φ_t and γ of every row, at random configurations.
pub(crate) fn typeset_equations_are_the_code(mechanism: &dyn Subject) {
    let model = mechanism.model();
    let lines = written(mechanism, "rows");
    let mut random = Random::new(83);
    for _ in 0..3 {
        let (when, q, q_dot) = random_configuration(mechanism, &mut random);
        let at = when.at();
        let expected = mechanism.evaluate(Subset::ALL, &at, &q, &q_dot);
        let symbols = symbols(mechanism, &when, &[&q, &q_dot]);
        let function = |name: &str, order: usize, x: f64| {
            let place = model.functions.iter().position(|function| *function == name)?;
            mechanism.evaluate_function(place, x)?.get(order).copied()
        };
        let mut reader = Reader { symbols: &symbols, function: &function };
        let mut value =
            |left: &str, text: &str| reader.read(text).unwrap_or_else(|error| panic!("{left} = {text}: {error}"));
        let mut seen = 0;
        for (place, row) in model.rows.iter().enumerate() {
            let name = row.name.replace('_', r"\_");
            for letter in [r"\Phi", r"\eta"] {
                let phi = format!(r"{letter}_{{\mathrm{{{name}}}}}");
                let after = |left: &str| lines.iter().find_map(|line| line.strip_prefix(&format!("{left} &= ")));
                let Some(own) = after(&phi) else { continue };
                seen += 1;
                let own = value(&phi, own.strip_suffix(" = 0").expect("= 0"));
                if letter == r"\Phi" {
                    assert!(close(own, expected.phi[place]), "{phi}: {own:?}, {}", expected.phi[place]);
                }
                let entries = model.constraint_pattern.entries.iter().zip(&expected.phi_q);
                for (&(_, column), &entry) in entries.filter(|((row, _), _)| *row == place) {
                    let dot = if letter == r"\Phi" { "" } else { "_dot" };
                    let by = Name::new(&format!("{}{dot}", model.coordinates[column].name)).write(Notation::Latex);
                    let left = format!(r"\frac{{\partial {phi}}}{{\partial {by}}}");
                    let found = value(&left, after(&left).unwrap_or_else(|| panic!("{left} is missing")));
                    assert!(close(found, entry), "{left}: {found:?}, {entry}");
                }
                let rest = if letter == r"\Phi" {
                    format!(r"\frac{{\partial {phi}}}{{\partial t}}")
                } else {
                    format!(r"{phi}\big|_{{\dot q = 0}}")
                };
                let gamma = format!(r"\gamma_{{\mathrm{{{name}}}}}");
                for (left, expected) in [(rest, expected.phi_t[place]), (gamma, expected.gamma[place])] {
                    let found = value(&left, after(&left).unwrap_or_else(|| panic!("{left} is missing")));
                    assert!(close(found, expected), "{left}: {found:?}, {expected}");
                }
            }
        }
        assert_eq!(seen, model.rows.len());
    }
}
