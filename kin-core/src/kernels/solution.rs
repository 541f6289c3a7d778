//! The programs of a solution plan.

use super::kernel::Kernel;
use super::list::{Given, List};
use crate::plan::{Section, SolutionPlan};
use crate::program::Slot;
use crate::system::KinematicSystem;
use crate::vocabulary::Depth;

/// Instructions of a plan whose parts become one function; a dyad has about two hundred. In one function, what one part
/// holds for another stays in registers.
const SHORT: usize = 1000;

/// The programs of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SolutionKernels {
    /// The parts of a solution, in their order.
    pub parts: Vec<Part>,
    /// How many values they hold for one another.
    pub held: usize,
    /// What depends on Φ_q alone in Φ_q x = b: the factors.
    pub factorise: Kernel,
    /// x from the factors and b.
    pub solve: Kernel,
}

/// A part of a solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// How far it belongs.
    pub depth: Depth,
    /// Its program; of an iteration what is subtracted from the unknowns.
    pub kernel: Kernel,
    /// What it iterates, where it does.
    pub iteration: Option<Iteration>,
}

/// Newton's iteration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Iteration {
    /// The unknowns, places in q.
    pub unknowns: Vec<usize>,
    /// Which of them are lengths.
    pub lengths: Vec<bool>,
    /// The place among the values held that says whether it has converged.
    pub converged: usize,
}

/// The programs of a plan; none where there is no plan.
pub(super) fn of_plan(system: &KinematicSystem, plan: &SolutionPlan) -> Option<SolutionKernels> {
    if plan.absent.is_some() {
        return None;
    }
    let coordinates = &system.set.coordinates;
    let (n, held) = (coordinates.len(), plan.held as usize);
    let arrays = [
        (Slot::Position(0), n),
        (Slot::Velocity(0), n),
        (Slot::Acceleration(0), n),
        (Slot::Margin(0), plan.margins),
        (Slot::Held(0), held),
    ];
    let instructions: usize = plan.sections.iter().map(|(section, _)| section.program().instructions.len()).sum();
    let part = |(number, (section, depth)): (usize, &(Section, Depth))| {
        let name = format!("solve_part_{number}");
        let (kernel, iteration) = match section {
            Section::Closed(program) => (Kernel::new(name, program, &arrays), None),
            Section::Newton { unknowns, correction, converged } => {
                let unknowns: Vec<usize> = unknowns.iter().map(|k| *k as usize).collect();
                let lengths = unknowns.iter().map(|&k| coordinates[k].kind.is_length()).collect();
                let kernel = Kernel::new(name, correction, &[(Slot::Entry(0), unknowns.len())]);
                (kernel, Some(Iteration { unknowns, lengths, converged: *converged as usize }))
            }
        };
        Part { depth: *depth, kernel: Kernel { inlined: instructions <= SHORT, held, ..kernel }, iteration }
    };
    let [factorise, solve] = &plan.resolve;
    Some(SolutionKernels {
        parts: plan.sections.iter().enumerate().map(part).collect(),
        held,
        factorise: Kernel::new("factorise_rows", factorise, &[(Slot::Held(0), plan.factors)]).holding(plan.factors),
        solve: Kernel::new("solve_rows", solve, &[(Slot::Entry(0), n)]).holding(plan.factors),
    })
}

/// What tells the modes of a configuration, and what tells all branches apart where there are iterations, too.
pub(super) fn closures(plan: &SolutionPlan) -> Option<List> {
    let (method, name) = match plan.orientations.is_empty() {
        true => ("closures_with", "closures"),
        false => ("branches_with", "branches"),
    };
    plan.absent.is_none().then(|| List::of(method, name, Given::Position, &plan.closures))
}
