//! Lists of numbers that a mechanism evaluates, each by a method of its own.

use super::kernel::Kernel;
use crate::constraint::{ConstraintRow, ConstraintSet};
use crate::expr::{ExprId, Graph};
use crate::loads::Forces;
use crate::program::{Program, Slot, lower};

/// The quantities that a list is evaluated from; each variant includes all earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Given {
    /// The parameters.
    Parameters,
    /// t and the inputs.
    Instant,
    /// The positions q.
    Position,
    /// The velocities q̇.
    Velocity,
    /// The accelerations q̈.
    Acceleration,
    /// The multipliers λ.
    Multipliers,
}

/// A list of numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct List {
    /// The method that writes the list.
    pub method: &'static str,
    /// The name of the list among the arguments of the method.
    pub name: &'static str,
    /// The quantities that the list is evaluated from.
    pub given: Given,
    /// The number of entries.
    pub length: usize,
    /// The program of the list.
    pub kernel: Kernel,
    /// If `kernel` itself solves for the multipliers λ, a second program of the list, which reads λ.
    pub of_multipliers: Option<Kernel>,
}

impl List {
    /// The list that a program writes.
    pub(super) fn of(method: &'static str, name: &'static str, given: Given, program: &Program) -> Self {
        let length = program.outputs.len();
        Self { method, name, given, length, kernel: written(program), of_multipliers: None }
    }
}

fn written(program: &Program) -> Kernel {
    Kernel::new("write", program, &[(Slot::Entry(0), program.outputs.len())])
}

/// The program that writes a sequence of expressions.
pub(super) fn listed(graph: &Graph, values: impl IntoIterator<Item = ExprId>) -> Program {
    let outputs = values.into_iter().enumerate().map(|(index, value)| (Slot::Entry(index), value));
    lower(graph, &outputs.collect::<Vec<_>>())
}

/// The non-empty lists of a mechanism; `arguments` are the arguments of supplied functions.
pub(super) fn lists(set: &ConstraintSet, arguments: &[ExprId]) -> Vec<List> {
    // A row of velocity level has the literal 0 in Φ; this literal stands for η of all other rows.
    let zero = set.rows.iter().find(|row| row.velocity.is_some()).map(|row| row.phi);
    let eta = |row: &ConstraintRow| Some(row.velocity.map_or(zero?, |velocity| velocity.eta));
    let lists: [(&str, &str, Given, Vec<ExprId>); 5] = [
        ("write_geometry", "geometry", Given::Instant, set.geometry.clone()),
        ("lengths_with", "lengths", Given::Instant, set.kept_lengths().collect()),
        ("write_guesses", "guesses", Given::Parameters, set.guesses.iter().map(|(_, value)| *value).collect()),
        ("write_arguments", "arguments", Given::Position, arguments.to_vec()),
        ("velocity_constraints_with", "eta", Given::Velocity, set.rows.iter().filter_map(eta).collect()),
    ];
    let list = |(method, name, given, values)| List::of(method, name, given, &listed(&set.graph, values));
    lists.into_iter().filter(|(.., values)| !values.is_empty()).map(list).collect()
}

/// The non-empty lists of forces: r = Q − M q̈, from which λ is solved numerically; the results, with λ solved along
/// the plan or given; and the forces and couples that loads exert.
pub(super) fn of_forces(forces: &Forces) -> Vec<List> {
    let mut results = List::of("forces_with", "forces", Given::Multipliers, &forces.results);
    results.of_multipliers = forces.of_multipliers.as_ref().map(written);
    let generalized = List::of("generalized_forces_with", "generalized", Given::Acceleration, &forces.generalized);
    let loads = List::of("loads_with", "loads", Given::Velocity, &forces.exerted);
    [generalized, results, loads].into_iter().filter(|list| list.length > 0).collect()
}
