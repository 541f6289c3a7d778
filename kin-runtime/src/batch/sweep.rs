//! The whole motion of many sets of parameters.

use super::BatchError;
use super::column::{Arguments, Column, Configurations, check_list, check_signals};
use super::end::{End, Outcome};
use super::forces::table;
use super::modes::Modes;
use super::motion::BlockMotion;
use super::run::{BatchShape, Progress, blocks, drive};
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::scalar::lanes::{Lanes, Octet};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::ControlFlow;

/// Number of instants, over all blocks, between two calls of `watch`.
const INSTANTS: usize = 512;

/// Sets of parameters, and the time grid over which each of them moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweeps<'a> {
    /// The parameters, in the order of [`Model::parameters`](crate::model::Model::parameters), a number for every set
    /// or one for all.
    pub parameters: &'a [Column<'a>],
    /// The instants, in the order in which they are solved. The closer they are, the more sets reach the next one in a
    /// single step.
    pub times: &'a [f64],
    /// The inputs, a number for every *instant* or one for all instants; all sets have the same inputs.
    pub inputs: &'a [Signal<Column<'a>>],
    /// The assembly modes at the first instant, for every set; they are kept along the motion.
    pub modes: Modes<'a>,
    /// n columns, for every set: angles at the first instant are within half a turn of these.
    pub start: &'a [Column<'a>],
}

/// A block of sets at one instant.
pub struct Moment<'s> {
    /// The index of the first set; the others are in the next lanes. Lanes after the last set repeat it.
    pub first: usize,
    /// The instant, an index of [`Sweeps::times`].
    pub instant: usize,
    /// Time.
    pub t: f64,
    /// Parameters.
    pub parameters: &'s [Lanes],
    /// q, n numbers; angles are continuous from instant to instant and not wrapped.
    pub q: &'s [Lanes],
    /// q̇, n numbers.
    pub q_dot: &'s [Lanes],
    /// q̈, n numbers.
    pub q_ddot: &'s [Lanes],
    /// The smallest margin.
    pub margin: Lanes,
    inputs: &'s [Signal<Lanes>],
    ends: &'s [Option<End>; Lanes::COUNT],
    all: bool,
}

impl Moment<'_> {
    /// Whether the motion of the set in a lane has not ended. A lane whose motion has ended repeats the numbers of
    /// another one.
    #[inline]
    pub fn moves(&self, lane: usize) -> bool {
        self.ends[lane].is_none()
    }

    /// Time and inputs, for further evaluations of the mechanism.
    #[inline]
    pub fn at(&self) -> Instant<'_, Lanes> {
        Instant { t: Lanes::from(self.t), inputs: self.inputs }
    }

    /// Forces of the block: the numbers of [`ForceModel`](crate::model::ForceModel), from which a score may be computed
    /// (efforts by [`ForceModel::effort`](crate::model::ForceModel::effort), reactions, powers). Those of a spring between
    /// points that coincide are NaN.
    ///
    /// # Errors
    /// [`NoForces`](BatchError::NoForces) as in [`forces`](super::forces), and [`Length`](BatchError::Length) if
    /// `forces` does not have [`ForceModel::count`](crate::model::ForceModel::count) entries.
    #[inline]
    pub fn forces<M: Mechanism>(&self, mechanism: &M, forces: &mut [Lanes]) -> Result<(), BatchError> {
        table::<M>()?;
        mechanism.forces_with(self.parameters, &self.at(), self.q, self.q_dot, self.q_ddot, &[], forces)?;
        Ok(())
    }

    /// `new` in the lanes that move, `old` in the others.
    #[inline(always)]
    pub fn keep(&self, old: Lanes, new: Lanes) -> Lanes {
        if self.all { new } else { self.keep_some(old, new) }
    }

    #[cold]
    fn keep_some(&self, old: Lanes, new: Lanes) -> Lanes {
        let (old, new) = (old.to_array(), new.to_array());
        Lanes::generate(|lane| if self.moves(lane) { new[lane] } else { old[lane] })
    }
}

/// The result of a batch of motions: a score for every block of four sets, and the sets that ended early.
#[derive(Clone, Debug)]
pub struct Motions<S> {
    count: usize,
    blocks: Vec<Outcome<S>>,
}

impl<S: Clone> Motions<S> {
    /// Room for `count` sets of parameters, with the initial score of every block.
    pub fn new(count: usize, score: S) -> Self {
        Self { count, blocks: alloc::vec![(score, [None; Lanes::COUNT]); blocks(count)] }
    }
}

impl<S> Motions<S> {
    /// How many sets there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The scores, one for every four sets.
    pub fn blocks(&self) -> impl Iterator<Item = &S> {
        self.blocks.iter().map(|(score, _)| score)
    }

