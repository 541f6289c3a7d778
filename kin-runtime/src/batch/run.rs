//! The loop of all batches over blocks of lanes, on one core or on all of them.

use super::BatchError;
use crate::scalar::lanes::Lanes;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Number of blocks in one unit of work, after which `watch` is called, if the work per block is short.
pub(super) const CHUNK: usize = 512;

/// The progress of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The number of finished configurations.
    pub done: usize,
    /// The number of all configurations.
    pub total: usize,
}

/// Called every few thousand configurations (every few motions in a sweep), from any of the threads, with the progress
/// of the batch; decides whether the batch continues.
pub(super) type Watch<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// A watch that never stops a batch.
pub fn always(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The number of blocks for `count` configurations.
pub(super) const fn blocks(count: usize) -> usize {
    count.div_ceil(Lanes::COUNT)
}

/// How a batch is divided.
pub(super) struct BatchShape {
    /// Number of configurations.
    pub(super) count: usize,
    /// Number of configurations of a block.
    pub(super) width: usize,
    /// Number of results of a block; the last block may have fewer.
    pub(super) stride: usize,
    /// Number of blocks between two calls of `watch`.
    pub(super) chunk: usize,
}

/// Calls `block` with the first configuration of every block, the results of the block and the scratch of the thread.
pub(super) fn drive<T: Send, S>(
    shape: &BatchShape,
    out: &mut [T],
    watch: Watch<'_>,
    scratch: impl Fn() -> S + Sync,
    block: impl Fn(usize, &mut S, &mut [T]) + Sync,
) -> Result<(), BatchError> {
    let &BatchShape { count, width, stride, chunk } = shape;
    let (done, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let each = |scratch: &mut S, index: usize, out: &mut [T]| {
        if stopped.load(Ordering::Relaxed) {
            return;
        }
        let start = index * chunk * width;
        for (index, out) in out.chunks_mut(stride).enumerate() {
            block(start + index * width, scratch, out);
        }
        let finished = (out.len() * width).div_ceil(stride).min(count - start);
        let done = done.fetch_add(finished, Ordering::Relaxed) + finished;
        if watch(Progress { done, total: count }).is_break() {
            stopped.store(true, Ordering::Relaxed);
        }
    };
    in_chunks(chunk * stride, out, scratch, each);
    let done = done.into_inner();
    // A watch that stops after the last configuration changes nothing: all are done.
    if done < count { Err(BatchError::Stopped(Progress { done, total: count })) } else { Ok(()) }
}

/// Calls `each` with every chunk and its number, on all cores with the feature `parallel`.
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
