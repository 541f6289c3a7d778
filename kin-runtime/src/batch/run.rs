//! The driver of all batches: work over blocks of lanes, one after another or across the cores.

use super::BatchError;
use crate::scalar::lanes::Lanes;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Blocks between two looks at the watch, and in one piece of work of a core, where a block takes a moment.
pub(super) const CHUNK: usize = 512;

/// What is done with a block of [`Lanes::COUNT`] configurations.
pub trait Work: Sync {
    /// The results of a block.
    type Block: Send;
    /// What one thread needs besides; made once and used for many blocks.
    type Scratch;

    /// Scratch of a thread.
    fn scratch(&self) -> Self::Scratch;

    /// The configurations `first`, `first + 1`, … one in each lane. In the last block of a batch some of them may not
    /// exist; what their lanes hold is nobody's concern.
    fn block(&self, first: usize, scratch: &mut Self::Scratch, out: &mut Self::Block);

    /// Blocks between two looks at the watch, at least one: fewer where a block takes long.
    fn chunk(&self) -> usize {
        CHUNK
    }
}

/// How far a batch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Configurations done.
    pub done: usize,
    /// All of them.
    pub total: usize,
}

/// Is told every few thousand configurations (every few motions in a sweep) how far the batch is, from any of the threads,
/// and says whether to go on.
pub type Watch<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// Goes on.
pub fn always(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// How many blocks `count` configurations take.
pub const fn blocks(count: usize) -> usize {
    count.div_ceil(Lanes::COUNT)
}

/// Does `work` for `count` configurations, with results in the first [`blocks`]`(count)` of `out`.
///
/// # Errors
/// [`BatchError::Length`] when `out` is too short, and [`BatchError::Stopped`] when `watch` said so.
pub fn run<W: Work>(work: &W, count: usize, out: &mut [W::Block], watch: Watch<'_>) -> Result<(), BatchError> {
    let found = out.len();
    let Some(out) = out.get_mut(..blocks(count)) else {
        return Err(crate::LengthError { what: "the list of blocks", expected: blocks(count), found }.into());
    };
    let shape = Shape { count, width: Lanes::COUNT, stride: 1, chunk: work.chunk().max(1) };
    let block = |first: usize, scratch: &mut W::Scratch, out: &mut [W::Block]| {
        out.iter_mut().for_each(|out| work.block(first, scratch, out));
    };
    drive(&shape, out, watch, || work.scratch(), block)
}

/// What a batch is cut into.
pub(super) struct Shape {
    /// Configurations.
    pub(super) count: usize,
    /// Those of a block.
    pub(super) width: usize,
    /// Entries that the results of a block take; in the last one there may be fewer.
    pub(super) stride: usize,
    /// Blocks between two looks at the watch.
    pub(super) chunk: usize,
}

/// Does `block` for the first configuration of every block, with its results and the scratch of the thread.
pub(super) fn drive<T: Send, S>(
    shape: &Shape,
    out: &mut [T],
    watch: Watch<'_>,
    scratch: impl Fn() -> S + Sync,
    block: impl Fn(usize, &mut S, &mut [T]) + Sync,
) -> Result<(), BatchError> {
    let &Shape { count, width, stride, chunk } = shape;
    let (done, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let each = |scratch: &mut S, place: usize, out: &mut [T]| {
        if stopped.load(Ordering::Relaxed) {
            return;
        }
        let start = place * chunk * width;
        for (place, out) in out.chunks_mut(stride).enumerate() {
            block(start + place * width, scratch, out);
        }
        let own = (out.len() * width).div_ceil(stride).min(count - start);
        let done = done.fetch_add(own, Ordering::Relaxed) + own;
        if watch(Progress { done, total: count }).is_break() {
            stopped.store(true, Ordering::Relaxed);
        }
    };
    in_chunks(chunk * stride, out, scratch, each);
    let done = done.into_inner();
    // Whoever stops it with the last configuration has all of them.
    if done < count { Err(BatchError::Stopped(Progress { done, total: count })) } else { Ok(()) }
}

/// `each` chunk with its number: across the cores where there is more than one.
fn in_chunks<T: Send, S>(
    size: usize,
    out: &mut [T],
    scratch: impl Fn() -> S + Sync,
    each: impl Fn(&mut S, usize, &mut [T]) + Sync,
) {
    #[cfg(feature = "parallel")]
    if out.len() > size {
        use rayon::iter::{IndexedParallelIterator, ParallelIterator};
        use rayon::slice::ParallelSliceMut;
        let chunks = out.par_chunks_mut(size).enumerate();
        chunks.for_each_init(&scratch, |scratch, (chunk, out)| each(scratch, chunk, out));
        return;
    }
    let mut scratch = scratch();
    for (chunk, out) in out.chunks_mut(size).enumerate() {
        each(&mut scratch, chunk, out);
    }
}
