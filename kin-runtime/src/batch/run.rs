//! The driver of all batches: work over blocks of lanes, one after another or across the cores.

use super::BatchError;
use crate::scalar::lanes::Lanes;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Blocks between two looks at the watch, and in one piece of work of a core, where a block takes a moment.
pub(super) const CHUNK: usize = 512;

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
pub(super) type Watch<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// Goes on.
pub fn always(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// How many blocks `count` configurations take.
pub(super) const fn blocks(count: usize) -> usize {
    count.div_ceil(Lanes::COUNT)
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
