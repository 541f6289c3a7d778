//! Follows a design along its motion: by the follower of the plan, or by a sweep where that is not possible.

use super::builder::Design;
use crate::error::SolveError;
use crate::measure::Needs;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::planned::Sign;
use crate::planned::follower::{Control, PlanFollower};
use crate::results::varied::{Varied, WIDTH};
use crate::sensitivity::measured::complete;
use crate::sensitivity::{LARGEST, Variation, Varying, is_integrated};
use crate::solver::Solver;
use crate::workspace::Instant;

/// Receives the index of an instant, the index of the first parameter with respect to which the numbers have
/// derivatives, and the numbers.
type See<'s> = dyn FnMut(usize, usize, &Varied) + 's;

/// What is fixed in one descent: the signs of modes, and the directions of paths.
#[derive(Clone, Debug)]
pub(crate) struct Branch {
    pub(crate) modes: Vec<(usize, Sign)>,
    pub(crate) forward: bool,
}

/// A motion, without the type of its mechanism.
pub(crate) trait Motion {
    fn model(&self) -> &'static Model;
    /// For every parameter that varies the index of its variable, and its derivative with respect to that.
    fn moved_by(&self) -> &[(usize, f64)];
    /// Follows the motion over these instants. Without slopes `see` receives only the first group of parameters.
    ///
    /// # Errors
    /// Why the mechanism does not move through all of them.
    fn each(&self, times: &[f64], slopes: bool, needs: Needs, see: &mut See<'_>) -> Result<(), SolveError>;
}

/// A mechanism that is followed.
pub(crate) struct Follow<'d, M: Mechanism> {
    design: &'d Design<M>,
    mechanism: &'d M,
    branch: &'d Branch,
    /// Parameters that vary, indices in the mechanism.
    places: Vec<usize>,
    /// For every one of them the index of its variable, and its derivative with respect to that.
    moved_by: Vec<(usize, f64)>,
}

impl<M: Mechanism> Motion for Follow<'_, M> {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn moved_by(&self) -> &[(usize, f64)] {
        &self.moved_by
    }

    fn each(&self, times: &[f64], slopes: bool, needs: Needs, see: &mut See<'_>) -> Result<(), SolveError> {
        let Some(&first) = times.first() else { return Ok(()) };
        let plan = &M::model().plan;
        let determined = !plan.has_redundant_rows() && !is_integrated(M::model());
        if determined && M::COORDINATES <= LARGEST {
            match self.solver().follower(&Instant::at(first)) {
                Some(Ok(follower)) => return self.by_plan(follower, times, slopes, needs, see),
                Some(Err(error)) => return Err(error.into()),
                None => {}
            }
        }
        self.by_sweep(times, slopes, needs, see)
    }
}

impl<'d, M: Mechanism> Follow<'d, M> {
    pub(crate) fn new(design: &'d Design<M>, mechanism: &'d M, branch: &'d Branch) -> Self {
        let free = design.free.iter().enumerate();
        let all = free.flat_map(|(k, free)| free.places.iter().map(move |&index| (index, (k, free.width()))));
        let (places, moved_by) = all.unzip();
        Self { design, mechanism, branch, places, moved_by }
    }

    fn solver(&self) -> Solver<'_, M> {
        let solver = Solver::new(self.mechanism);
        let solver = self.design.guesses.iter().fold(solver, |solver, &(place, value)| solver.with_guess(place, value));
        self.branch.modes.iter().fold(solver, |solver, &(place, sign)| solver.with_mode(place, sign))
    }

    /// The parameters with respect to which numbers have derivatives.
    fn varying(&self, slopes: bool) -> &[usize] {
        if slopes { &self.places } else { &self.places[..self.places.len().min(WIDTH)] }
    }

    fn by_plan(
        &self,
        mut follower: PlanFollower<M>,
        times: &[f64],
        slopes: bool,
        needs: Needs,
        see: &mut See<'_>,
    ) -> Result<(), SolveError> {
        let (mut varying, mut varied) = (Varying::new(self.mechanism), Varied::default());
        for (k, &t) in times.iter().enumerate() {
            let at = Instant::at(t);
            if k > 0 {
                follower.update(self.mechanism, &at, &Control::USUAL)?;
            }
            let q = follower.state().q;
            for (group, places) in self.varying(slopes).chunks(WIDTH).enumerate() {
                varying.begin(&at, places);
                varying.solve_from(follower.modes().of_closures(), q.as_ref(), needs.depth, &mut varied)?;
                complete(&mut varying, &mut varied, needs)?;
                see(k, group * WIDTH, &varied);
            }
        }
        Ok(())
    }

    fn by_sweep(&self, times: &[f64], slopes: bool, needs: Needs, see: &mut See<'_>) -> Result<(), SolveError> {
        let solver = self.solver();
        let trajectory = solver.sweep(times).map_err(|error| error.source)?;
        let mut varying = Varying::new(self.mechanism);
        for (k, state) in trajectory.states.iter().enumerate() {
            let mut first = 0;
            solver.vary(&mut varying, state, self.varying(slopes), &mut |variation, places, varied| {
                complete(variation, varied, Needs { observed: false, ..needs })?;
                see(k, first, varied);
                first += places.len();
                Ok(())
            })?;
        }
        Ok(())
    }
}
