//! The solution plan: what an expert would do instead of "Newton on all coordinates".
//!
//! ```text
//! KinematicSystem → blocks (matching, strongly connected components) → reduction → tree → expressions → programs
//! ```
//!
//! Every block of rows is reduced by eliminations that are exact everywhere (see `reduce`) until what is left closes by
//! itself (a cos φ + b sin φ = c, a quadratic, a circle and a line, a linear system) or is a small system for Newton's
//! iteration. In the coordinates of joint-by-joint descriptions this finds the Assur groups: dyads close without
//! iteration, triads are left with two unknowns. Recognition works on the equations, not on the joints, so that a loop
//! in free equations, with carried or held coordinates, `distance` and `point_on_line` comes to the same.
//!
//! Where rows are more than coordinates, the plan goes by as many as determine them (see `choice`) and watches the rest: a
//! margin of each says whether what was solved satisfies it, too (see `watch`).
//!
//! Velocities and accelerations, and every other Φ_q x = b, go along the same tree (see `rates`).

mod angles;
mod build;
mod choice;
mod closures;
mod dense;
mod display;
mod expressions;
mod form;
mod formulas;
mod groups;
mod known;
mod margins;
mod matching;
mod probe;
mod rates;
mod recognise;
mod reduce;
mod rewrite;
mod sections;
mod step;
mod steps;
mod tree;
mod watch;

pub use formulas::{Formulas, Line};
pub(crate) use probe::Probe;
pub(crate) use rewrite::{Substitution, rewrite};
pub use sections::Section;
pub use step::{Mode, Step, StepId};
pub use watch::TOLERANCE;

use crate::expr::{ExprId, Graph};
use crate::program::{Program, Slot, lower};
use crate::system::KinematicSystem;
use crate::vocabulary::Depth;
use build::Build;
use choice::Chosen;
use std::ops::Range;
use steps::Listed;

/// How a mechanism is solved, block by block.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SolutionPlan {
    /// The steps in order.
    pub steps: Vec<Step>,
    /// The assembly modes.
    pub modes: Vec<Mode>,
    /// The groups that are solved by iteration: neighbouring solutions of each are told apart by the sign of the determinant
    /// of its own small system.
    pub orientations: Vec<Mode>,
    /// How many margins a solution has.
    pub margins: usize,
    /// Why there is no plan.
    pub absent: Option<String>,
    /// The programs in order, and how far each belongs.
    pub sections: Vec<(Section, Depth)>,
    /// How many values the sections hold for one another.
    pub held: u32,
    /// What tells the modes of a configuration: one entry per mode, then one per iteration, which tells its orientation.
    pub closures: Program,
    /// For x with Φ_q x = b at a configuration: what depends on Φ_q alone, `factors` values held; then x from these and b.
    pub resolve: [Program; 2],
    /// How many values the first leaves: those that the second reads, then `regular`.
    pub factors: usize,
    /// Among them what is 0 where Φ_q x = b says nothing of x.
    pub regular: Range<usize>,
    /// The steps as formulas, where they were asked for.
    pub formulas: Vec<Formulas>,
}

/// The linear level of a plan as expressions.
#[derive(Clone, Debug)]
pub struct Linear {
    /// Their graph, which begins with that of the system.
    pub graph: Graph,
    /// x of Φ_q x = b, where b are the symbols [`Right`](crate::expr::Symbol::Right).
    pub solution: Vec<ExprId>,
}

/// The plan of a mechanism whose rows determine its coordinates; for others, why there is none.
pub fn plan(system: &KinematicSystem) -> SolutionPlan {
    plan_of_rank(system, system.set.coordinates.len())
}

/// [`plan`] where the generic rank of Φ_q is known: rows of less rank than coordinates say something twice and leave
/// something open at every configuration, however many there are.
pub fn plan_of_rank(system: &KinematicSystem, rank: usize) -> SolutionPlan {
    plan_and_linear(system, rank, false).0
}

/// [`plan_of_rank`] with its [`formulas`](SolutionPlan::formulas).
pub fn plan_with_formulas(system: &KinematicSystem, rank: usize) -> SolutionPlan {
    plan_and_linear(system, rank, true).0
}

/// [`plan_of_rank`] with its linear level, and where they are wanted its [`formulas`](SolutionPlan::formulas).
pub fn plan_and_linear(system: &KinematicSystem, rank: usize, formulas: bool) -> (SolutionPlan, Option<Linear>) {
    match planned(system, rank, formulas) {
        Ok((plan, linear)) => (plan, Some(linear)),
        Err(why) => (SolutionPlan { absent: Some(why), ..SolutionPlan::default() }, None),
    }
}

fn planned(system: &KinematicSystem, rank: usize, written: bool) -> Result<(SolutionPlan, Linear), String> {
    let set = &system.set;
    let (n, s) = (set.coordinates.len(), set.rows.len());
    if system.classes.iter().any(|class| !class.holonomic) {
        return Err("rows of velocity level leave the position to the motion".to_owned());
    }
    if s < n {
        return Err(format!("{s} rows leave {} of {n} coordinates undetermined", n - s));
    }
    if rank < n {
        return Err(format!("{s} rows of rank {rank} leave {} of {n} coordinates undetermined", n - rank));
    }
    let mut graph = set.graph.clone();
    let chosen = choice::choose(system, &mut graph);
    let Chosen { tree, made_of, left_out, agreeing, .. } =
        chosen.ok_or_else(|| "the rows do not determine all coordinates".to_owned())?;
    let listed = Listed::new(system, &graph, &tree, &made_of);
    let before = written.then(|| graph.clone());
    let mut build = Build::new(system, graph, listed);
    let [velocity, acceleration] = build.all(&tree, &left_out, &agreeing);
    let (resolve, regular, orientations) = build.resolve(&tree);
    let solution = resolve.iter().map(|(_, x)| *x).collect();
    let (resolve, factors) = sections::split(&mut build.graph, resolve, &regular);
    let regular = factors - regular.len()..factors;
    let Build { mut graph, stages, listed, iterations, closures, iterated, .. } = build;
    let indicators: Vec<_> =
        closures.into_iter().chain(orientations).enumerate().map(|(k, id)| (Slot::Entry(k), id)).collect();
    let closures = lower(&graph, &indicators);
    let (sections, held) = sections::sections(&mut graph, stages, iterations);
    let depth = |place| match place {
        place if place >= acceleration => Depth::Acceleration,
        place if place >= velocity => Depth::Velocity,
        _ => Depth::Position,
    };
    let sections = sections.into_iter().enumerate().map(|(place, section)| (section, depth(place))).collect();
    let formulas = before.map_or_else(Vec::new, |graph| formulas::formulas(system, graph, &listed, &tree));
    let orientations = iterated.into_iter().map(|(_, step, margin)| listed.iteration(system, step, margin)).collect();
    let Listed { steps, modes, margins, .. } = listed;
    let plan = SolutionPlan {
        steps,
        modes,
        orientations,
        margins,
        absent: None,
        sections,
        held,
        closures,
        resolve,
        factors,
        regular,
        formulas,
    };
    Ok((plan, Linear { graph, solution }))
}
