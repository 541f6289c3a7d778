//! As aligned text.

use super::own::own;
use super::{Row, joints, rows, symbol, what, write};
use crate::model::{Level, Model};
use kin_core::notation::Notation::Unicode;

/// Columns of a page.
const WIDTH: usize = 100;

/// All joints, one below the other.
pub(crate) fn text(model: &Model, chosen: &[usize]) -> String {
    let mut out = format!("{}\n", model.name);
    for joint in joints(model, chosen) {
        out.push_str(&format!("\n{}  {}\n", joint.name, what(model, joint)));
        for equation in own(model, joint) {
            out.push_str(&format!("    {}\n", write::write(&equation, Unicode)));
        }
        for row in rows(model, joint) {
            out.push('\n');
            out.push_str(&of_row(&row));
        }
    }
    out
}

fn of_row(row: &Row<'_>) -> String {
    let position = row.level == Level::Position;
    let (phi, equal) = if position { ("Φ", " = 0") } else { ("η", " = 0") };
    let mut lines = vec![(format!("{phi}  {}", row.name), row.phi.write(Unicode) + equal)];
    for (name, entry) in &row.phi_q {
        let of = if position {
            format!("∂Φ/∂{}", symbol(name, Unicode))
        } else {
            format!("∂η/∂{}", symbol(&format!("{name}_dot"), Unicode))
        };
        lines.push((of, entry.write(Unicode)));
    }
    let rest = if position { "Φ_t" } else { "η at rest" };
    lines.push((rest.to_owned(), row.phi_t.write(Unicode)));
    lines.push(("γ".to_owned(), row.gamma.write(Unicode)));
    let width = lines.iter().map(|(left, _)| shown(left)).max().unwrap_or(0);
    let line = |(left, right): (String, String)| {
        let pad = " ".repeat(width - shown(&left));
        let indent = " ".repeat(width + 7);
        let wrapped = wrap(&right, WIDTH.saturating_sub(width + 7).max(40));
        format!("    {left}{pad} = {}\n", wrapped.join(&format!("\n{indent}")))
    };
    let mut text: String = lines.drain(1..).map(line).collect();
    let (name, phi) = lines.remove(0);
    text.insert_str(0, &line((name, phi)));
    text
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
        let line = lines.last_mut().expect("there is always a line");
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
