//! A sheet as aligned text.

use super::content::{Joint, Sheet};
use super::lines::{EquationLine, derivatives, row_equation};
use super::shown::Row;
use crate::notation::Notation::Unicode;
use crate::vectors;

/// Width of a page in columns.
const WIDTH: usize = 100;

impl Sheet {
    /// The whole sheet.
    pub fn text(&self) -> String {
        let joints = self.joints_written().iter().map(joint);
        let joints: String = joints.collect();
        let [assembled, solution, dynamics] = [self.text_assembled(), self.text_solution(), self.text_dynamics()];
        format!("{}\n{joints}{assembled}{solution}{dynamics}", self.name)
    }

    /// The matrices of the mechanism; empty if they are not wanted or too large.
    fn text_assembled(&self) -> String {
        let Some(assembled) = self.assembled(Unicode) else { return String::new() };
        let mut out = format!("\nAll rows together\n{}", assembled.text());
        if !assembled.long.is_empty() {
            out.push_str(&format!("\n{}", aligned(assembled.long)));
        }
        out
    }

    /// The steps of the plan; empty if there are none.
    fn text_solution(&self) -> String {
        if self.steps.is_empty() && self.unsolved.is_empty() {
            return String::new();
        }
        let mut out = String::from("\nSolution\n");
        if !self.unsolved.is_empty() {
            out.push_str(&format!("    no plan: {}\n", self.unsolved));
        }
        for step in &self.steps {
            out.push_str(&format!("\n{}  {}\n", step.number, step.what));
            for lines in step.lines.iter().filter(|lines| !lines.is_empty()) {
                out.push('\n');
                out.push_str(&aligned(lines.iter().flat_map(|line| line.write(Unicode, usize::MAX)).collect()));
            }
        }
        out
    }
}

fn joint(joint: &Joint) -> String {
    let mut out = format!("\n{}  {}\n", joint.name, joint.what);
    for equation in &joint.vector_equations {
        out.push_str(&format!("    {}\n", vectors::write(equation, Unicode)));
    }
    for row in &joint.rows {
        out.push('\n');
        out.push_str(&of_row(row));
    }
    out
}

fn of_row(row: &Row) -> String {
    let first = row_equation(row, Unicode, usize::MAX);
    let first = EquationLine { left: format!("{}  {}", first.left, row.name), ..first };
    aligned(std::iter::once(first).chain(derivatives(row, Unicode, usize::MAX)).collect())
}

/// Equations aligned at their equals signs.
pub(super) fn aligned(lines: Vec<EquationLine>) -> String {
    let width = lines.iter().map(|line| shown(&line.left)).max().unwrap_or(0);
    let line = |EquationLine { left, right }: EquationLine| {
        let pad = " ".repeat(width - shown(&left));
        let indent = " ".repeat(width + 7);
        let wrapped = wrap(&right.concat(), WIDTH.saturating_sub(width + 7).max(40));
        format!("    {left}{pad} = {}\n", wrapped.join(&format!("\n{indent}")))
    };
    lines.into_iter().map(line).collect()
}

/// Width of a text: combining dots have no width.
pub(super) fn shown(text: &str) -> usize {
    text.chars().filter(|c| !('\u{300}'..='\u{36f}').contains(c)).count()
}

/// Breaks a text before the signs of its terms, outside of brackets if possible. A term that is too long is broken
/// before the signs inside its brackets, and at any space if necessary.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let fits = |line: &str, more: &str| line.is_empty() || shown(line) + 1 + shown(more) <= width;
    for term in split(text, 0) {
        let parts = match shown(&term) <= width {
            true => vec![term],
            false => split(&term, usize::MAX),
        };
        for part in parts {
            let words = match shown(&part) <= width {
                true => vec![part.as_str()],
                false => part.split(' ').collect(),
            };
            for word in words {
                match lines.last_mut() {
                    Some(line) if fits(line, word) => {
                        line.push_str(if line.is_empty() { "" } else { " " });
                        line.push_str(word);
                    }
                    _ => lines.push(word.to_owned()),
                }
            }
        }
    }
    lines
}

/// Splits a sum into terms with their signs, also inside of up to `brackets` nested brackets.
fn split(text: &str, brackets: usize) -> Vec<String> {
    let (mut terms, mut depth) = (Vec::<String>::new(), 0_usize);
    for part in text.split(' ') {
        match terms.last_mut() {
            Some(last) if depth > brackets || !matches!(part, "+" | "−" | "=") => {
                last.push(' ');
                last.push_str(part);
            }
            _ => terms.push(part.to_owned()),
        }
        depth = (depth + part.matches('(').count()).saturating_sub(part.matches(')').count());
    }
    terms
}
