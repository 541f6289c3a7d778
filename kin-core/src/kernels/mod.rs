//! Every program of a mechanism, finished: generated code is these kernels and static tables, and nothing else.
//!
//! All optimisation ends here. A list of numbers that a mechanism shall evaluate besides is one more entry of
//! `list::lists`: the method that writes it, what it is evaluated from, and its expressions.

mod kernel;
mod list;
mod rows;
mod solution;

pub use kernel::Kernel;
pub use list::{Given, List};
pub use rows::Pattern;
pub use solution::{Iteration, Part, SolutionKernels};

use crate::expr::{ExprId, Node};
use crate::loads::Forces;
use crate::plan::SolutionPlan;
use crate::program::{Program, Slot};
use crate::system::KinematicSystem;
use crate::vocabulary::OperationCount;
use rows::Rows;

/// The programs of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernels {
    /// The pattern of Φ_q.
    pub constraint_pattern: Pattern,
    /// The pattern of the Jacobian of all observables.
    pub observable_pattern: Pattern,
    /// The operations of one evaluation of Φ, Φ_q, Φ_t and γ together.
    pub operations: OperationCount,
    /// Φ alone.
    pub values: Kernel,
    /// Φ and Φ_q.
    pub values_and_jacobian: Kernel,
    /// Φ_q and Φ_t.
    pub jacobian_and_rates: Kernel,
    /// Φ, Φ_q, Φ_t and γ.
    pub everything: Kernel,
    /// The same four of the observables.
    pub observe: Kernel,
    /// Lists of numbers, each with a method of its own.
    pub lists: Vec<List>,
    /// The supplied function of every entry of the list `arguments`.
    pub arguments: Vec<usize>,
    /// A point and the direction of the curves of joints, by the place of the joint.
    pub curves: Vec<(usize, Kernel)>,
    /// The operations of one evaluation of forces, where there are any.
    pub force_operations: Option<OperationCount>,
    /// The solution plan, where there is one.
    pub solution: Option<SolutionKernels>,
}

/// Makes the programs of a mechanism.
pub fn kernels(system: &KinematicSystem, plan: &SolutionPlan, forces: Option<&Forces>) -> Kernels {
    let set = &system.set;
    let constraints = Rows::new(&set.graph, &system.equations, &set.row_families);
    let observables = Rows::new(&set.graph, &system.observables, &[]);
    let part =
        |name: &str, keep: fn(Slot) -> bool| evaluation(name, &constraints.program.only(keep), &constraints.pattern);
    let everything = constraints.program.only(|_| true);
    let (functions, arguments): (Vec<usize>, Vec<ExprId>) = arguments(system).into_iter().unzip();
    let mut lists = list::lists(set, &arguments);
    lists.extend(solution::closures(plan));
    lists.extend(forces.into_iter().flat_map(list::of_forces));
    Kernels {
        operations: everything.operations(),
        values: part("values", |slot| matches!(slot, Slot::Phi(_))),
        values_and_jacobian: part("values_and_jacobian", |slot| matches!(slot, Slot::Phi(_) | Slot::PhiQ(_))),
        jacobian_and_rates: part("jacobian_and_rates", |slot| matches!(slot, Slot::PhiQ(_) | Slot::PhiT(_))),
        everything: evaluation("everything", &everything, &constraints.pattern),
        observe: evaluation("observe", &observables.program.only(|_| true), &observables.pattern),
        constraint_pattern: constraints.pattern,
        observable_pattern: observables.pattern,
        lists,
        arguments: functions,
        curves: set
            .curves
            .iter()
            .map(|curve| {
                let program = list::listed(&set.graph, curve.point);
                (curve.joint, Kernel::new("write", &program, &[(Slot::Entry(0), curve.point.len())]))
            })
            .collect(),
        force_operations: forces.map(|forces| forces.results.operations()),
        solution: solution::of_plan(system, plan),
    }
}

/// The kernel of rows, which writes to four arrays.
fn evaluation(name: &str, program: &Program, pattern: &Pattern) -> Kernel {
    let (rows, entries) = (pattern.rows, pattern.entries.len());
    let arrays = [(Slot::Phi(0), rows), (Slot::PhiQ(0), entries), (Slot::PhiT(0), rows), (Slot::Gamma(0), rows)];
    Kernel::new(name, program, &arrays)
}

/// Every supplied function with an argument at which it is evaluated, each pair once.
fn arguments(system: &KinematicSystem) -> Vec<(usize, ExprId)> {
    let (set, graph) = (&system.set, &system.set.graph);
    let equations = system.equations.iter().chain(&system.observables);
    let differentiated = equations.flat_map(|equation| {
        let entries = equation.phi_q.iter().map(|(_, entry)| *entry);
        entries.chain([equation.phi, equation.phi_t, equation.gamma])
    });
    let others = set.geometry.iter().copied().chain(set.guesses.iter().map(|(_, value)| *value));
    let mut all = Vec::new();
    for id in graph.reachable(differentiated.chain(others)) {
        if let Node::Supplied(function, _, argument) = graph.node(id)
            && !all.contains(&(function as usize, argument))
        {
            all.push((function as usize, argument));
        }
    }
    all
}
