//! q, q̇ and q̈ of many configurations by the plan.

use super::BatchError;
use super::column::{Arguments, Column, Configurations, check_list, check_signals};
use super::modes::Modes;
use super::poses::{Poses, Question};
use super::run::{Watch, Work, blocks, run};
use crate::lanes::Lanes;
use crate::mechanism::Mechanism;
use crate::plan::Depth;
use crate::signal::Signal;
use crate::workspace::Array;
use alloc::vec::Vec;

/// What a batch is to solve, a column for each number that one solution takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problems<'a> {
    /// In the order of [`Model::parameters`](crate::model::Model::parameters).
    pub parameters: &'a [Column<'a>],
    /// Time t.
    pub t: Column<'a>,
    /// The inputs, in the order of declaration.
    pub inputs: &'a [Signal<Column<'a>>],
    /// Which closures are meant.
    pub modes: Modes<'a>,
    /// n columns: angles come out within half a turn of these, and iterations start here.
    pub start: &'a [Column<'a>],
}

/// The results of a batch of solutions.
///
/// A configuration is *solved* when all margins of the plan exceed
/// [`Plan::SMALLEST_MARGIN`](crate::plan::Plan::SMALLEST_MARGIN) and all numbers are finite. Of one that is not, q, q̇ and
/// q̈ are 0, and the margin says why.
pub struct Solutions<M: Mechanism> {
    count: usize,
    blocks: Vec<Poses<M>>,
}

impl<M: Mechanism> Solutions<M> {
    /// Room for `count` configurations, none of them solved.
    pub fn new(count: usize) -> Self {
        Self { count, blocks: alloc::vec![Poses::nothing(); blocks(count)] }
    }

    /// How many configurations there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether each configuration is solved.
    pub fn solved(&self) -> impl Iterator<Item = bool> {
        self.blocks.iter().flat_map(|block| block.good).take(self.count)
    }

    /// The smallest margin of each configuration: 1 far from trouble, 0 at a limit, negative beyond it; 0, too, where it is
    /// not a finite number.
    pub fn margin(&self) -> impl Iterator<Item = f64> {
        self.column(|block| block.margin)
    }

    /// Coordinate number `k`, a number for every configuration.
    ///
    /// # Panics
    /// This and its sisters, while it is read, where there is no such coordinate.
    pub fn q(&self, k: usize) -> impl Iterator<Item = f64> {
        self.column(move |block| block.q.as_ref()[k])
    }

    /// The velocity of coordinate `k`; 0 where it was not asked for.
    pub fn q_dot(&self, k: usize) -> impl Iterator<Item = f64> {
        self.column(move |block| block.q_dot.as_ref()[k])
    }

    /// The acceleration of coordinate `k`; 0 where it was not asked for.
    pub fn q_ddot(&self, k: usize) -> impl Iterator<Item = f64> {
        self.column(move |block| block.q_ddot.as_ref()[k])
    }

    fn column(&self, of: impl Fn(&Poses<M>) -> Lanes) -> impl Iterator<Item = f64> {
        self.blocks.iter().flat_map(move |block| of(block).to_array()).take(self.count)
    }
}

/// The work of [`solve`].
struct Solve<'a, M> {
    mechanism: &'a M,
    depth: Depth,
    modes: Modes<'a>,
    /// The start stands at q and the modes at q̇.
    configurations: &'a Configurations<'a>,
}

impl<'a, M: Mechanism + Sync> Work for Solve<'a, M>
where
    M::Coordinates<Lanes>: Send,
{
    type Block = Poses<M>;
    type Scratch = Arguments<'a, M>;

    fn scratch(&self) -> Arguments<'a, M> {
        Arguments::new(self.configurations)
    }

    #[inline]
    fn block(&self, first: usize, arguments: &mut Arguments<'a, M>, out: &mut Poses<M>) {
        let block = arguments.block(first);
        let signs = self.modes.of_block(self.mechanism, block.parameters, &block.at, block.q, block.q_dot);
        let modes = &signs.as_ref()[..M::model().plan.modes.len()];
        let (parameters, at, start, depth) = (block.parameters, block.at, block.q, self.depth);
        if depth < Depth::Acceleration {
            // What an earlier batch has left there is not an answer to this one.
            (out.q_dot, out.q_ddot) = (zeros::<M>(), zeros::<M>());
        }
        let _ = out.solve(self.mechanism, &Question { parameters, at, modes, start, depth });
        out.clear_bad();
    }
}

fn zeros<M: Mechanism>() -> M::Coordinates<Lanes> {
    Array::generate(|_| Lanes::default())
}

/// q, q̇ and q̈, as far as `depth` goes, of all configurations by the plan; `out` says how many there are.
///
/// Four of them go through every step together. What is found for one does not depend on its neighbours, to the last bit
/// where the plan has closed forms only, and within the tolerance of the iteration where it has Newton steps. `watch` is
/// told how far it is and may stop it.
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
/// When the mechanism has no plan, when a list or a column has the wrong length, and when `watch` stops it.
pub fn solve<M: Mechanism + Sync>(
    mechanism: &M,
    depth: Depth,
    problems: &Problems<'_>,
    out: &mut Solutions<M>,
    watch: Watch<'_>,
) -> Result<(), BatchError>
where
    M::Coordinates<Lanes>: Send,
{
    if let Some(why) = M::model().plan.absent {
        return Err(BatchError::NoPlan(why));
    }
    let &Problems { parameters, t, inputs, modes, start } = problems;
    check_list("parameters", M::PARAMETERS, parameters, out.count)?;
    check_list("start", M::COORDINATES, start, out.count)?;
    t.check("the column of t", out.count)?;
    check_signals::<M>(inputs, out.count)?;
    modes.check::<M>(out.count)?;
    let configurations = Configurations { parameters, t, inputs, q: start, q_dot: modes.columns() };
    let configurations = &configurations;
    run(&Solve { mechanism, depth, modes, configurations }, out.count, &mut out.blocks, watch)
}
