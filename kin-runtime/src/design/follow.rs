//! Follows a design along its motion: by the follower of the plan, or by a sweep where that is not possible.

use super::builder::Design;
use super::task::Task;
use crate::analysis::modes::Mode;
use crate::error::SolveError;
use crate::measure::Needs;
use crate::mechanism::Mechanism;
use crate::planned::Sign;
use crate::planned::follower::{Control, PlanFollower};
use crate::results::varied::{Varied, WIDTH};
use crate::sensitivity::measured::complete;
use crate::sensitivity::{MAX_STACK_COORDINATES, Variation, Varying, is_integrated, vary as vary_state};
use crate::signal::Instant;
use crate::solver::{AnySolver, Settings, Solver, swept};

/// Receives the index of an instant, the index of the first parameter with respect to which the numbers have
/// derivatives, and the numbers.
pub(crate) type See<'s> = dyn FnMut(usize, usize, &Varied) + 's;

/// What is fixed in one descent: the signs of modes, and the directions of paths.
#[derive(Clone, Debug)]
pub(crate) struct DescentBranch {
    pub(crate) modes: Vec<(usize, Sign)>,
    pub(crate) forward: bool,
}

/// The mechanisms of one type, which differ in their parameters: all that a search needs to know of the type.
pub(crate) trait Family: Sync {
    /// The modes to which the guesses lead at an instant; none where the mechanism does not assemble.
    fn guessed(&self, task: &Task, t: f64) -> Option<Vec<Mode>>;
    /// As [`DesignMotion::each`].
    fn each(
        &self,
        motion: &DesignMotion<'_>,
        times: &[f64],
        varying: &[usize],
        needs: Needs,
        see: &mut See<'_>,
    ) -> Result<(), SolveError>;
}

/// The motion of a mechanism whose parameters are set.
pub(crate) struct DesignMotion<'d> {
    family: &'d dyn Family,
    pub(crate) task: &'d Task,
    branch: &'d DescentBranch,
    pub(crate) parameters: Vec<f64>,
    /// Indices of the parameters that vary.
    indices: Vec<usize>,
    /// For every one of them the index of its variable, and its derivative with respect to that.
    pub(crate) moved_by: Vec<(usize, f64)>,
}

impl<'d> DesignMotion<'d> {
    pub(crate) fn new(family: &'d dyn Family, task: &'d Task, variables: &[f64], branch: &'d DescentBranch) -> Self {
        let free = task.free.iter().enumerate();
        let all = free.flat_map(|(k, free)| free.indices.iter().map(move |&index| (index, (k, free.width()))));
        let (indices, moved_by) = all.unzip();
        Self { family, task, branch, parameters: task.parameters_at(variables), indices, moved_by }
    }

    /// Follows the motion over these instants. Without slopes `see` receives only the first group of parameters.
    ///
    /// # Errors
    /// Why the mechanism does not move through all of them.
    pub(crate) fn each(&self, times: &[f64], slopes: bool, needs: Needs, see: &mut See<'_>) -> Result<(), SolveError> {
        let varying = if slopes { &self.indices } else { &self.indices[..self.indices.len().min(WIDTH)] };
        self.family.each(self, times, varying, needs, see)
    }
}

impl<M: Mechanism> Family for Design<M> {
    fn guessed(&self, task: &Task, t: f64) -> Option<Vec<Mode>> {
        let (mechanism, at) = (self.mechanism(&task.parameters), Instant::at(t));
        let solver = solver_from(&mechanism, &task.guesses, &[]);
        solver.modes(&at, &solver.assemble(&at).ok()?).ok()
    }

    fn each(
        &self,
        motion: &DesignMotion<'_>,
        times: &[f64],
        varying: &[usize],
        needs: Needs,
        see: &mut See<'_>,
    ) -> Result<(), SolveError> {
        let Some(&first) = times.first() else { return Ok(()) };
        let mechanism = self.mechanism(&motion.parameters);
        let solver = solver_from(&mechanism, &motion.task.guesses, &motion.branch.modes);
        let plan = &M::model().plan;
        let determined = !plan.has_redundant_rows() && !is_integrated(M::model());
        if determined && M::COORDINATES <= MAX_STACK_COORDINATES {
            match solver.follower(&Instant::at(first)) {
                Some(Ok(follower)) => return by_plan(&mechanism, follower, times, varying, needs, see),
                Some(Err(error)) => return Err(error.into()),
                None => {}
            }
        }
        by_sweep(&solver, &mut Varying::new(&mechanism), times, varying, needs, see)
    }
}

/// A solver that starts from these guesses in these modes.
fn solver_from<'m, M: Mechanism>(mechanism: &'m M, guesses: &[(usize, f64)], modes: &[(usize, Sign)]) -> Solver<'m, M> {
    Solver { mechanism, settings: Settings::default().starting_from(M::model(), guesses, modes) }
}

fn by_plan<M: Mechanism>(
    mechanism: &M,
    mut follower: PlanFollower<M>,
    times: &[f64],
    varying: &[usize],
    needs: Needs,
    see: &mut See<'_>,
) -> Result<(), SolveError> {
    let (mut variation, mut varied) = (Varying::new(mechanism), Varied::default());
    for (k, &t) in times.iter().enumerate() {
        let at = Instant::at(t);
        if k > 0 {
            follower.update(mechanism, &at, &Control::USUAL)?;
        }
        let state = follower.state();
        vary(
            &mut variation,
            &at,
            (k, state.q.as_ref(), follower.modes().of_closures()),
            varying,
            needs,
            &mut varied,
            see,
        )?;
    }
    Ok(())
}

/// Varies a state in its modes, one group of parameters after the other; `index` is that of its instant.
fn vary(
    variation: &mut dyn Variation,
    at: &Instant<'_>,
    (index, q, modes): (usize, &[f64], &[f64]),
    varying: &[usize],
    needs: Needs,
    varied: &mut Varied,
    see: &mut See<'_>,
) -> Result<(), SolveError> {
    for (group, parameters) in varying.chunks(WIDTH).enumerate() {
        variation.begin(at, parameters);
        variation.solve_from(modes, q, needs.depth, varied)?;
        complete(variation, varied, needs)?;
        see(index, group * WIDTH, varied);
    }
    Ok(())
}

fn by_sweep(
    solver: &dyn AnySolver,
    variation: &mut dyn Variation,
    times: &[f64],
    varying: &[usize],
    needs: Needs,
    see: &mut See<'_>,
) -> Result<(), SolveError> {
    let trajectory = swept(solver, times, None, None).map_err(|error| error.source)?;
    for (k, state) in trajectory.states.iter().enumerate() {
        let mut first = 0;
        vary_state(solver, variation, state, varying, &mut |variation, indices, varied| {
            complete(variation, varied, Needs { observed: false, ..needs })?;
            see(k, first, varied);
            first += indices.len();
            Ok(())
        })?;
    }
    Ok(())
}
