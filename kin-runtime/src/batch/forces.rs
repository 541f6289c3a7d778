//! Forces of many solved configurations.

use super::BatchError;
use super::column::{Arguments, Configurations};
use super::run::{BatchShape, CHUNK, Progress, drive};
use super::solution::{Problems, Solutions, SolvedBlock};
use crate::mechanism::Mechanism;
use crate::model::ForceModel;
use crate::scalar::Scalar;
use crate::scalar::lanes::Octet;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::ControlFlow;

/// The forces of a batch: the numbers of [`ForceModel`] for every configuration, 0 if it has none.
pub struct ForceSolutions<M: Mechanism> {
    count: usize,
    /// For every block the numbers of forces, and 1 in the lanes that have forces.
    blocks: Vec<Octet>,
    mechanism: PhantomData<fn(M)>,
}

impl<M: Mechanism> ForceSolutions<M> {
    /// Room for `count` configurations.
    pub fn new(count: usize) -> Self {
        let blocks = alloc::vec![Octet::default(); count.div_ceil(Octet::COUNT) * Self::stride()];
        Self { count, blocks, mechanism: PhantomData }
    }

    /// The number of forces, and their vectors in a block.
    fn numbers_of_block() -> usize {
        M::model().forces.map_or(0, |model| model.count)
    }

    /// Vectors of a block.
    fn stride() -> usize {
        Self::numbers_of_block() + 1
    }

    /// How many configurations there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether each configuration has forces. It has none if [`solve`](super::solve) found no solution, or if one of the
    /// numbers is not finite, as for a spring between points that coincide.
    pub fn solved(&self) -> impl Iterator<Item = bool> {
        self.column(Self::numbers_of_block()).map(|solved| solved > 0.0)
    }

    /// One number for every configuration, by its index in [`ForceModel`]: [`ForceModel::effort`] gives the index of a
    /// driver's effort, [`ForceModel::reaction`] those of a joint's reaction, and constants such as
    /// [`ForceModel::DRIVER_POWER`] those of quantities of the whole mechanism.
    ///
    /// # Panics
    /// If there is no such index.
    pub fn numbers(&self, index: usize) -> impl Iterator<Item = f64> {
        let count = Self::numbers_of_block();
        assert!(index < count, "number {index} of {count}");
        self.column(index)
    }

    fn column(&self, index: usize) -> impl Iterator<Item = f64> {
        let blocks = self.blocks.chunks_exact(Self::stride());
        blocks.flat_map(move |block| block[index].to_array()).take(self.count)
    }
}

/// The table of forces, if they have closed forms along the plan.
pub(super) fn table<M: Mechanism>() -> Result<&'static ForceModel, BatchError> {
    match M::model().forces {
        None => Err(BatchError::NoForces("the mechanism has neither masses nor loads")),
        Some(model) if !model.solved => Err(BatchError::NoForces(
            "λ has no closed form: redundant rows share the load, or there is no plan; use `Solver::forces` for \
             each state",
        )),
        Some(model) => Ok(model),
    }
}

/// All forces of configurations that [`solve`](super::solve) has solved, for the same problems: efforts, reactions,
/// energies and powers in closed form, eight configurations at once. If `solutions` contain positions only, rates and
/// accelerations are 0, and the forces are those of the mechanism at rest. [`ForceSolutions::solved`] says which
/// configurations have forces. `watch` gets the progress and may stop the batch. Negative masses among the parameters
/// are not refused here, as [`Solver::forces`](crate::Solver::forces) does.
///
/// ```
/// use kin_runtime::batch::{Column, ForceSolutions, Modes, Problems, Solutions, always, forces, solve};
/// use kin_runtime::plan::Depth;
/// use kin_runtime::{Mechanism, mechanism};
///
/// #[mechanism]
/// #[bodies(arm)]
/// #[revolute(O: ground @ (0, 0), arm @ (0, 0))]
/// #[driver(motor: arm.phi = 0.3)]
/// #[gravity(0, -9.81)]
/// #[mass(arm @ (l/2, 0), mass = 2*l)]
/// struct Arm {
///     #[param(0.4)]
///     l: f64,
/// }
///
/// // The torque that holds arms of three lengths.
/// let lengths = [0.3, 0.4, 4.0];
/// let start = [Column::Shared(0.0); 3];
/// let parameters = [Column::Each(&lengths)];
/// let (t, modes) = (Column::Shared(0.0), Modes::Signs(&[]));
/// let problems = Problems { parameters: &parameters, t, inputs: &[], modes, start: &start };
/// let (mut solutions, mut out) = (Solutions::<Arm>::new(3), ForceSolutions::new(3));
/// solve(&Arm::default(), Depth::Acceleration, &problems, &mut solutions, &always)?;
/// forces(&Arm::default(), &problems, &solutions, &mut out, &always)?;
/// let motor = Arm::model().forces.and_then(|forces| forces.effort("motor")).expect("a motor").place;
/// for (torque, l) in out.numbers(motor).zip(lengths) {
///     assert!((torque - 9.81 * l * l * 0.3_f64.cos()).abs() < 1e-12);
/// }
/// # Ok::<(), kin_runtime::batch::BatchError>(())
/// ```
///
/// # Errors
/// [`NoForces`](BatchError::NoForces) for a mechanism without masses and loads, and for one whose λ is not solved in
/// closed form ([`ForceModel::solved`]); if a list or a column differs in length from `out`, and if `watch` stops the
/// batch.
pub fn forces<M: Mechanism + Sync>(
    mechanism: &M,
    problems: &Problems<'_>,
    solutions: &Solutions<M>,
    out: &mut ForceSolutions<M>,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<(), BatchError> {
    let model = table::<M>()?;
    problems.check::<M>(out.count)?;
    solutions.check(out.count)?;
    let &Problems { parameters, t, inputs, .. } = problems;
    // q and its rates are those of the solutions.
    let configurations = Configurations { parameters, t, inputs, q: &[], q_dot: &[] };
    let stride = ForceSolutions::<M>::stride();
    let shape = BatchShape { count: out.count, width: Octet::COUNT, stride, chunk: CHUNK };
    let arguments = || Arguments::<Octet>::new(&configurations);
    drive(&shape, &mut out.blocks, watch, arguments, |first, arguments, out| {
        let block = arguments.block(first);
        let solved = solutions.block(first / Octet::COUNT);
        let SolvedBlock { q, q_dot, q_ddot, good } = solved;
        let (forces, rest) = out.split_at_mut(model.count);
        let lengths = mechanism.forces_with(block.parameters, &block.at, q, q_dot, q_ddot, &[], forces);
        debug_assert!(lengths.is_ok(), "the columns have been counted");
        // 0 times a number that is not finite is NaN.
        let zero = Octet::from_f64(0.0);
        let good = forces.iter().fold(*good, |good, number| good + *number * zero);
        rest[0] = good;
        // One comparison for all lanes, since nearly always all of them are solved.
        if (good - Octet::from_f64(1.0)).is_within(0.0) {
            return;
        }
        for lane in (0..Octet::COUNT).filter(|lane| good.lane(*lane) != 1.0) {
            out.iter_mut().for_each(|number| number.set(lane, 0.0));
        }
    })
}
