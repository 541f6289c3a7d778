//! The program that evaluates rows, and the order of its outputs.

use crate::constraint::Family;
use crate::expr::{ExprId, Graph};
use crate::program::{Program, Slot, lower};
use crate::system::Equation;

/// The sparsity pattern of a Jacobian.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pattern {
    /// The number of rows.
    pub rows: usize,
    /// (row, column) of every entry, row by row.
    pub entries: Vec<(usize, usize)>,
    /// (index of the entry, value) of the entries that are literal constants.
    pub constants: Vec<(usize, f64)>,
}

/// The program of Φ, Φ_q, Φ_t and γ, with the pattern of Φ_q.
pub(super) struct RowProgram {
    pub(super) pattern: Pattern,
    /// The program for everything except literal constants. [`Program::only`] extracts parts with bitwise equal
    /// results.
    pub(super) program: Program,
}

impl RowProgram {
    /// Makes the program of the equations. Literal entries of Φ_q and literal zeros of Φ_t and γ are not written.
    pub(super) fn new(graph: &Graph, equations: &[Equation], families: &[Family]) -> Self {
        let (mut entries, mut constants) = (Vec::new(), Vec::new());
        let mut outputs: Vec<(Slot, ExprId)> = Vec::new();
        for (row, equation) in equations.iter().enumerate() {
            outputs.push((Slot::Phi(row), equation.phi));
            for (column, e) in &equation.phi_q {
                let index = entries.len();
                entries.push((row, *column as usize));
                match graph.literal(*e) {
                    Some(value) => constants.push((index, value)),
                    None => outputs.push((Slot::PhiQ(index), *e)),
                }
            }
            for (slot, e) in [(Slot::PhiT(row), equation.phi_t), (Slot::Gamma(row), equation.gamma)] {
                if !graph.is_zero(e) {
                    outputs.push((slot, e));
                }
            }
        }
        let row_of = |slot| match slot {
            Slot::PhiQ(index) => entries[index].0,
            slot => slot.index(),
        };
        let program = member_by_member(graph, &outputs, families, row_of);
        Self { pattern: Pattern { rows: equations.len(), entries, constants }, program }
    }
}

/// Lowers the rows of the first member of every family, then those of the second members, and so on. Values that the
/// rows of a member share are then close together, and all rows of the members become one loop. The outputs of the
/// program keep their original order.
fn member_by_member(
    graph: &Graph,
    outputs: &[(Slot, ExprId)],
    families: &[Family],
    row_of: impl Fn(Slot) -> usize,
) -> Program {
    let begin = families.iter().map(|family| family.first).min().unwrap_or_default();
    let longest = families.iter().map(|family| family.members).max().unwrap_or_default();
    let member = |index: &usize| {
        let row = row_of(outputs[*index].0);
        let contains_row =
            |family: &&Family| (family.first..family.first + family.members * family.stride).contains(&row);
        match families.iter().find(contains_row) {
            // A family of joints between neighbouring members has one member fewer; its first member is lowered with
            // the second members.
            Some(family) => longest - family.members + (row - family.first) / family.stride,
            // Rows that are declared after the families remain after them.
            None if row < begin => 0,
            None => usize::MAX,
        }
    };
    let mut order: Vec<usize> = (0..outputs.len()).collect();
    order.sort_by_key(member);
    let mut program = lower(graph, &order.iter().map(|index| outputs[*index]).collect::<Vec<_>>());
    let mut written = program.outputs.clone();
    order.iter().zip(&program.outputs).for_each(|(index, output)| written[*index] = *output);
    program.outputs = written;
    program
}
