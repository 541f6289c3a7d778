//! A sheet as documentation of the mechanism's struct: HTML inside Markdown, without network access.
//!
//! A block of HTML ends at a blank line, so that no blank lines are written. For large mechanisms the equations of the
//! first joints are written out and the other joints only named; derivatives are folded.

use super::content::{Joint, Sheet};
use super::html::{STYLE, WIDTH, html_step, math, own_equations, table};
use super::lines::{derivatives, row_equation};
use super::shown::symbol;
use crate::notation::Notation::MathMl;
use crate::notation::escaped;

/// Size in bytes beyond which joints are only named. A four-bar needs a tenth of this size.
const MAX_JOINTS_BYTES: usize = 200_000;

/// Largest number of coordinates that are listed.
const MAX_LISTED_COORDINATES: usize = 60;

impl Sheet {
    /// Sections for the documentation of the struct, to stand after the user's own text.
    ///
    /// Of a family only one member is written, with the names of the others; beyond 200 000 bytes joints are only
    /// named. `texts` are what the user wrote about joints, by name; a text about a family stands at each of its members.
    pub fn docs(&self, texts: &[(String, String)]) -> String {
        let mut out =
            format!("\n\n# Equations\n\n<style>{STYLE}{OWN}</style>\n<div class=\"kin-sheet\">\n{}", self.q());
        let mut named: Vec<&str> = Vec::new();
        for joint in &self.joints {
            if out.len() > MAX_JOINTS_BYTES {
                named.push(&joint.name);
                named.extend(joint.alike.iter().map(String::as_str));
            } else {
                out.push_str(&section(joint, texts));
            }
        }
        if !named.is_empty() {
            out.push_str(&format!(
                "<p>The equations of {} are omitted here; the command <code>equations</code> prints them.</p>\n",
                enumeration(&named)
            ));
        }
        out.push_str("</div>\n");
        out + &self.docs_solution() + &self.docs_dynamics()
    }

    /// The steps of the plan as a section, which is cut if it is too long.
    fn docs_solution(&self) -> String {
        if self.steps.is_empty() {
            return String::new();
        }
        let mut out = String::from("\n\n# Solution\n\n<div class=\"kin-sheet\">\n");
        for step in &self.steps {
            if out.len() > MAX_JOINTS_BYTES {
                out.push_str("<p>The command <code>equations</code> prints the remaining steps.</p>\n");
                break;
            }
            out.push_str(&html_step(step, "h4"));
        }
        out.push_str("</div>\n");
        out
    }

    /// The equations of motion in a section of their own, unless they are too long.
    fn docs_dynamics(&self) -> String {
        let Some(forces) = self.html_dynamics() else { return String::new() };
        let forces = match forces.len() > MAX_JOINTS_BYTES {
            true => "<p>The command <code>equations</code> prints M and Q.</p>\n".to_owned(),
            false => forces,
        };
        format!("\n\n# Forces\n\n<div class=\"kin-sheet\">\n{forces}</div>\n")
    }

    /// q = (…)ᵀ, in parts between which a line may end.
    fn q(&self) -> String {
        let count = self.coordinates.len();
        let names = self.coordinates.iter().take(MAX_LISTED_COORDINATES).map(|name| symbol(name, MathMl));
        let mut parts: Vec<String> =
            names.chain((count > MAX_LISTED_COORDINATES).then(|| "<mo>…</mo>".to_owned())).collect();
        let last = parts.len().saturating_sub(1);
        for (index, part) in parts.iter_mut().enumerate() {
            let before = if index == 0 { "<mi>𝐪</mi><mo>=</mo><mo>(</mo>" } else { "" };
            let after = if index == last { "<msup><mo>)</mo><mtext>T</mtext></msup>" } else { "<mo>,</mo>" };
            *part = math(&format!("{before}{part}{after}"));
        }
        let rows: usize = self.joints.iter().map(|joint| joint.rows.len() * (1 + joint.alike.len())).sum();
        format!(
            "<p>{count} coordinate{}, {rows} row{} of Φ:</p>\n<div class=\"kin-eq\"><p>{}</p></div>\n",
            plural(count),
            plural(rows),
            parts.join(" ")
        )
    }
}

/// Styles in addition to those of equations.
const OWN: &str = "\
.kin-sheet h4{margin:1.1rem 0 .1rem;font-size:1.02rem}\
.kin-sheet h4 span{font-weight:400;opacity:.75;margin-left:.5em}\
.kin-sheet details{margin:0 0 .4rem}";

fn section(joint: &Joint, texts: &[(String, String)]) -> String {
    let name = joint.name.split('[').next();
    let text = texts.iter().find(|(documented, _)| Some(documented.as_str()) == name);
    let text = text.map_or_else(String::new, |(_, text)| format!("<p>{}</p>\n", escaped(text)));
    let first = table(joint.rows.iter().map(|row| row_equation(row, MathMl, WIDTH)));
    let folded: String = joint.rows.iter().map(|row| table(derivatives(row, MathMl, WIDTH).into_iter())).collect();
    let alike = match joint.alike.as_slice() {
        [] => String::new(),
        names => format!(
            "<p>The equations of {} have the same form.</p>\n",
            enumeration(&names.iter().map(String::as_str).collect::<Vec<_>>())
        ),
    };
    let summary = match joint.rows.iter().any(|row| row.position) {
        true => "Φ<sub>q</sub>, Φ<sub>t</sub> and γ",
        false => "Derivatives",
    };
    format!(
        "<h4>{}<span>{}</span></h4>\n{text}{}{first}<details><summary>{summary}</summary>\n{folded}</details>\n{alike}",
        escaped(&joint.name),
        escaped(&joint.what),
        own_equations(joint)
    )
}

/// `a, b and c`; of more than six names only the first two and the last.
fn enumeration(names: &[&str]) -> String {
    let escaped: Vec<String> = names.iter().map(|name| escaped(name)).collect();
    match escaped.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [before @ .., last] if before.len() < 6 => format!("{} and {last}", before.join(", ")),
        [first, second, .., last] => format!("{first}, {second}, … {last} ({} in all)", names.len()),
        [..] => escaped.join(", "),
    }
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
