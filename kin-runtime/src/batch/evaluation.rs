//! Φ, Φ_q, Φ_t and γ of many configurations.

use super::BatchError;
use super::column::{Arguments, Block, Configurations};
use super::run::{BatchShape, CHUNK, Progress, blocks, drive};
use crate::mechanism::{Mechanism, Workspace};
use crate::scalar::lanes::Lanes;
use crate::workspace::Subset;
use alloc::vec::Vec;
use core::ops::ControlFlow;

/// The results of a batch of evaluations: a workspace of [`Lanes`] for every block of four configurations.
pub struct Evaluations<M: Mechanism> {
    count: usize,
    blocks: Vec<Workspace<M, Lanes>>,
}

impl<M: Mechanism> Evaluations<M> {
    /// Room for `count` configurations; the constant entries of Φ_q are set, everything else is zero.
    pub fn new(count: usize) -> Self {
        Self { count, blocks: alloc::vec![M::workspace::<Lanes>(); blocks(count)] }
    }

    /// How many configurations there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The blocks; lanes after the last configuration have no meaning.
    pub fn blocks(&self) -> &[Workspace<M, Lanes>] {
        &self.blocks
    }

    /// Row number `row` of Φ, a number for every configuration.
    ///
    /// # Panics
    /// This method and the following ones panic while the iterator is read, if there is no such row or entry.
    pub fn phi(&self, row: usize) -> impl Iterator<Item = f64> {
        self.column(Workspace::<M, Lanes>::phi, row)
    }

    /// A non-zero of Φ_q, by its index among the entries of the pattern.
    pub fn phi_q(&self, entry: usize) -> impl Iterator<Item = f64> {
        self.column(Workspace::<M, Lanes>::phi_q, entry)
    }

    /// Row number `row` of Φ_t.
    pub fn phi_t(&self, row: usize) -> impl Iterator<Item = f64> {
        self.column(Workspace::<M, Lanes>::phi_t, row)
    }

    /// Row number `row` of γ.
    pub fn gamma(&self, row: usize) -> impl Iterator<Item = f64> {
        self.column(Workspace::<M, Lanes>::gamma, row)
    }

    // Functions have one type for all columns, where closures have four, so that the iterator is compiled once.
    fn column(&self, list: fn(&Workspace<M, Lanes>) -> &[Lanes], index: usize) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |k| list(&self.blocks[k / Lanes::COUNT])[index].to_array()[k % Lanes::COUNT])
    }
}

/// Φ, Φ_q, Φ_t, γ, or any subset of them, of all configurations; `out` says how many there are.
///
/// Parts that `subset` does not request may be overwritten or left unchanged. `watch` gets the progress and may stop
/// the batch; [`always`](super::always) never stops it.
///
/// # Errors
/// If a list or a column has the wrong length, and if `watch` stops the batch.
pub fn evaluate<M: Mechanism + Sync>(
    mechanism: &M,
    subset: Subset,
    configurations: &Configurations<'_>,
    out: &mut Evaluations<M>,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<(), BatchError>
where
    Workspace<M, Lanes>: Send,
{
    configurations.check::<M>(out.count)?;
    let shape = BatchShape { count: out.count, width: Lanes::COUNT, stride: 1, chunk: CHUNK };
    let arguments = || Arguments::<Lanes>::new(configurations);
    drive(&shape, &mut out.blocks, watch, arguments, |first, arguments, out| {
        let Block { parameters, at, q, q_dot } = arguments.block(first);
        for workspace in out {
            let lengths = mechanism.evaluate_with(parameters, subset, &at, q, q_dot, workspace);
            debug_assert!(lengths.is_ok(), "the columns have been counted");
        }
    })
}
