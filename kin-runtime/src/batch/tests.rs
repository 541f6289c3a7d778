//! Tests of the loop over blocks, with work that only records the indices of its configurations.

use super::run::{BatchShape, CHUNK, blocks, drive};
use super::{BatchError, Progress, always};
use crate::scalar::lanes::Lanes;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicUsize, Ordering};

/// Writes the index of every configuration.
fn run(
    count: usize,
    out: &mut [Lanes],
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Result<(), BatchError> {
    let shape = BatchShape { count, width: Lanes::COUNT, stride: 1, chunk: CHUNK };
    drive(
        &shape,
        &mut out[..blocks(count)],
        watch,
        || (),
        |first, (), out| {
            out.fill(Lanes::generate(|lane| (first + lane) as f64));
        },
    )
}

fn numbers(count: usize) -> Vec<f64> {
    let mut out = vec![Lanes::from(-1.0); blocks(count) + 1];
    run(count, &mut out, &always).unwrap();
    assert_eq!(Lanes::from(-1.0), out[blocks(count)], "a block more than there are");
    out.into_iter().flat_map(Lanes::to_array).take(count).collect()
}

#[test]
fn every_configuration_once_whatever_their_number() {
    for count in (0..=9).chain([2047, 2048, 2049, 4096, 10_001]) {
        assert!(numbers(count).into_iter().eq((0..count).map(|k| k as f64)), "{count}");
    }
}

#[test]
fn progress_comes_to_all_of_them() {
    let (largest, calls) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let watch = |Progress { done, total }| {
        assert!(done <= total && total == 9_999);
        largest.fetch_max(done, Ordering::Relaxed);
        calls.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let mut out = vec![Lanes::default(); blocks(9_999)];
    run(9_999, &mut out, &watch).unwrap();
    assert_eq!((9_999, 5), (largest.into_inner(), calls.into_inner()));
}

#[test]
fn stops_when_told_to() {
    let stop = |_| ControlFlow::Break(());
    let mut out = vec![Lanes::default(); blocks(1_000_000)];
    let Err(BatchError::Stopped(Progress { done, total })) = run(1_000_000, &mut out, &stop) else {
        panic!("it went on")
    };
    assert!(total == 1_000_000 && done > 0 && done < total / 2, "{done}");
    // After the last configuration there is nothing to stop.
    assert_eq!(Ok(()), run(100, &mut out, &stop));
}