    /// A component of the scores, a number for every set.
    pub fn scores(&self, part: impl Fn(&S) -> Lanes) -> impl Iterator<Item = f64> {
        self.blocks.iter().flat_map(move |(score, _)| part(score).to_array()).take(self.count)
    }

    /// Where each set ended early; `None` if it went through all instants.
    pub fn ends(&self) -> impl Iterator<Item = Option<End>> {
        self.blocks.iter().flat_map(|(_, ends)| *ends).take(self.count)
    }
}

/// The work of [`sweep`].
struct Sweep<'a, M, V, S> {
    mechanism: &'a M,
    sweeps: &'a Sweeps<'a>,
    /// The parameters, the start in place of q, and the modes in place of q̇.
    configurations: &'a Configurations<'a>,
    visit: V,
    score: PhantomData<fn(&mut S)>,
}

/// The buffers of one thread.
struct SweepBuffers<'a, M: Mechanism> {
    arguments: Arguments<'a, Octet>,
    inputs: Vec<Signal<Octet>>,
    shown_inputs: Vec<Signal<Lanes>>,
    /// On the heap, because the generated code of a large mechanism needs the stack.
    motion: Box<BlockMotion<M>>,
    shown: Box<Shown<M>>,
}

/// The buffers in which a group of lanes is shown to `visit`.
struct Shown<M: Mechanism> {
    parameters: M::Parameters<Lanes>,
    q: M::Coordinates<Lanes>,
    q_dot: M::Coordinates<Lanes>,
    q_ddot: M::Coordinates<Lanes>,
}

impl<'a, M, V, S> Sweep<'a, M, V, S>
where
    M: Mechanism + Sync,
    V: Fn(&mut S, &Moment<'_>) + Sync,
{
    fn scratch(&self) -> SweepBuffers<'a, M> {
        let four = Lanes::default();
        SweepBuffers {
            arguments: Arguments::new(self.configurations),
            inputs: alloc::vec![Signal::constant(Octet::default()); M::INPUTS],
            shown_inputs: alloc::vec![Signal::constant(Lanes::default()); M::INPUTS],
            motion: Box::new(BlockMotion::nothing()),
            shown: Box::new(Shown {
                parameters: Array::filled(four),
                q: Array::filled(four),
                q_dot: Array::filled(four),
                q_ddot: Array::filled(four),
            }),
        }
    }

    fn block(&self, first: usize, scratch: &mut SweepBuffers<'a, M>, out: &mut [Outcome<S>]) {
        let SweepBuffers { arguments, inputs, shown_inputs, motion, shown } = scratch;
        out.iter_mut().for_each(|(_, ends)| *ends = [None; Lanes::COUNT]);
        let block = arguments.block(first);
        motion.parameters.as_mut().copy_from_slice(block.parameters);
        motion.predicted.as_mut().copy_from_slice(block.q);
        for (instant, &t) in self.sweeps.times.iter().enumerate() {
            for (input, column) in inputs.iter_mut().zip(self.sweeps.inputs) {
                *input = column.map(|numbers| Octet::from_f64(numbers.at(instant)));
            }
            for (shown, input) in shown_inputs.iter_mut().zip(inputs.iter()) {
                *shown = input.map(|numbers| numbers.group(0));
            }
            let at = Instant { t: Octet::from_f64(t), inputs };
            let refusals = if instant == 0 {
                let modes = motion.modes.as_mut();
                self.sweeps.modes.of_block(self.mechanism, block.parameters, &at, block.q, block.q_dot, modes);
                motion.modes_of_start = matches!(self.sweeps.modes, Modes::OfStart);
                motion.begin(self.mechanism, &at)
            } else {
                motion.advance(self.mechanism, &at, t)
            };
            if let Some(refusals) = refusals
                && !motion.mask(instant, &refusals, out)
            {
                return;
            }
            for (group, (score, ends)) in out.iter_mut().enumerate() {
                if ends.iter().all(Option::is_some) {
                    continue;
                }
                let poses = motion.poses();
                show(shown.parameters.as_mut(), motion.parameters.as_ref(), group);
                show(shown.q.as_mut(), poses.q.as_ref(), group);
                show(shown.q_dot.as_mut(), poses.q_dot.as_ref(), group);
                show(shown.q_ddot.as_mut(), poses.q_ddot.as_ref(), group);
                let moment = Moment {
                    first: first + group * Lanes::COUNT,
                    instant,
                    t,
                    parameters: shown.parameters.as_ref(),
                    q: shown.q.as_ref(),
                    q_dot: shown.q_dot.as_ref(),
                    q_ddot: shown.q_ddot.as_ref(),
                    margin: poses.margin.group(group),
                    inputs: shown_inputs,
                    all: ends.iter().all(Option::is_none),
                    ends,
                };
                (self.visit)(score, &moment);
            }
        }
    }
}

