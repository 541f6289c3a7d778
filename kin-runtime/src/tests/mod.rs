//! Tests of the analyses on mechanisms written by hand; expected numbers are from `tests/data/` of the workspace.

mod accuracy;
mod by_plan;
mod errors;
mod freedom;
mod iteration;
mod places;
mod planned;
mod sweeps;
mod texts;

/// Asserts that two vectors agree to `tolerance`, scaled by the largest expected entry.
fn agree(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= tolerance * size, "entry {k}: {a} instead of {b} in {found:?}");
    }
}
