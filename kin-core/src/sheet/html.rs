//! A sheet as a page with MathML, which browsers show without scripts.

use super::content::{Joint, Sheet};
use super::lines::{EquationLine, derivatives, row_equation};
use super::steps::SheetStep;
use crate::notation::Notation::MathMl;
use crate::notation::escaped;
use crate::vectors;

/// Width of a page in columns of plain text.
pub(super) const WIDTH: usize = 92;

/// Styles of equations, limited to a separate class, because the surrounding page may contain tables, too.
pub(super) const STYLE: &str = "\
.kin-eq{overflow-x:auto;overflow-y:hidden;margin:.2rem 0 .6rem;padding-bottom:.2rem}\
.kin-eq.kin-eq table{display:table;width:auto;margin:0;border:0;border-collapse:separate;border-spacing:0 .1rem}\
.kin-eq.kin-eq tr,.kin-eq.kin-eq tbody tr:nth-child(2n){background:none;border:0}\
.kin-eq.kin-eq td{border:0;padding:.06rem .2rem;vertical-align:baseline;white-space:nowrap}\
.kin-eq.kin-eq td:first-child{text-align:right}\
.kin-eq.kin-eq p{margin:.2rem 0}\
.kin-eq math{font-size:1.06em;math-style:normal}\
.kin-eq mfrac{margin:0 .1em}";

/// Shadows at the sides towards which an equation can be scrolled, and a scroll bar that is always visible.
const SHADOWS: &str = "\
.kin-eq{scrollbar-width:thin;background:\
linear-gradient(90deg,Canvas 30%,transparent) left/2.5rem 100% no-repeat local,\
linear-gradient(270deg,Canvas 30%,transparent) right/2.5rem 100% no-repeat local,\
radial-gradient(farthest-side at 0 50%,#8886,transparent) left/.9rem 100% no-repeat scroll,\
radial-gradient(farthest-side at 100% 50%,#8886,transparent) right/.9rem 100% no-repeat scroll}";

impl Sheet {
    /// A self-contained page.
    pub fn page(&self) -> String {
        let name = escaped(&self.name);
        let sections: String = self.joints_written().iter().map(section).collect();
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{name}: equations</title>\n\
             <style>:root{{color-scheme:light dark}}body{{font:16px/1.5 system-ui,sans-serif;margin:1rem auto;\
             max-width:60rem;padding:0 1rem}}h2{{margin:1.6rem 0 .4rem;font-size:1.1rem}}\
             h2 span{{opacity:.65;font-weight:400}}.hint{{display:none;opacity:.65}}\
             @media(max-width:52rem){{.hint{{display:block}}}}{STYLE}{SHADOWS}</style>\n</head>\n<body>\n<h1>{name}</h1>\n<p>{}</p>\n\
             <p class=\"hint\">Long equations scroll to the side.</p>\n{sections}{}{}{}</body>\n</html>\n",
            escaped(&self.doc),
            self.html_assembled(),
            self.html_solution(),
            self.html_dynamics().map_or_else(String::new, |forces| format!("<h1>Forces</h1>\n{forces}"))
        )
    }
}

impl Sheet {
    /// The matrices of the mechanism; empty if they are not wanted or too large.
    fn html_assembled(&self) -> String {
        let assembled = self.assembled(MathMl).map(|assembled| assembled.lines(MathMl));
        assembled.map_or_else(String::new, |lines| format!("<h1>All rows together</h1>\n{}", table(lines.into_iter())))
    }

    /// The steps of the plan; empty if there are none.
    fn html_solution(&self) -> String {
        let mut out = String::new();
        if !self.steps.is_empty() || !self.unsolved.is_empty() {
            out.push_str("<h1>Solution</h1>\n");
        }
        if !self.unsolved.is_empty() {
            out.push_str(&format!("<p>No plan: {}.</p>\n", escaped(&self.unsolved)));
        }
        out + &self.steps.iter().map(|step| html_step(step, "h2")).collect::<String>()
    }
}

/// A step: the lines for positions, with the other lines folded.
pub(super) fn html_step(step: &SheetStep, heading: &str) -> String {
    let [position, velocity, acceleration] =
        [0, 1, 2].map(|order| table(step.lines[order].iter().flat_map(|line| line.write(MathMl, WIDTH))));
    format!(
        "<{heading}>{} <span>{}</span></{heading}>\n{position}<details><summary>Velocity and acceleration</summary>\n\
         {velocity}{acceleration}</details>\n",
        step.number,
        escaped(&step.what)
    )
}

fn section(joint: &Joint) -> String {
    let rows: String = joint
        .rows
        .iter()
        .map(|row| table(std::iter::once(row_equation(row, MathMl, WIDTH)).chain(derivatives(row, MathMl, WIDTH))))
        .collect();
    format!(
        "<section>\n<h2>{} <span>{}</span></h2>\n{}{rows}</section>\n",
        escaped(&joint.name),
        escaped(&joint.what),
        own_equations(joint)
    )
}

/// A joint's own equations, one below the other.
pub(super) fn own_equations(joint: &Joint) -> String {
    if joint.vector_equations.is_empty() {
        return String::new();
    }
    let lines =
        joint.vector_equations.iter().map(|equation| format!("<p>{}</p>", math(&vectors::write(equation, MathMl))));
    format!("<div class=\"kin-eq\">{}</div>\n", lines.collect::<String>())
}

/// Equations aligned at their equals signs; empty if there are none.
pub(super) fn table(lines: impl Iterator<Item = EquationLine>) -> String {
    let row = |line: EquationLine| {
        let more = |part: &String| {
            format!("<tr><td></td><td>{}</td></tr>", math(&format!("<mspace width=\"1.6em\"></mspace>{part}")))
        };
        let mut right = line.right.iter();
        let first = right.next().map_or("", String::as_str);
        let (left, first) = (math(&line.left), math(&format!("<mo>=</mo>{first}")));
        format!("<tr><td>{left}</td><td>{first}</td></tr>{}", right.map(more).collect::<String>())
    };
    let rows: String = lines.map(row).collect();
    if rows.is_empty() { rows } else { format!("<div class=\"kin-eq\"><table>{rows}</table></div>\n") }
}

pub(super) fn math(inner: &str) -> String {
    format!("<math>{inner}</math>")
}
