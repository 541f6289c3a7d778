//! The whole motion of many sets of parameters.

use super::BatchError;
use super::column::{Arguments, Column, Configurations, check_list, check_signals};
use super::modes::Modes;
use super::poses::{Limits, Poses, Question, copy_lane, set};
use super::run::{Watch, Work, blocks, run};
use crate::lanes::Lanes;
use crate::mechanism::Mechanism;
use crate::plan::Depth;
use crate::planned::predict::is_wild;
use crate::planned::{Limit, Step};
use crate::scalar::Scalar;
use crate::signal::{Instant, Signal};
use crate::workspace::Array;
use alloc::vec::Vec;
use core::marker::PhantomData;

/// Instants of all blocks between two looks at the watch.
const INSTANTS: usize = 512;

/// Sets of parameters, and the time grid over which each of them moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweeps<'a> {
    /// In the order of [`Model::parameters`](crate::model::Model::parameters), a number for every set or one for all.
    pub parameters: &'a [Column<'a>],
    /// The instants, in the order in which they are solved; near one another as
    /// [`Planned`](crate::Planned) wants them.
    pub times: &'a [f64],
    /// The inputs, a number for every *instant* or one for all of them; the same for all sets.
    pub inputs: &'a [Signal<Column<'a>>],
    /// Which closures are meant: at the first instant, for every set, and kept from there.
    pub modes: Modes<'a>,
    /// n columns, for every set: angles at the first instant come out within half a turn of these.
    pub start: &'a [Column<'a>],
}

/// Where a set cannot go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The first instant without an answer, a place in [`Sweeps::times`].
    pub instant: usize,
    /// The smallest margin there: 0 or less where a group is at its limit or beyond it; 0, too, where it is not a finite
    /// number. Positive where every group closes and another number is not finite.
    pub margin: f64,
    /// The first step of the plan that has no answer there, with its margin: a group that is at its limit or cannot close,
    /// by its joints, an iteration that does not converge, redundant rows that contradict. None where a number is not finite
    /// for another reason.
    pub limit: Option<Limit>,
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
    ends: &'s [Option<End>; Lanes::COUNT],
    all: bool,
}

impl Moment<'_> {
    /// Whether a lane still moves. One that does not repeats another that does.
    #[inline]
    pub fn moves(&self, lane: usize) -> bool {
        self.ends[lane].is_none()
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
    blocks: Vec<(S, [Option<End>; Lanes::COUNT])>,
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
    arguments: Arguments<'a, M>,
    inputs: Vec<Signal<Lanes>>,
}

impl<'a, M, V, S> Work for Sweep<'a, M, V, S>
where
    M: Mechanism + Sync,
    V: Fn(&mut S, &Moment<'_>) + Sync,
    S: Send,
{
    type Block = (S, [Option<End>; Lanes::COUNT]);
    type Scratch = Scratch<'a, M>;

    fn scratch(&self) -> Scratch<'a, M> {
        let inputs = alloc::vec![Signal::constant(Lanes::default()); M::INPUTS];
        Scratch { arguments: Arguments::new(self.configurations), inputs }
    }

    fn block(&self, first: usize, Scratch { arguments, inputs }: &mut Scratch<'a, M>, (score, ends): &mut Self::Block) {
        *ends = [None; Lanes::COUNT];
        let block = arguments.block(first);
        let mut lanes = Motion::<M> {
            parameters: Array::generate(|place| block.parameters[place]),
            modes: Array::generate(|_| Lanes::default()),
            predicted: Array::generate(|place| block.q[place]),
            poses: Poses::nothing(),
        };
        let mut before = 0.0;
        for (instant, &t) in self.sweeps.times.iter().enumerate() {
            for (input, column) in inputs.iter_mut().zip(self.sweeps.inputs) {
                *input = column.map(|numbers| numbers.at(instant).into());
            }
            let at = Instant { t: Lanes::from(t), inputs };
            if instant == 0 {
                lanes.modes = self.sweeps.modes.of_block(self.mechanism, block.parameters, &at, block.q, block.q_dot);
            } else {
                lanes.predict(t - before);
            }
            before = t;
            let mut limits = lanes.solve(self.mechanism, at);
            if instant > 0 && lanes.poses.good != [true; Lanes::COUNT] {
                lanes.pass(self.mechanism, at, &mut limits);
            }
            if lanes.poses.good != [true; Lanes::COUNT] && !lanes.mask(instant, &limits, ends) {
                return;
            }
            let Motion { parameters, poses, .. } = &lanes;
            let moment = Moment {
                first,
                instant,
                t,
                parameters: parameters.as_ref(),
                q: poses.q.as_ref(),
                q_dot: poses.q_dot.as_ref(),
                q_ddot: poses.q_ddot.as_ref(),
                margin: poses.margin,
                all: ends.iter().all(Option::is_none),
                ends,
            };
            (self.visit)(score, &moment);
        }
    }

    fn chunk(&self) -> usize {
        INSTANTS / self.sweeps.times.len().max(1)
    }
}

