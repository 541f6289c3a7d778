//! Forces of many solved configurations.

use super::BatchError;
use super::column::{Arguments, Configurations};
use super::run::{CHUNK, Progress, Shape, drive};
use super::solution::{Problems, Solutions, SolvedBlock};
use crate::mechanism::Mechanism;
use crate::model::ForceModel;
use crate::scalar::lanes::{Lanes, Octet, Pack};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::ControlFlow;

/// The forces of a batch: the numbers of [`ForceModel`] for every configuration, 0 if it is not solved.
pub struct ForceSolutions<M: Mechanism> {
    count: usize,
    blocks: Vec<Octet>,
    mechanism: PhantomData<fn(M)>,
}

impl<M: Mechanism> ForceSolutions<M> {
    /// Room for `count` configurations.
    pub fn new(count: usize) -> Self {
        let blocks = alloc::vec![Octet::default(); count.div_ceil(Octet::COUNT) * Self::stride()];
        Self { count, blocks, mechanism: PhantomData }
    }

    /// Vectors of a block.
    fn stride() -> usize {
        M::model().forces.map_or(0, |model| model.count)
    }

    /// How many configurations there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// One number for every configuration, by its index in [`ForceModel`]: [`ForceModel::effort`] gives the index of a
    /// driver's effort, [`ForceModel::reaction`] those of a joint's reaction, and constants such as
    /// [`ForceModel::DRIVER_POWER`] those of quantities of the whole mechanism.
    ///
    /// # Panics
    /// If there is no such index.
    pub fn numbers(&self, place: usize) -> impl Iterator<Item = f64> {
        let stride = Self::stride();
        assert!(place < stride, "number {place} of {stride}");
        let blocks = self.blocks.chunks_exact(stride.max(1));
        blocks.flat_map(move |block| Octet::each(|lane| block[place].lane(lane))).take(self.count)
    }
}

/// The table of forces, if they have closed forms along the plan.
pub(super) fn table<M: Mechanism>() -> Result<&'static ForceModel, BatchError> {
    match M::model().forces {
        None => Err(BatchError::NoForces("the mechanism has neither masses nor loads")),
        Some(model) if !model.solved => Err(BatchError::NoForces("no closed forms solve for the multipliers")),
        Some(model) => Ok(model),
    }
}

/// All forces of configurations that [`solve`](super::solve) has solved, for the same problems: efforts, reactions,
/// energies and powers in closed form, eight configurations at once. If `solutions` contain positions only, rates and
/// accelerations are 0, and forces are those at rest. `watch` gets the progress and may stop the batch.
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
    let &Problems { parameters, t, inputs, modes, start } = problems;
    let configurations = Configurations { parameters, t, inputs, q: start, q_dot: modes.columns() };
    let shape = Shape { count: out.count, width: Octet::COUNT, stride: model.count, chunk: CHUNK };
    let scratch = || Scratch { arguments: Arguments::<M, Octet>::new(&configurations), four: Four::new(model.count) };
    drive(&shape, &mut out.blocks, watch, scratch, |first, Scratch { arguments, four }, out| {
        let block = arguments.block(first);
        let solved = solutions.block(first / Octet::COUNT);
        for group in 0..Octet::GROUPS {
            four.take(block.parameters, &block.at, &solved, group);
            let at = Instant { t: block.at.t.group(group), inputs: &four.inputs };
            let [parameters, q, q_dot, q_ddot] =
                [four.parameters.as_ref(), four.q.as_ref(), four.q_dot.as_ref(), four.q_ddot.as_ref()];
            let lengths = mechanism.forces_with(parameters, &at, q, q_dot, q_ddot, &[], &mut four.forces);
            debug_assert!(lengths.is_ok(), "the columns have been counted");
            out.iter_mut().zip(&four.forces).for_each(|(to, from)| to.set_group(group, *from));
        }
        for lane in (0..Octet::COUNT).filter(|lane| solved.good.lane(*lane) == 0.0) {
            out.iter_mut().for_each(|number| number.set(lane, 0.0));
        }
    })
}

/// The buffers of one thread.
struct Scratch<'a, M: Mechanism> {
    arguments: Arguments<'a, M, Octet>,
    four: Four<M>,
}

/// Half a block. Closed forms of forces have many live values at once: with eight lanes these would not fit into
/// registers.
struct Four<M: Mechanism> {
    parameters: M::Parameters<Lanes>,
    inputs: Vec<Signal<Lanes>>,
    q: M::Coordinates<Lanes>,
    q_dot: M::Coordinates<Lanes>,
    q_ddot: M::Coordinates<Lanes>,
    forces: Vec<Lanes>,
}

impl<M: Mechanism> Four<M> {
    fn new(count: usize) -> Self {
        let nothing = |_| Lanes::default();
        Self {
            parameters: Array::generate(nothing),
            inputs: alloc::vec![Signal::constant(Lanes::default()); M::INPUTS],
            q: Array::generate(nothing),
            q_dot: Array::generate(nothing),
            q_ddot: Array::generate(nothing),
            forces: alloc::vec![Lanes::default(); count],
        }
    }

    #[inline(always)]
    fn take(&mut self, parameters: &[Octet], at: &Instant<'_, Octet>, solved: &SolvedBlock<'_>, group: usize) {
        let copy = |to: &mut [Lanes], from: &[Octet]| {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = from.group(group));
        };
        copy(self.parameters.as_mut(), parameters);
        copy(self.q.as_mut(), solved.q);
        copy(self.q_dot.as_mut(), solved.q_dot);
        copy(self.q_ddot.as_mut(), solved.q_ddot);
        self.inputs.iter_mut().zip(at.inputs).for_each(|(to, from)| *to = from.map(|x| x.group(group)));
    }
}
