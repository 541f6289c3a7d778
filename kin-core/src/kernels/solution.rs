//! The kernels of a solution plan.

use super::kernel::Kernel;
use super::list::{Given, List};
use crate::plan::{Section, SolutionPlan};
use crate::program::Slot;
use crate::system::KinematicSystem;
use crate::vocabulary::{Depth, UnknownKind};

/// Maximum number of instructions of a plan that is inlined into one function (a dyad has about two hundred). Within
/// one function, the values that a part saves for later parts stay in registers.
const MAX_INLINED_INSTRUCTIONS: usize = 1000;

/// The kernels of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SolutionKernels {
    /// The parts of a solution in order of execution.
    pub parts: Vec<SolutionPart>,
    /// The number of values that parts save for later parts.
    pub saved: usize,
    /// Computes the factors: everything in the solution of Φ_q x = b that depends on Φ_q alone.
    pub factorise: Kernel,
    /// Computes x from the factors and b.
    pub solve: Kernel,
}

/// A part of a solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SolutionPart {
    /// The level (position, velocity, acceleration) that the part belongs to.
    pub depth: Depth,
    /// The program; for an iteration, that of the corrections subtracted from the unknowns.
    pub kernel: Kernel,
    /// The iteration, if the part is one.
    pub iteration: Option<Iteration>,
}

/// A Newton iteration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Iteration {
    /// The unknowns, as indices of q.
    pub unknowns: Vec<usize>,
    /// The kind of each unknown.
    pub kinds: Vec<UnknownKind>,
    /// The index of the saved value that shows whether the iteration has converged.
    pub converged: usize,
}

/// The kernels of a plan; `None` if there is no plan.
pub(super) fn of_plan(system: &KinematicSystem, plan: &SolutionPlan) -> Option<SolutionKernels> {
    if plan.absent.is_some() {
        return None;
    }
    let coordinates = &system.set.coordinates;
    let (n, saved) = (coordinates.len(), plan.saved as usize);
    let arrays = [
        (Slot::Position(0), n),
        (Slot::Velocity(0), n),
        (Slot::Acceleration(0), n),
        (Slot::Margin(0), plan.margins),
        (Slot::Saved(0), saved),
    ];
    let instructions: usize = plan.sections.iter().map(|(section, _)| section.program().instructions.len()).sum();
    let part = |(number, (section, depth)): (usize, &(Section, Depth))| {
        let name = format!("solve_part_{number}");
        let (kernel, iteration) = match section {
            Section::Closed(program) => (Kernel::new(name, program, &arrays), None),
            Section::Newton { unknowns, correction, converged } => {
                let unknowns: Vec<usize> = unknowns.iter().map(|k| *k as usize).collect();
                let kinds = unknowns.iter().map(|&k| coordinates[k].unknown_kind()).collect();
                let kernel = Kernel::new(name, correction, &[(Slot::Entry(0), unknowns.len())]);
                (kernel, Some(Iteration { unknowns, kinds, converged: *converged as usize }))
            }
        };
        SolutionPart {
            depth: *depth,
            kernel: Kernel { inlined: instructions <= MAX_INLINED_INSTRUCTIONS, saved, ..kernel },
            iteration,
        }
    };
    let [factorise, solve] = &plan.resolve;
    Some(SolutionKernels {
        parts: plan.sections.iter().enumerate().map(part).collect(),
        saved,
        factorise: Kernel::new("factorise_rows", factorise, &[(Slot::Saved(0), plan.factors)]).with_saved(plan.factors),
        solve: Kernel::new("solve_rows", solve, &[(Slot::Entry(0), n)]).with_saved(plan.factors),
    })
}

/// The method of the list of [`turns`].
pub(super) const TURNS: &str = "turns_with";

/// The list of the angles by which the gradients of iterated rows turn per unit of each coordinate, unless all are 0.
pub(super) fn turns(plan: &SolutionPlan) -> Option<List> {
    (!plan.turns.outputs.is_empty()).then(|| List::of(TURNS, "turns", Given::Position, &plan.turns))
}

/// The list of the sums of 1/d² over the distances d in every row, unless there are none.
pub(super) fn closeness(plan: &SolutionPlan) -> Option<List> {
    let program = &plan.closeness;
    (!program.outputs.is_empty()).then(|| List::of("closeness_with", "closeness", Given::Position, program))
}

/// The list of known curves, unless there are none.
pub(super) fn known_curves(plan: &SolutionPlan) -> Option<List> {
    let program = &plan.known_curves.program;
    (!program.outputs.is_empty()).then(|| List::of("known_curves_with", "curves", Given::Position, program))
}

/// The list of branch values, which give the modes of a configuration and, if there are iterations, their orientations.
pub(super) fn branch_values(plan: &SolutionPlan) -> Option<List> {
    plan.absent.is_none().then(|| List::of("branches_with", "branches", Given::Position, &plan.branch_values))
}
