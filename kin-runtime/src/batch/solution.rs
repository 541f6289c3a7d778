//! q, q̇ and q̈ of many configurations by the plan.

use super::BatchError;
use super::block_solution::{BlockSolution, Question};
use super::column::{Arguments, Column, Configurations, check_list, check_signals};
use super::modes::Modes;
use super::run::{BatchShape, CHUNK, Progress, drive};
use crate::mechanism::{LengthError, Mechanism};
use crate::plan::Depth;
use crate::planned::lists::{self, Margins};
use crate::scalar::Scalar;
use crate::scalar::lanes::Octet;
use crate::signal::Signal;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::ControlFlow;

/// The problems of a batch, a column for each number that one solution needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problems<'a> {
    /// The parameters, in the order of [`Model::parameters`](crate::model::Model::parameters).
    pub parameters: &'a [Column<'a>],
    /// Time t.
    pub t: Column<'a>,
    /// The inputs, in the order of declaration.
    pub inputs: &'a [Signal<Column<'a>>],
    /// The assembly modes.
    pub modes: Modes<'a>,
    /// n columns: angles of the result are within half a turn of these, and iterations start from them. With
    /// [`Modes::OfStart`] they determine the modes, so that they must be a configuration that closes, or near one: the
    /// q of a state, for example.
    pub start: &'a [Column<'a>],
}

impl Problems<'_> {
    /// Checks that all lists and columns have the right lengths.
    pub(super) fn check<M: Mechanism>(&self, count: usize) -> Result<(), BatchError> {
        let &Self { parameters, t, inputs, modes, start } = self;
        check_list("parameters", M::PARAMETERS, parameters, count)?;
        check_list("start", M::COORDINATES, start, count)?;
        t.check("the column of t", count)?;
        check_signals(M::INPUTS, inputs, count)?;
        modes.check::<M>(count)?;
        Ok(())
    }
}

/// A block of solutions.
pub(super) struct SolvedBlock<'s> {
    pub(super) q: &'s [Octet],
    pub(super) q_dot: &'s [Octet],
    pub(super) q_ddot: &'s [Octet],
    /// 1 in the lanes that are solved, 0 in the others.
    pub(super) good: &'s Octet,
}

/// The results of a batch of solutions.
///
/// A configuration is *solved* when all margins of the plan exceed
/// [`Plan::SMALLEST_MARGIN`](crate::plan::Plan::SMALLEST_MARGIN), all numbers are finite, and no iteration has ended more
/// than half a turn away from its start or, with [`Modes::OfStart`], at another closure than that of the start. A length
/// that a joint keeps must not be negative, and rounding errors must not dominate the rates, as they do beside a crossing
/// of branches. For others q, q̇ and q̈ are 0.
pub struct Solutions<M: Mechanism> {
    count: usize,
    /// For every block q, q̇ and q̈, the smallest margin, and 1 in the lanes that are solved.
    blocks: Vec<Octet>,
    mechanism: PhantomData<fn(M)>,
}

impl<M: Mechanism> Solutions<M> {
    /// Number of vectors of a block.
    const STRIDE: usize = 3 * M::COORDINATES + 2;
    const MARGIN: usize = Self::STRIDE - 2;
    const GOOD: usize = Self::STRIDE - 1;

    /// Room for `count` configurations, none of them solved.
    pub fn new(count: usize) -> Self {
        let blocks = alloc::vec![Octet::default(); count.div_ceil(Octet::COUNT) * Self::STRIDE];
        Self { count, blocks, mechanism: PhantomData }
    }

    /// How many configurations there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Checks that there are `count` solutions.
    pub(super) fn check(&self, count: usize) -> Result<(), LengthError> {
        let list = "the list of solutions";
        if self.count == count { Ok(()) } else { Err(LengthError { what: list, expected: count, found: self.count }) }
    }

    /// Block number `index`.
    pub(super) fn block(&self, index: usize) -> SolvedBlock<'_> {
        let n = M::COORDINATES;
        let block = &self.blocks[index * Self::STRIDE..][..Self::STRIDE];
        let (q, q_dot, q_ddot) = (&block[..n], &block[n..2 * n], &block[2 * n..3 * n]);
        SolvedBlock { q, q_dot, q_ddot, good: &block[Self::GOOD] }
    }

    /// Whether each configuration is solved.
    pub fn solved(&self) -> impl Iterator<Item = bool> {
        are_positive(self.column(Self::GOOD))
    }

    /// The smallest margin of each configuration: 1 far from all limits, 0 at a limit, negative beyond it; also 0 if it
    /// is not finite, and if the configuration is not solved for another reason than its margins.
    pub fn margin(&self) -> impl Iterator<Item = f64> {
        self.column(Self::MARGIN)
    }

    /// Coordinate number `k`, a number for every configuration.
    ///
    /// # Panics
    /// This method and the two for rates panic if there is no such coordinate.
    pub fn q(&self, k: usize) -> impl Iterator<Item = f64> {
        self.of_coordinate(0, k)
    }

    /// The velocity of coordinate `k`; 0 if it was not requested.
    pub fn q_dot(&self, k: usize) -> impl Iterator<Item = f64> {
        self.of_coordinate(1, k)
    }

    /// The acceleration of coordinate `k`; 0 if it was not requested.
    pub fn q_ddot(&self, k: usize) -> impl Iterator<Item = f64> {
        self.of_coordinate(2, k)
    }

    fn of_coordinate(&self, order: usize, k: usize) -> impl Iterator<Item = f64> {
        let n = M::COORDINATES;
        assert!(k < n, "coordinate {k} of {n}");
        self.column(order * n + k)
    }

    /// A number for every configuration, by its index in the blocks.
    fn column(&self, index: usize) -> impl Iterator<Item = f64> {
        numbers(&self.blocks, Self::STRIDE, index, self.count)
    }
}

