//! The solution plan: how to solve the constraint equations block by block instead of by Newton's iteration on all
//! coordinates at once.
//!
//! ```text
//! KinematicSystem → blocks (matching, strongly connected components) → reduction → tree → expressions → programs
//! ```
//!
//! The rows of a block are reduced by eliminations that are exact in every configuration (see `reduce`). What remains
//! is either solvable in closed form (a cos φ + b sin φ = c, a quadratic, a circle and a line, a linear system) or a
//! small system for Newton's iteration. For mechanisms described joint by joint the blocks are the Assur groups: dyads
//! are solved without iteration, triads with two unknowns. Recognition works on the equations, not on the kinds of
//! joints, so it also applies to loops written as free equations of the user, to carried or held coordinates, and to
//! `distance` and `point_on_line`.
//!
//! If there are more rows than coordinates, the plan uses a subset of rows that determines all coordinates (see
//! `choice`) and checks the redundant rows: each has a margin that says whether the solution satisfies it (see
//! `redundant_rows`).
//!
//! Velocities, accelerations and any other solution of Φ_q x = b follow the same tree (see `rates`); this is the
//! *linear level* of the plan.

mod angles;
mod choice;
mod closures;
mod curves;
mod dense;
mod display;
mod distances;
mod expressions;
mod formulas;
mod groups;
mod guides;
mod known;
mod margins;
mod matching;
mod minors;
mod pivot;
mod rates;
mod recognise;
mod reduce;
mod redundant_rows;
mod rewrite;
mod scales;
mod sections;
mod single_unknown;
mod sizes;
mod state;
mod step;
mod steps;
mod term_sum;
mod tree;
mod turns;
mod zero;

pub use curves::KnownCurves;
pub use formulas::{Formulas, Line};
pub use redundant_rows::TOLERANCE;
pub(crate) use rewrite::{Substitution, rewrite};
pub use sections::Section;
pub use step::{Mode, Step, StepId};
pub(crate) use zero::ZeroTest;

use crate::expr::{ExprId, Graph};
use crate::program::{Program, Slot, lower};
use crate::system::KinematicSystem;
use crate::vocabulary::Depth;
use choice::Chosen;
use expressions::LinearSolution;
use state::Build;
use std::ops::Range;
use steps::StepList;

/// How a mechanism is solved, block by block.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SolutionPlan {
    /// The steps in order.
    pub steps: Vec<Step>,
    /// The assembly modes.
    pub modes: Vec<Mode>,
    /// The groups whose determinant has a sign that distinguishes branches: first those that are solved by iteration,
    /// in which two solutions differ in the sign of the Jacobian determinant where they nearly coincide; then linear
    /// systems that are singular for some configurations, where the solution goes to infinity.
    pub orientations: Vec<Mode>,
    /// Number of margins of a solution.
    pub margins: usize,
    /// Why there is no plan, if there is none.
    pub absent: Option<String>,
    /// The programs in order of execution, each with the level (position, velocity, acceleration) it belongs to.
    pub sections: Vec<(Section, Depth)>,
    /// Number of values that sections store for later sections.
    pub saved: u32,
    /// The branch values of a configuration: one entry per mode, whose sign is the mode, then one per orientation, of
    /// the same sign.
    pub branch_values: Program,
    /// For each of the n coordinates, the angle by which the gradients of rows turn per unit of the coordinate, where
    /// these are iterated or solved for lengths or scalars; empty if all are 0.
    pub turns: Program,
    /// Whether the branch values of groups in closed form must be looked at within steps, too: the gradients of rows that
    /// are solved for lengths or scalars turn with time or with an input, or they turn with a coordinate and the plan also
    /// iterates.
    pub looks_within: bool,
    /// For every row the sum of 1/d² over the distances d of points in it; empty if no row contains any.
    pub closeness: Program,
    /// Whether rows with curves are iterated on.
    pub iterates_on_curves: bool,
    /// Functions whose course between two configurations these do not show. They are known without a plan, too.
    pub known_curves: KnownCurves,
    /// Two programs that solve Φ_q x = b at a configuration: the first computes the `factors` values that depend on
    /// Φ_q alone, the second computes x from these values and b.
    pub resolve: [Program; 2],
    /// Number of values that the first program of `resolve` stores: those that the second reads, followed by
    /// `regular`.
    pub factors: usize,
    /// The range of the values that show where Φ_q is singular: where one of them is 0, Φ_q x = b does not determine x.
    pub regular: Range<usize>,
    /// The steps as formulas, if they were requested.
    pub formulas: Vec<Formulas>,
}

/// The linear level of a plan as expressions.
#[derive(Clone, Debug)]
pub struct Linear {
    /// The graph of the expressions; it begins with the nodes of the system's graph.
    pub graph: Graph,
    /// x of Φ_q x = b, where the entries of b are the symbols [`Right`](crate::expr::Symbol::Right).
    pub solution: Vec<ExprId>,
}

/// The plan of a mechanism whose rows determine its coordinates; for any other mechanism, the reason why there is no
/// plan.
pub fn plan(system: &KinematicSystem) -> SolutionPlan {
    plan_of_rank(system, system.set.coordinates.len())
}

