//! As aligned text.

use super::lines::{Line, derivatives, own};
use super::{Joint, Row, Sheet, vectors};
use crate::notation::Notation::Unicode;

/// Columns of a page.
const WIDTH: usize = 100;

impl Sheet {
    /// All joints, one below the other.
    pub fn text(&self) -> String {
        let joints = self.joints.iter().map(joint);
        format!("{}\n{}", self.name, joints.collect::<String>())
    }
}

fn joint(joint: &Joint) -> String {
    let mut out = format!("\n{}  {}\n", joint.name, joint.what);
    for equation in &joint.own {
        out.push_str(&format!("    {}\n", vectors::write(equation, Unicode)));
    }
    for row in &joint.rows {
        out.push('\n');
        out.push_str(&of_row(row));
    }
    out
}

fn of_row(row: &Row) -> String {
    let first = own(row, Unicode, usize::MAX);
    let first = Line { left: format!("{}  {}", first.left, row.name), ..first };
    aligned(std::iter::once(first).chain(derivatives(row, Unicode, usize::MAX)).collect())
}

/// Equations with their signs below one another.
pub(super) fn aligned(lines: Vec<Line>) -> String {
    let width = lines.iter().map(|line| shown(&line.left)).max().unwrap_or(0);
    let line = |Line { left, right }: Line| {
        let pad = " ".repeat(width - shown(&left));
        let indent = " ".repeat(width + 7);
        let wrapped = wrap(&right.concat(), WIDTH.saturating_sub(width + 7).max(40));
        format!("    {left}{pad} = {}\n", wrapped.join(&format!("\n{indent}")))
    };
    lines.into_iter().map(line).collect()
}

/// Columns that a text takes: combining dots take none.
fn shown(text: &str) -> usize {
    text.chars().filter(|c| !('\u{300}'..='\u{36f}').contains(c)).count()
}

/// Broken before a sign that stands between terms.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut parts = text.split(' ').peekable();
    while let Some(part) = parts.next() {
        let Some(line) = lines.last_mut() else { break };
        let sign = matches!(part, "+" | "−");
        let next = parts.peek().map_or(0, |next| shown(next));
        if !line.is_empty() && shown(line) + 1 + shown(part) + usize::from(sign) * (next + 1) > width {
            lines.push(part.to_owned());
        } else {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(part);
        }
    }
    lines
}
