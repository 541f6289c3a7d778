//! A sheet as LaTeX: a document, or a fragment to be included in one.

use super::content::{Joint, Sheet};
use super::lines::{EquationLine, derivatives, row_equation};
use super::steps::ORDERS;
use crate::notation::Notation::Latex;
use crate::notation::{command, greek};
use crate::vectors;

/// Width of a page in columns of plain text.
const WIDTH: usize = 80;

impl Sheet {
    /// A complete document, which also compiles with pdfLaTeX.
    pub fn latex(&self) -> String {
        format!(
            "\\documentclass[a4paper]{{article}}\n\\usepackage[T1]{{fontenc}}\n\\usepackage[utf8]{{inputenc}}\n\
             \\usepackage{{amsmath}}\n\\usepackage[margin=2cm]{{geometry}}\n\\allowdisplaybreaks\n\\begin{{document}}\n\
             \\section*{{{}}}\n{}\\end{{document}}\n",
            prose(&self.name),
            self.latex_fragment()
        )
    }

    /// A fragment for a document: a paragraph for every joint, each with one display.
    pub fn latex_fragment(&self) -> String {
        let joints: String = self.joints_written().iter().map(joint).collect();
        joints + &self.latex_assembled() + &self.latex_solution() + &self.latex_dynamics()
    }

    /// The matrices of the mechanism; empty if they are not wanted or too large. A wide matrix is set in small type.
    fn latex_assembled(&self) -> String {
        let Some(assembled) = self.assembled(Latex) else { return String::new() };
        let (count, lines) = (assembled.coordinates.len(), assembled.lines(Latex));
        let size = if count > 6 { "\\scriptsize" } else { "\\small" };
        let displays: String = lines.iter().map(|line| display(&[equation(line)])).collect();
        format!(
            "\\section*{{All rows together}}\n\\begingroup{size}\\setcounter{{MaxMatrixCols}}{{{}}}\n\
             \\setlength{{\\arraycolsep}}{{2pt}}\n{displays}\\endgroup\n",
            count.max(10)
        )
    }

    /// The steps of the plan; empty if there are none.
    fn latex_solution(&self) -> String {
        if self.steps.is_empty() && self.unsolved.is_empty() {
            return String::new();
        }
        let mut out = String::from("\\section*{Solution}\n");
        if !self.unsolved.is_empty() {
            out.push_str(&format!("No plan: {}.\n", prose(&self.unsolved)));
        }
        for step in &self.steps {
            out.push_str(&format!("\\paragraph{{{}}} {}\n", step.number, prose(&step.what)));
            for (lines, order) in step.lines.iter().zip(ORDERS).filter(|(lines, _)| !lines.is_empty()) {
                let lines = lines.iter().flat_map(|line| line.write(Latex, WIDTH));
                out.push_str(&format!(
                    "% {order}\n{}",
                    display(&lines.map(|line| equation(&line)).collect::<Vec<_>>())
                ));
            }
        }
        out
    }
}

fn joint(joint: &Joint) -> String {
    let vectors = joint.vector_equations.iter().map(|equation| format!("& {}", vectors::write(equation, Latex)));
    let rows = joint.rows.iter().flat_map(|row| {
        std::iter::once(row_equation(row, Latex, WIDTH))
            .chain(derivatives(row, Latex, WIDTH))
            .map(|line| equation(&line))
    });
    let lines: Vec<String> = vectors.chain(rows).collect();
    format!("\\paragraph{{{}}} {}\n{}", prose(&joint.name), prose(&joint.what), display(&lines))
}

/// Aligned lines as one display; empty if there are none.
pub(super) fn display(lines: &[String]) -> String {
    match lines {
        [] => String::new(),
        lines => format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", lines.join(" \\\\\n")),
    }
}

/// An equation; continuation lines are indented to the right of the equals sign.
pub(super) fn equation(line: &EquationLine) -> String {
    let right: Vec<&str> = line.right.iter().map(|part| part.trim_start()).collect();
    format!("{} &= {}", line.left, right.join(" \\\\\n&\\quad {} "))
}

/// A text outside of formulas, with LaTeX's special characters escaped.
pub(super) fn prose(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '_' | '&' | '#' | '%' | '$' | '{' | '}' => out.extend(['\\', letter]),
            '\\' => out.push_str(r"\textbackslash{}"),
            '^' => out.push_str(r"\textasciicircum{}"),
            '~' => out.push_str(r"\textasciitilde{}"),
            '–' => out.push_str("--"),
            '±' => out.push_str(r"$\pm$"),
            '×' => out.push_str(r"$\times$"),
            _ => match greek(letter) {
                Some(name) => out.push_str(&format!("${}$", command(name))),
                None => out.push(letter),
            },
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{WIDTH, prose};
    use crate::notation::Notation::Latex;
    use crate::sheet::lines::row_equation;
    use crate::sheet::shown::{Row, ShownFormula};
    use crate::vectors::{self, EquationPiece, Letter};

    #[test]
    fn what_means_something_to_latex_stands_for_itself() {
        let escaped = r"\# \$ \% \& \_ \{ \} \textbackslash{} \textasciicircum{} \textasciitilde{}";
        assert_eq!(escaped, prose(r"# $ % & _ { } \ ^ ~"));
        // The letters are escaped one by one; an escape sequence is not escaped again.
        assert_eq!(r"100 \% of \textbackslash{}\{a\_b\}", prose(r"100 % of \{a_b}"));
        assert_eq!(r"crank -- rod, $\sigma$ = $\pm$1, 2$\times$2", prose("crank – rod, σ = ±1, 2×2"));
    }

    /// pdfLaTeX has no Greek letters in text and no Greek names in vectors.
    #[test]
    fn greek_letters_are_commands_everywhere() {
        let name = |text: &str| Letter::bold("A").of(text);
        assert_eq!(r"$\alpha$rm", prose("αrm"));
        let vector = vectors::write(&[EquationPiece::Vector(name("αrm_1"))], Latex);
        assert_eq!(r"\mathbf{A}_{\mathrm{{\alpha}rm\_1}}", vector);
        let zero = ShownFormula::new("0");
        let row = Row {
            name: "φ.x".to_owned(),
            position: true,
            phi: zero.clone(),
            phi_q: Vec::new(),
            phi_t: zero.clone(),
            gamma: zero,
        };
        assert_eq!(r"\Phi_{\mathrm{{\varphi}.x}}", row_equation(&row, Latex, WIDTH).left);
    }
}