/// [`plan`] for a known generic rank of Φ_q. If the rank is less than the number of coordinates, there is no plan,
/// however many rows there are: some rows are redundant and some coordinates undetermined.
pub fn plan_of_rank(system: &KinematicSystem, rank: usize) -> SolutionPlan {
    plan_and_linear(system, rank, false).0
}

/// [`plan_of_rank`] with its [`formulas`](SolutionPlan::formulas).
pub fn plan_with_formulas(system: &KinematicSystem, rank: usize) -> SolutionPlan {
    plan_and_linear(system, rank, true).0
}

/// [`plan_of_rank`] with the expressions of the linear level and, if `formulas` is set, with its
/// [`formulas`](SolutionPlan::formulas).
pub fn plan_and_linear(system: &KinematicSystem, rank: usize, formulas: bool) -> (SolutionPlan, Option<Linear>) {
    match planned(system, rank, formulas) {
        Ok((plan, linear)) => (plan, Some(linear)),
        Err(why) => {
            let mut graph = system.set.graph.clone();
            let known_curves = curves::known_curves(&mut graph, &system.set.rows, None);
            (SolutionPlan { absent: Some(why), known_curves, ..SolutionPlan::default() }, None)
        }
    }
}

fn planned(system: &KinematicSystem, rank: usize, written: bool) -> Result<(SolutionPlan, Linear), String> {
    let set = &system.set;
    let (n, s) = (set.coordinates.len(), set.rows.len());
    if system.classes.iter().any(|class| !class.holonomic) {
        return Err("nonholonomic rows (of velocity level) do not determine the position".to_owned());
    }
    if s < n {
        return Err(format!("{s} rows leave {} of {n} coordinates undetermined", n - s));
    }
    if rank < n {
        return Err(format!("{s} rows of rank {rank} leave {} of {n} coordinates undetermined", n - rank));
    }
    let mut graph = set.graph.clone();
    let chosen = choice::choose(system, &mut graph);
    let Chosen { tree, source_rows, left_out, paired, .. } =
        chosen.ok_or_else(|| "the rows do not determine all coordinates".to_owned())?;
    let listed = StepList::new(system, &graph, &tree, &source_rows);
    let before = written.then(|| graph.clone());
    let mut build = Build::new(system, graph, listed);
    let linear = build.linear_solution(&tree);
    let first = build.write_levels(&tree, (&left_out, &paired), &linear);
    let zero = build.graph.zero();
    let orientation = |(row, ..): &(usize, StepId, usize)| linear.orientations.get(row).copied().unwrap_or(zero);
    let orientations: Vec<ExprId> = build.iterated.iter().map(orientation).collect();
    let LinearSolution { solution: linear, regular, .. } = linear;
    let solution = linear.iter().map(|(_, x)| *x).collect();
    let (resolve, factors) = sections::split(&mut build.graph, linear, &regular);
    let regular = factors - regular.len()..factors;
    let Build { mut graph, stages, listed, iterations, branch_values, iterated, signed, .. } = build;
    let values = branch_values.into_iter().chain(orientations).chain(signed.iter().map(|signed| signed.value));
    let outputs: Vec<_> = values.enumerate().map(|(k, id)| (Slot::Entry(k), id)).collect();
    let branch_values = lower(&graph, &outputs);
    let iterates_on_curves = curves::iterates_on_curves(&graph, &tree);
    let known_curves = curves::known_curves(&mut graph, &set.rows, Some((&tree, &source_rows)));
    let turns::GradientTurns { by_coordinates, looks_within, closeness } = turns::turns(&mut graph, &tree, set);
    let [turns, closeness] = [by_coordinates, closeness].map(|list| {
        let outputs: Vec<_> = list.into_iter().enumerate().map(|(k, id)| (Slot::Entry(k), id)).collect();
        lower(&graph, &outputs)
    });
    let (sections, saved) = sections::sections(&mut graph, stages, iterations);
    let depth = |index| match index {
        index if index >= first.acceleration => Depth::Acceleration,
        index if index >= first.velocity => Depth::Velocity,
        _ => Depth::Position,
    };
    let sections = sections.into_iter().enumerate().map(|(index, section)| (section, depth(index))).collect();
    let formulas = before.map_or_else(Vec::new, |graph| formulas::formulas(system, graph, &listed, &tree));
    let poles: Vec<StepId> = signed.iter().map(|signed| signed.step).collect();
    let oriented = iterated.into_iter().map(|(_, step, margin)| (step, margin));
    let oriented = oriented.chain(signed.into_iter().map(|signed| (signed.step, signed.margin)));
    let orientations = oriented.map(|(step, margin)| listed.oriented(system, step, margin)).collect();
    let StepList { mut steps, modes, margins, .. } = listed;
    poles.into_iter().for_each(|step| groups::name_zero_divisor(set, &mut steps[step.index()]));
    let plan = SolutionPlan {
        steps,
        modes,
        orientations,
        margins,
        absent: None,
        sections,
        saved,
        branch_values,
        turns,
        looks_within,
        closeness,
        iterates_on_curves,
        known_curves,
        resolve,
        factors,
        regular,
        formulas,
    };
    Ok((plan, Linear { graph, solution }))
}
