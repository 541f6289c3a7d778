//! The whole motion of many sets of parameters.

use super::BatchError;
use super::column::{Arguments, Column, Configurations, check_list, check_signals};
use super::end::{End, Outcome};
use super::forces::table;
use super::modes::Modes;
use super::motion::Motion;
use super::run::{Progress, Shape, blocks, drive};
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::scalar::lanes::{Lanes, Octet, Pack};
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::ControlFlow;

/// Instants of all blocks between two looks at the watch.
const INSTANTS: usize = 512;

/// Sets of parameters, and the time grid over which each of them moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweeps<'a> {
    /// In the order of [`Model::parameters`](crate::model::Model::parameters), a number for every set or one for all.
    pub parameters: &'a [Column<'a>],
    /// The instants, in the order in which they are solved; the nearer they are, the more sets go there in one step.
    pub times: &'a [f64],
    /// The inputs, a number for every *instant* or one for all of them; the same for all sets.
    pub inputs: &'a [Signal<Column<'a>>],
    /// Which closures are meant: at the first instant, for every set, and kept from there.
    pub modes: Modes<'a>,
    /// n columns, for every set: angles at the first instant come out within half a turn of these.
    pub start: &'a [Column<'a>],
}

/// A block of sets at one instant.
pub struct Moment<'s> {
    /// The number of the first set; the others are in the next lanes. Lanes behind the last set repeat it.
    pub first: usize,
    /// The instant, a place in [`Sweeps::times`].
    pub instant: usize,
    /// Time.
    pub t: f64,
    /// Parameters.
    pub parameters: &'s [Lanes],
    /// q, n numbers; angles go on counting from instant to instant.
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
    /// Whether a lane still moves. One that does not repeats another that does.
    #[inline]
    pub fn moves(&self, lane: usize) -> bool {
        self.ends[lane].is_none()
    }

    /// Time and inputs, for further evaluations of the mechanism.
    #[inline]
    pub fn at(&self) -> Instant<'_, Lanes> {
        Instant { t: Lanes::from(self.t), inputs: self.inputs }
    }

    /// Forces of the block: the numbers of [`ForceModel`](crate::model::ForceModel), from which a score may take efforts
    /// ([`ForceModel::effort`](crate::model::ForceModel::effort)), reactions, powers.
    ///
    /// # Errors
    /// [`NoForces`](BatchError::NoForces) as in [`forces`](super::forces), and where `forces` has another length than
    /// [`ForceModel::count`](crate::model::ForceModel::count).
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

/// What is left of a batch of motions: a score for every block of four sets, and where sets had to end.
#[derive(Clone, Debug)]
pub struct Motions<S> {
    count: usize,
    blocks: Vec<Outcome<S>>,
}

impl<S: Clone> Motions<S> {
    /// Room for `count` sets of parameters, with the score that every block begins with.
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

    /// A part of the scores, a number for every set.
    pub fn scores(&self, part: impl Fn(&S) -> Lanes) -> impl Iterator<Item = f64> {
        self.blocks.iter().flat_map(move |(score, _)| part(score).to_array()).take(self.count)
    }

    /// Where each set had to end; none where it went through all instants.
    pub fn ends(&self) -> impl Iterator<Item = Option<End>> {
        self.blocks.iter().flat_map(|(_, ends)| *ends).take(self.count)
    }
}

/// The work of [`sweep`].
struct Sweep<'a, M, V, S> {
    mechanism: &'a M,
    sweeps: &'a Sweeps<'a>,
    /// The start stands at q and the modes at q̇.
    configurations: &'a Configurations<'a>,
    visit: V,
    score: PhantomData<fn(&mut S)>,
}

/// What one thread needs.
struct Scratch<'a, M: Mechanism> {
    arguments: Arguments<'a, M, Octet>,
    inputs: Vec<Signal<Octet>>,
    shown_inputs: Vec<Signal<Lanes>>,
    /// Elsewhere than on the stack, which a large mechanism's own code needs.
    motion: Box<Motion<M>>,
    shown: Box<Shown<M>>,
}

/// A group of lanes as it is shown.
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
    fn scratch(&self) -> Scratch<'a, M> {
        let four = |_| Lanes::default();
        Scratch {
            arguments: Arguments::new(self.configurations),
            inputs: alloc::vec![Signal::constant(Octet::default()); M::INPUTS],
            shown_inputs: alloc::vec![Signal::constant(Lanes::default()); M::INPUTS],
            motion: Box::new(Motion::nothing()),
            shown: Box::new(Shown {
                parameters: Array::generate(four),
                q: Array::generate(four),
                q_dot: Array::generate(four),
                q_ddot: Array::generate(four),
            }),
        }
    }

    fn block(&self, first: usize, scratch: &mut Scratch<'a, M>, out: &mut [Outcome<S>]) {
        let Scratch { arguments, inputs, shown_inputs, motion, shown } = scratch;
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

/// A group of lanes of every number.
#[inline(always)]
fn show(to: &mut [Lanes], from: &[Octet], group: usize) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = from.group(group));
}

/// The whole motion of many sets of parameters over one time grid; `out` says how many there are.
///
/// Eight sets move together, each on its own way. Every set goes where [`Planned`](crate::Planned) would lead it alone, on
/// the branch that it is on at the first instant, and ends where that ends. `visit` is called for every block
/// at every instant, in the order of the grid, from any of the threads, and gathers what it wants in the score of the
/// block; states are not kept. A set that comes to a limit goes no further: [`Motions::ends`] says where, and
/// [`Moment::keep`] keeps its part of the score as it was. `watch` is told how many sets are done and may stop it.
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
/// When the mechanism has no plan, when a list or a column has the wrong length, and when `watch` stops it.
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
    check_signals::<M>(inputs, times.len())?;
    modes.check::<M>(out.count)?;
    // Inputs belong to the instants, and time is the grid: neither is read with the sets.
    let configurations =
        Configurations { parameters, t: Column::Shared(0.0), inputs: &[], q: start, q_dot: modes.columns() };
    let work = Sweep { mechanism, sweeps, configurations: &configurations, visit, score: PhantomData };
    let chunk = (INSTANTS / Octet::GROUPS / times.len().max(1)).max(1);
    let shape = Shape { count: out.count, width: Octet::COUNT, stride: Octet::GROUPS, chunk };
    drive(&shape, &mut out.blocks, watch, || work.scratch(), |first, scratch, out| work.block(first, scratch, out))
}