/// Copies a group of lanes of every number.
#[inline(always)]
fn show(to: &mut [Lanes], from: &[Octet], group: usize) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = from.group(group));
}

/// The whole motion of many sets of parameters over one time grid; `out` says how many there are.
///
/// Eight sets move together, but every set moves as [`Planned`](crate::Planned) would move it alone: on the branch of
/// its first instant, up to the end of that branch. `visit` is called for every block at every instant, in the order of
/// the grid, from any of the threads, and updates the score of the block; states are not kept. A set that reaches a
/// limit ends there: [`Motions::ends`] has the instant, and [`Moment::keep`] leaves its part of the score unchanged.
/// `watch` gets the number of finished sets and may stop the batch.
///
/// ```
/// use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
/// use kin_runtime::{Lanes, Mechanism, Scalar, mechanism};
///
/// #[mechanism]
/// #[bodies(crank, coupler, rocker)]
/// #[revolute(C: ground @ (0, 0), crank @ (0, 0))]
/// #[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
/// #[revolute(B: coupler @ (length, 0), rocker @ (0, 0))]
/// #[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
/// #[driver(drive: crank.phi = t)]
/// struct FourBar {
///     #[param(0.4)]
///     length: f64,
/// }
///
/// // A thousand couplers, a turn of the crank in steps of one degree: how fast does the rocker get?
/// let lengths: Vec<f64> = (0..1000).map(|k| 0.2 + 0.0005 * f64::from(k)).collect();
/// let times: Vec<f64> = (0..=360).map(|k| f64::from(k).to_radians()).collect();
/// let sweeps = Sweeps {
///     parameters: &[Column::Each(&lengths)],
///     times: &times,
///     inputs: &[],
///     modes: Modes::Signs(&[Column::Shared(1.0)]),
///     start: &[Column::Shared(0.0); 9],
/// };
/// // The sum of ω² of the rocker over all instants.
/// let mut out = Motions::new(lengths.len(), Lanes::from(0.0));
/// sweep(&FourBar::default(), &sweeps, &mut out, &always, |sum: &mut Lanes, moment| {
///     let omega = moment.q_dot[8];
///     *sum = moment.keep(*sum, *sum + omega * omega);
/// })?;
/// // Long couplers do not close all the way; the calmest of the others:
/// let turning = out.scores(|sum| *sum).zip(out.ends()).filter(|(_, end)| end.is_none());
/// let calmest = turning.map(|(sum, _)| sum).fold(f64::INFINITY, f64::min);
/// assert!(calmest > 0.0 && calmest.is_finite());
/// let end = out.ends().last().flatten().expect("the last coupler does not close all the way");
/// assert!(end.margin < 0.0);
/// assert_eq!(end.limit.map(|limit| limit.step.to_string()).as_deref(), Some("dyad RRR of A, B, D"));
/// # Ok::<(), kin_runtime::batch::BatchError>(())
/// ```
///
/// # Errors
/// If the mechanism has no plan, if a list or a column has the wrong length, and if `watch` stops the batch.
pub fn sweep<M, S>(
    mechanism: &M,
    sweeps: &Sweeps<'_>,
    out: &mut Motions<S>,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
    visit: impl Fn(&mut S, &Moment<'_>) + Sync,
) -> Result<(), BatchError>
where
    M: Mechanism + Sync,
    S: Send,
{
    if let Some(why) = M::model().plan.absent {
        return Err(BatchError::NoPlan(why));
    }
    let &Sweeps { parameters, times, inputs, modes, start } = sweeps;
    check_list("parameters", M::PARAMETERS, parameters, out.count)?;
    check_list("start", M::COORDINATES, start, out.count)?;
    check_signals(M::INPUTS, inputs, times.len())?;
    modes.check::<M>(out.count)?;
    // Inputs and times belong to instants, not to sets: they are not read with the columns of the sets.
    let configurations =
        Configurations { parameters, t: Column::Shared(0.0), inputs: &[], q: start, q_dot: modes.columns() };
    let work = Sweep { mechanism, sweeps, configurations: &configurations, visit, score: PhantomData };
    let chunk = (INSTANTS / Octet::GROUPS / times.len().max(1)).max(1);
    let shape = BatchShape { count: out.count, width: Octet::COUNT, stride: Octet::GROUPS, chunk };
    drive(&shape, &mut out.blocks, watch, || work.scratch(), |first, scratch, out| work.block(first, scratch, out))
}