/// Four sets on their way.
struct Motion<M: Mechanism> {
    parameters: M::Parameters<Lanes>,
    modes: M::Coordinates<Lanes>,
    predicted: M::Coordinates<Lanes>,
    poses: Poses<M>,
}

impl<M: Mechanism> Motion<M> {
    /// q + h q̇ + ½ h² q̈; in lanes where the bend of a coordinate means nothing, beside a limit, q itself, as
    /// [`Planned`](crate::Planned) does.
    #[inline(always)]
    fn predict(&mut self, h: f64) {
        let Poses { q, q_dot, q_ddot, .. } = &self.poses;
        let (step, half) = (Lanes::from(h), Lanes::from(0.5 * h));
        // A quick look, as there.
        let mut tame = true;
        let rates = q_dot.as_ref().iter().zip(q_ddot.as_ref());
        for ((to, q), (v, a)) in self.predicted.as_mut().iter_mut().zip(q.as_ref()).zip(rates) {
            let bend = half * *a;
            tame &= (step * bend).is_within(1.0);
            *to = *q + step * (*v + bend);
        }
        if !tame {
            self.tame(h);
        }
    }

    #[cold]
    #[inline(never)]
    fn tame(&mut self, h: f64) {
        let Poses { q, q_dot, q_ddot, .. } = &self.poses;
        for lane in 0..Lanes::COUNT {
            let of = |numbers: &[Lanes]| -> M::Coordinates<f64> { Array::generate(|k| numbers[k].to_array()[lane]) };
            let (v, a) = (of(q_dot.as_ref()), of(q_ddot.as_ref()));
            if is_wild(M::model(), h, [v.as_ref(), a.as_ref()]) {
                copy_lane(self.predicted.as_mut(), q.as_ref(), lane, lane);
            }
        }
    }

    #[inline(always)]
    fn solve(&mut self, mechanism: &M, at: Instant<'_, Lanes>) -> Limits {
        let modes = &self.modes.as_ref()[..M::model().plan.modes.len()];
        let (parameters, start) = (self.parameters.as_ref(), self.predicted.as_ref());
        self.poses.solve(mechanism, &Question { parameters, at, modes, start, depth: Depth::Acceleration })
    }

    /// Goes on in the lanes that have passed limits that only the kept rows have.
    #[cold]
    #[inline(never)]
    fn pass(&mut self, mechanism: &M, at: Instant<'_, Lanes>, limits: &mut Limits) {
        let (mut modes, count) = (self.modes, M::model().plan.modes.len());
        let (parameters, start) = (self.parameters.as_ref(), self.predicted.as_ref());
        let kept = &self.modes.as_ref()[..count];
        let question = Question { parameters, at, modes: kept, start, depth: Depth::Acceleration };
        self.poses.pass(mechanism, &question, &mut modes.as_mut()[..count], limits);
        self.modes = modes;
    }

    /// Ends the lanes that are not good, and lets them repeat one that is; false where there is none.
    #[cold]
    #[inline(never)]
    fn mask(&mut self, instant: usize, limits: &Limits, ends: &mut [Option<End>; Lanes::COUNT]) -> bool {
        let good = self.poses.good;
        let margins = self.poses.margin.to_array();
        for lane in 0..Lanes::COUNT {
            if !good[lane] {
                let limit = |(place, margin)| Step::of_margin(M::model(), place).map(|step| Limit { step, margin });
                let limit = limits[lane].and_then(limit);
                ends[lane].get_or_insert(End { instant, margin: margins[lane], limit });
            }
        }
        let Some(other) = (0..Lanes::COUNT).find(|lane| ends[*lane].is_none()) else { return false };
        let (parameters, modes, poses) = (self.parameters, self.modes, self.poses);
        for lane in (0..Lanes::COUNT).filter(|lane| ends[*lane].is_some()) {
            copy_lane(self.parameters.as_mut(), parameters.as_ref(), other, lane);
            copy_lane(self.modes.as_mut(), modes.as_ref(), other, lane);
            self.poses.copy_lane(&poses, other, lane);
            set(&mut self.poses.margin, lane, margins[other]);
        }
        true
    }
}

/// The whole motion of many sets of parameters over one time grid; `out` says how many there are.
///
/// Four sets move together, each on its own way: angles go on counting from instant to instant, as
/// [`Planned`](crate::Planned) has them, and modes stay what they are at the first instant, but for closures that redundant
/// rows carry past a limit of the others. `visit` is called for every block
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
    watch: Watch<'_>,
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
    run(&work, out.count, &mut out.blocks, watch)
}
