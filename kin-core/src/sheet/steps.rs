//! The steps of the solution plan on a sheet.

use super::lines;
use super::shown::{ShownFormula, symbol};
use crate::notation::{FormulaTree, Name, Notation};
use crate::plan;

/// A step: the formulas for its coordinates, their rates and their accelerations; each uses results of earlier formulas
/// only.
#[derive(Clone, Debug)]
pub struct SheetStep {
    /// Its number in the plan, from 1.
    pub number: usize,
    /// A description in words.
    pub what: String,
    /// Lines for q, q̇ and q̈.
    pub lines: [Vec<StepLine>; 3],
}

/// A line of a step.
#[derive(Clone, Debug)]
pub enum StepLine {
    /// A name and its value, or a residual that an iteration brings to 0.
    Equation {
        /// The name.
        left: String,
        /// The value.
        right: ShownFormula,
        /// True for a residual.
        zero: bool,
    },
    /// matrix · unknowns = right.
    System {
        /// Row by row.
        matrix: Vec<Vec<ShownFormula>>,
        /// Names.
        unknowns: Vec<String>,
        /// The right-hand side of every row.
        right: Vec<ShownFormula>,
    },
}

/// The headings of the three groups of lines.
pub(super) const ORDERS: [&str; 3] = ["Position", "Velocity", "Acceleration"];

impl SheetStep {
    /// The steps of a plan that was made with its formulas.
    pub(super) fn of_plan(plan: &plan::SolutionPlan) -> Vec<Self> {
        let line = |line: &plan::Line| match line {
            plan::Line::Equation { left, right } => StepLine::equation(left, right, false),
            plan::Line::Zero { left, right } => StepLine::equation(left, right, true),
            plan::Line::System { matrix, unknowns, right } => StepLine::System {
                matrix: matrix.iter().map(|row| row.iter().map(|entry| ShownFormula::new(entry)).collect()).collect(),
                unknowns: unknowns.clone(),
                right: right.iter().map(|entry| ShownFormula::new(entry)).collect(),
            },
        };
        let step = |formulas: &plan::Formulas| Self {
            number: formulas.step.number(),
            what: formulas.what.clone(),
            lines: [0, 1, 2].map(|order| formulas.lines[order].iter().map(line).collect()),
        };
        plan.formulas.iter().map(step).collect()
    }
}

impl StepLine {
    /// A name and its value.
    pub fn equation(left: &str, right: &str, zero: bool) -> Self {
        Self::Equation { left: left.to_owned(), right: ShownFormula::new(right), zero }
    }

    /// The line as equations. A system is written with matrices if these fit into `width`, otherwise row by row; as
    /// plain text always row by row.
    pub(super) fn write(&self, notation: Notation, width: usize) -> Vec<lines::EquationLine> {
        match self {
            Self::Equation { left, right, zero } => {
                let mut right = right.lines(notation, width);
                if let (Some(last), true) = (right.last_mut(), zero) {
                    last.push_str(lines::zero(notation));
                }
                vec![lines::EquationLine { left: symbol(left, notation), right }]
            }
            Self::System { matrix, unknowns, right } => {
                let columns = |shown: &ShownFormula| shown.write(Notation::Unicode).chars().count();
                let widest = |shown: &mut dyn Iterator<Item = &ShownFormula>| shown.map(columns).max().unwrap_or(0);
                let entries = (0..unknowns.len()).map(|k| widest(&mut matrix.iter().filter_map(|row| row.get(k))) + 2);
                let total = entries.sum::<usize>() + widest(&mut right.iter()) + 12;
                if notation != Notation::Unicode && total <= width && matrix.len() > 1 {
                    return vec![matrices(matrix, unknowns, right, notation)];
                }
                let rows = matrix.iter().zip(right);
                rows.map(|(row, right)| lines::EquationLine {
                    left: product(row, unknowns).write(notation),
                    right: right.lines(notation, width),
                })
                .collect()
            }
        }
    }
}

/// The product row · unknowns as a formula.
fn product(row: &[ShownFormula], unknowns: &[String]) -> ShownFormula {
    let term = |(entry, name): (&ShownFormula, &String)| {
        let entry = match entry {
            ShownFormula::Formula(entry) if entry.is_zero() => return None,
            ShownFormula::Formula(entry) => entry.clone(),
            ShownFormula::Text(text) => FormulaTree::Name(Name::new(&format!("`({text})`"))),
        };
        Some((false, FormulaTree::Product(vec![entry, FormulaTree::Name(Name::new(name))])))
    };
    let terms: Vec<(bool, FormulaTree)> = row.iter().zip(unknowns).filter_map(term).collect();
    ShownFormula::Formula(if terms.is_empty() { FormulaTree::Number(0.0) } else { FormulaTree::Sum(terms).tidied() })
}

fn matrices(
    matrix: &[Vec<ShownFormula>],
    unknowns: &[String],
    right: &[ShownFormula],
    notation: Notation,
) -> lines::EquationLine {
    let column = |entries: Vec<String>| entries.into_iter().map(|entry| vec![entry]).collect::<Vec<_>>();
    let whole = matrix.iter().map(|row| row.iter().map(|entry| entry.write(notation)).collect()).collect();
    let unknowns = column(unknowns.iter().map(|name| symbol(name, notation)).collect());
    let right = column(right.iter().map(|entry| entry.write(notation)).collect());
    let left = format!("{}{}", bracketed(whole, notation), bracketed(unknowns, notation));
    lines::EquationLine { left, right: vec![bracketed(right, notation)] }
}

/// A matrix in round brackets, in LaTeX and MathML.
pub(super) fn bracketed(rows: Vec<Vec<String>>, notation: Notation) -> String {
    match notation {
        Notation::MathMl => {
            let cell = |entry: &String| format!("<mtd>{entry}</mtd>");
            let row = |row: &Vec<String>| format!("<mtr>{}</mtr>", row.iter().map(cell).collect::<String>());
            let rows: String = rows.iter().map(row).collect();
            format!("<mrow><mo>(</mo><mtable>{rows}</mtable><mo>)</mo></mrow>")
        }
        _ => {
            let rows: Vec<String> = rows.into_iter().map(|row| row.join(" & ")).collect();
            format!(r"\begin{{pmatrix}} {} \end{{pmatrix}}", rows.join(r" \\ "))
        }
    }
}
