//! Mechanisms and their batches without the type of the mechanism, so that a law about all of them is compiled once.

use kin_runtime::batch::{BatchError, End, Moment, Motions, Problems, Solutions, Sweeps, always, solve, sweep};
use kin_runtime::model::Model;
use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, PlanError, Planned, Signal};
use kin_tests::mechanisms::signals;

/// The states that a batch of motions visits, for a block of four sets: q, q̇, q̈ and margin for every instant.
pub(super) type Seen = Vec<[Vec<Lanes>; 4]>;

/// A mechanism.
pub(super) trait Batched {
    fn model(&self) -> &'static Model;

    fn parameters(&self) -> Vec<f64>;

    /// The same mechanism with other parameters.
    fn with_parameters(&self, parameters: &[f64]) -> Box<dyn Batched>;

    /// The inputs of this test mechanism at time t.
    fn signals(&self, t: f64) -> Vec<Signal>;

    fn assemble(&self, at: &Instant<'_>) -> Vec<f64>;

    /// The modes of a configuration, a sign ±1 for each.
    fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64>;

    /// [`Planned::new`].
    fn planned(&self, at: &Instant<'_>, q: &[f64]) -> Result<Box<dyn Follower + '_>, PlanError>;

    /// [`Mechanism::solve_with`] up to accelerations.
    fn solve_one(&self, parameters: &[f64], at: &Instant<'_>, modes: &[f64], start: &[f64], out: Solved<'_, f64>);

    /// [`solve`] up to accelerations.
    fn solve(&self, problems: &Problems<'_>, count: usize) -> Box<dyn Results>;

    /// [`sweep`], with the ends of the sets and what the blocks have seen.
    fn sweep(
        &self,
        sweeps: &Sweeps<'_>,
        count: usize,
        see: &(dyn Fn(&mut Seen, &Moment<'_>) + Sync),
    ) -> Result<(Vec<Option<End>>, Vec<Seen>), BatchError>;
}

/// [`Planned`].
pub(super) trait Follower {
    fn at(&mut self, at: &Instant<'_>) -> Result<(), PlanError>;

    /// q, q̇ and q̈.
    fn state(&self) -> [&[f64]; 3];

    fn margins(&self) -> &[f64];
}

/// [`Solutions`].
pub(super) trait Results {
    fn count(&self) -> usize;

    fn model(&self) -> &'static Model;

    fn solved(&self, place: usize) -> Option<bool>;

    fn margin(&self, place: usize) -> Option<f64>;

    /// q, q̇ or q̈ of coordinate `k`, by the order.
    fn number(&self, order: usize, k: usize, place: usize) -> Option<f64>;
}

impl<M: Kinematics + Default + Sync + 'static> Batched for M {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn parameters(&self) -> Vec<f64> {
        Mechanism::parameters::<f64>(self).as_ref().to_vec()
    }

    fn with_parameters(&self, parameters: &[f64]) -> Box<dyn Batched> {
        let mut own = M::default();
        for (k, parameter) in parameters.iter().enumerate() {
            assert!(own.set_parameter(k, *parameter));
        }
        Box::new(own)
    }

    fn signals(&self, t: f64) -> Vec<Signal> {
        signals::<M>(t)
    }

    fn assemble(&self, at: &Instant<'_>) -> Vec<f64> {
        self.solver().assemble(at).unwrap()
    }

    fn modes(&self, at: &Instant<'_>, q: &[f64]) -> Vec<f64> {
        kin_tests::modes(self, at, q)
    }

    fn planned(&self, at: &Instant<'_>, q: &[f64]) -> Result<Box<dyn Follower + '_>, PlanError> {
        Ok(Box::new(Planned::new(self, at, q)?))
    }

    fn solve_one(&self, parameters: &[f64], at: &Instant<'_>, modes: &[f64], start: &[f64], out: Solved<'_, f64>) {
        self.solve_with(parameters, at, modes, start, Depth::Acceleration, out).unwrap();
    }

    fn solve(&self, problems: &Problems<'_>, count: usize) -> Box<dyn Results> {
        let mut out = Solutions::<M>::new(count);
        solve(self, Depth::Acceleration, problems, &mut out, &always).unwrap();
        Box::new(out)
    }

    fn sweep(
        &self,
        sweeps: &Sweeps<'_>,
        count: usize,
        see: &(dyn Fn(&mut Seen, &Moment<'_>) + Sync),
    ) -> Result<(Vec<Option<End>>, Vec<Seen>), BatchError> {
        let mut out = Motions::new(count, Seen::new());
        sweep(self, sweeps, &mut out, &always, see)?;
        Ok((out.ends().collect(), out.blocks().cloned().collect()))
    }
}

impl<M: Kinematics> Follower for Planned<'_, M> {
    fn at(&mut self, at: &Instant<'_>) -> Result<(), PlanError> {
        self.at(at)?;
        Ok(())
    }

    fn state(&self) -> [&[f64]; 3] {
        [self.q(), self.q_dot(), self.q_ddot()]
    }

    fn margins(&self) -> &[f64] {
        self.margins()
    }
}

impl<M: Mechanism> Results for Solutions<M> {
    fn count(&self) -> usize {
        self.count()
    }

    fn model(&self) -> &'static Model {
        M::model()
    }

    fn solved(&self, place: usize) -> Option<bool> {
        self.solved().nth(place)
    }

    fn margin(&self, place: usize) -> Option<f64> {
        self.margin().nth(place)
    }

    fn number(&self, order: usize, k: usize, place: usize) -> Option<f64> {
        match order {
            0 => self.q(k).nth(place),
            1 => self.q_dot(k).nth(place),
            _ => self.q_ddot(k).nth(place),
        }
    }
}
