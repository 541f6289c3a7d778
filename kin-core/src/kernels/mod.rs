//! All programs of a mechanism in their final form; generated code consists of these kernels and of static tables.
//!
//! No optimisation of programs follows this stage. A new list of numbers is added as an entry of `list::lists`: its
//! method, the quantities that it is evaluated from, and its expressions.

mod kernel;
mod list;
mod rows;
mod solution;

pub use kernel::Kernel;
pub use list::{Given, List};
pub use rows::Pattern;
pub use solution::{Iteration, SolutionKernels, SolutionPart};

use crate::expr::{ExprId, Node};
use crate::loads::Forces;
use crate::plan::SolutionPlan;
use crate::program::{Program, Slot};
use crate::system::KinematicSystem;
use crate::vocabulary::OperationCount;
use rows::RowProgram;

/// The kernels of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernels {
    /// The sparsity pattern of Φ_q.
    pub constraint_pattern: Pattern,
    /// The sparsity pattern of the Jacobian of all observables.
    pub observable_pattern: Pattern,
    /// The operation count of one evaluation of Φ, Φ_q, Φ_t and γ together.
    pub operations: OperationCount,
    /// Evaluates Φ.
    pub values: Kernel,
    /// Evaluates Φ and Φ_q.
    pub values_and_jacobian: Kernel,
    /// Evaluates Φ_q and Φ_t.
    pub jacobian_and_rates: Kernel,
    /// Evaluates Φ, Φ_q, Φ_t and γ.
    pub everything: Kernel,
    /// Evaluates the same four quantities of the observables.
    pub observe: Kernel,
    /// The lists of numbers, each with a method of its own.
    pub lists: Vec<List>,
    /// The supplied function that belongs to each entry of the list `arguments`.
    pub arguments: Vec<usize>,
    /// Curves of joints: the index of the joint, and the kernel for a point of the curve and its direction.
    pub curves: Vec<(usize, Kernel)>,
    /// The operation count of one evaluation of the forces, if there are any.
    pub force_operations: Option<OperationCount>,
    /// The kernels of the solution plan, if there is one.
    pub solution: Option<SolutionKernels>,
}

impl Kernels {
    /// Whether there is a list of the angles by which the gradients of iterated rows turn (see
    /// [`SolutionPlan::turns`]).
    pub fn turns_rows(&self) -> bool {
        self.lists.iter().any(|list| list.method == solution::TURNS)
    }
}

/// Makes the kernels of a mechanism.
pub fn kernels(system: &KinematicSystem, plan: &SolutionPlan, forces: Option<&Forces>) -> Kernels {
    let set = &system.set;
    let constraints = RowProgram::new(&set.graph, &system.equations, &set.row_families);
    let observables = RowProgram::new(&set.graph, &system.observables, &[]);
    let part =
        |name: &str, keep: fn(Slot) -> bool| evaluation(name, &constraints.program.only(keep), &constraints.pattern);
    let everything = constraints.program.only(|_| true);
    let (functions, arguments): (Vec<usize>, Vec<ExprId>) = arguments(system).into_iter().unzip();
    let mut lists = list::lists(set, &arguments);
    lists.extend(solution::branch_values(plan));
    lists.extend(solution::turns(plan));
    lists.extend(solution::closeness(plan));
    lists.extend(solution::known_curves(plan));
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

/// The kernel of a program for rows, which writes to four arrays.
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
    let other_expressions = set.geometry.iter().copied().chain(set.guesses.iter().map(|(_, value)| *value));
    let mut all = Vec::new();
    for id in graph.reachable(differentiated.chain(other_expressions)) {
        if let Node::Supplied(function, _, argument) = graph.node(id)
            && !all.contains(&(function as usize, argument))
        {
            all.push((function as usize, argument));
        }
    }
    all
}