// Functions and not methods, so that their iterators are compiled once for all mechanisms.

/// The numbers at an index of every block.
fn numbers(blocks: &[Octet], stride: usize, index: usize, count: usize) -> impl Iterator<Item = f64> {
    blocks.chunks_exact(stride).flat_map(move |block| block[index].to_array()).take(count)
}

/// Whether each number is positive.
fn are_positive(numbers: impl Iterator<Item = f64>) -> impl Iterator<Item = bool> {
    numbers.map(|number| number > 0.0)
}

/// The buffers of one thread.
struct SolutionBuffers<'a, M: Mechanism> {
    arguments: Arguments<'a, Octet>,
    modes: lists::Modes<M, Octet>,
    margins: Margins<M, Octet>,
}

/// The work of [`solve`].
struct Solve<'a, M> {
    mechanism: &'a M,
    depth: Depth,
    modes: Modes<'a>,
}

impl<M: Mechanism> Solve<'_, M> {
    #[inline]
    fn block(&self, first: usize, scratch: &mut SolutionBuffers<'_, M>, out: &mut [Octet]) {
        let SolutionBuffers { arguments, modes, margins } = scratch;
        let block = arguments.block(first);
        self.modes.of_block(self.mechanism, block.parameters, &block.at, block.q, block.q_dot, modes.as_mut());
        let signs = &*modes;
        let modes = signs.of_closures();
        let (parameters, at, start, depth) = (block.parameters, &block.at, block.q, self.depth);
        let (q, rest) = out.split_at_mut(M::COORDINATES);
        let (q_dot, rest) = rest.split_at_mut(M::COORDINATES);
        let (q_ddot, rest) = rest.split_at_mut(M::COORDINATES);
        if depth < Depth::Acceleration {
            // Clears the results of an earlier batch.
            q_dot.fill(Octet::default());
            q_ddot.fill(Octet::default());
        }
        let mut poses = BlockSolution { q, q_dot, q_ddot, margin: Octet::default(), good: [true; Octet::COUNT] };
        let mut good = Octet::from_f64(1.0);
        let question = Question { parameters, at, modes, start, depth };
        let all = poses.solve(self.mechanism, &question, margins).is_none();
        let of_start = matches!(self.modes, Modes::OfStart);
        poses.check(self.mechanism, &question, (signs, of_start), margins);
        if !all || poses.good != [true; Octet::COUNT] {
            poses.clear_bad();
            good = Octet::generate(|lane| f64::from(u8::from(poses.is_good(lane))));
        }
        (rest[0], rest[1]) = (poses.margin, good);
    }
}

/// q, q̇ and q̈, as far as `depth` requests them, of all configurations by the plan; `out` says how many there are.
///
/// Eight configurations are solved at once. The result for one does not depend on the others: to the last bit if the
/// plan has closed forms only, and within the tolerance of the iteration if it has Newton steps. `watch` gets the
/// progress and may stop the batch.
///
/// ```
/// use kin_runtime::batch::{Column, Modes, Problems, Solutions, always, solve};
/// use kin_runtime::plan::Depth;
/// use kin_runtime::{Mechanism, mechanism};
///
/// #[mechanism]
/// #[bodies(crank, coupler, rocker)]
/// #[revolute(C: ground @ (0, 0), crank @ (0, 0))]
/// #[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
/// #[revolute(B: coupler @ (length, 0), rocker @ (0, 0))]
/// #[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
/// #[driver(drive: crank.phi = 2.3 * t)]
/// struct FourBar {
///     #[param(0.4)]
///     length: f64,
/// }
///
/// // Three couplers at t = 0.1; the last one is too long to close.
/// let lengths = [0.3, 0.4, 4.0];
/// let start = [Column::Shared(0.0); 9];
/// let problems = Problems {
///     parameters: &[Column::Each(&lengths)],
///     t: Column::Shared(0.1),
///     inputs: &[],
///     modes: Modes::Signs(&[Column::Shared(1.0)]),
///     start: &start,
/// };
/// let mut out = Solutions::<FourBar>::new(lengths.len());
/// solve(&FourBar::default(), Depth::Acceleration, &problems, &mut out, &always)?;
/// assert!(out.solved().eq([true, true, false]));
/// assert!(out.q_dot(2).take(2).all(|omega| omega == 2.3));
/// assert!(out.margin().nth(2).is_some_and(|margin| margin < 0.0));
/// # Ok::<(), kin_runtime::batch::BatchError>(())
/// ```
///
/// # Errors
/// If the mechanism has no plan, if a list or a column has the wrong length, and if `watch` stops the batch.
pub fn solve<M: Mechanism + Sync>(
    mechanism: &M,
    depth: Depth,
    problems: &Problems<'_>,
    out: &mut Solutions<M>,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<(), BatchError> {
    if let Some(why) = M::model().plan.absent {
        return Err(BatchError::NoPlan(why));
    }
    let &Problems { parameters, t, inputs, modes, start } = problems;
    problems.check::<M>(out.count)?;
    let configurations = Configurations { parameters, t, inputs, q: start, q_dot: modes.columns() };
    let work = Solve { mechanism, depth, modes };
    let shape = BatchShape { count: out.count, width: Octet::COUNT, stride: Solutions::<M>::STRIDE, chunk: CHUNK };
    let scratch = || SolutionBuffers {
        arguments: Arguments::new(&configurations),
        modes: lists::Modes::filled(Octet::default()),
        margins: Margins::filled(Octet::default()),
    };
    drive(&shape, &mut out.blocks, watch, scratch, |first, scratch, out| work.block(first, scratch, out))
}
