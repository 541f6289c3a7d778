//! Evaluations as functions of a library: compiled with this crate, and called from another one.
//!
//! If a bench has the evaluation in its own crate instead, the compiler can optimise across the call.

use crate::chain::Chain;
use crate::four_bar::FourBar;
use crate::ten::{Ranged, WrittenOut};
#[cfg(feature = "simd")]
use kin_runtime::batch::{BatchError, Configurations, Evaluations, always, evaluate};
use kin_runtime::{Instant, LengthError, Mechanism, Subset, Workspace};

/// Evaluates Φ, Φ_q, Φ_t, γ of the four-bar.
///
/// # Errors
/// As [`Mechanism::evaluate`].
pub fn four_bar(
    four_bar: &FourBar,
    t: f64,
    q: &[f64],
    q_dot: &[f64],
    workspace: &mut Workspace<FourBar>,
) -> Result<(), LengthError> {
    four_bar.evaluate(Subset::ALL, &Instant::at(t), q, q_dot, workspace)
}

/// Evaluates Φ, Φ_q, Φ_t, γ of a hundred loops.
///
/// # Errors
/// As [`Mechanism::evaluate`].
pub fn chain(
    chain: &Chain,
    t: f64,
    q: &[f64],
    q_dot: &[f64],
    workspace: &mut Workspace<Chain>,
) -> Result<(), LengthError> {
    chain.evaluate(Subset::ALL, &Instant::at(t), q, q_dot, workspace)
}

/// Evaluates Φ, Φ_q, Φ_t, γ of ten loops written with ranges.
///
/// # Errors
/// As [`Mechanism::evaluate`].
pub fn ranged(
    chain: &Ranged,
    t: f64,
    q: &[f64],
    q_dot: &[f64],
    workspace: &mut Workspace<Ranged>,
) -> Result<(), LengthError> {
    chain.evaluate(Subset::ALL, &Instant::at(t), q, q_dot, workspace)
}

/// Evaluates Φ, Φ_q, Φ_t, γ of ten loops written out.
///
/// # Errors
/// As [`Mechanism::evaluate`].
pub fn written_out(
    chain: &WrittenOut,
    t: f64,
    q: &[f64],
    q_dot: &[f64],
    workspace: &mut Workspace<WrittenOut>,
) -> Result<(), LengthError> {
    chain.evaluate(Subset::ALL, &Instant::at(t), q, q_dot, workspace)
}

/// Evaluates Φ, Φ_q, Φ_t, γ of a batch of four-bars.
///
/// # Errors
/// As [`evaluate`].
#[cfg(feature = "simd")]
pub fn columns(
    four_bar: &FourBar,
    configurations: &Configurations<'_>,
    out: &mut Evaluations<FourBar>,
) -> Result<(), BatchError> {
    evaluate(four_bar, Subset::ALL, configurations, out, &always)
}
