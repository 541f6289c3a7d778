//! Proofs by interval arithmetic: existence, local uniqueness and bounds of a solution, and the list of all other
//! solutions.
//!
//! For a configuration q̃ and the box X of all q with |q_k − q̃_k| ≤ ρ_k, R. Krawczyk's operator is
//!
//! ```text
//! K = q̃ − C Φ(q̃, t) + (I − C Φ_q(X, t)) (X − q̃)        C about the inverse of Φ_q(q̃, t)
//! ```
//!
//! If K lies inside of X, exactly one solution of Φ(q, t) = 0 lies in X, and it lies in K (R. Krawczyk,
//! Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969); R. E. Moore, A test for
//! existence of solutions to nonlinear systems, SIAM J. Numer. Anal. 14 (1977)). All of it is computed with
//! [`Interval`](crate::scalar::Interval)s, by the generated code of Φ and Φ_q, so that the proof accounts for rounding.
//! Φ_q is then regular everywhere in X, and the linear equations for q̇ and q̈ have one solution, which is enclosed in
//! the same way.

mod closure_equations;
mod contraction;
mod eliminated;
mod enclosures;
mod fold;
mod folds;
mod krawczyk;
mod left_out;
mod located;
mod newton_step;
mod reduced;
mod scan;
mod search;
mod signs;
mod sizes;
mod smooth;
mod turns;
mod winding;
mod wrapped;

pub(crate) use contraction::zeros;
pub(crate) use enclosures::{Enclosures, OverBoxes};
pub(crate) use folds::{Fold, folds};
pub(crate) use krawczyk::{Prover, Square};
pub(crate) use left_out::violated;
pub(crate) use scan::{MarginSign, Stretch, refined, stretches};
pub(crate) use search::{Certified, SearchOutcome, search};
pub(crate) use signs::{Closing, MAX_COMBINATIONS, advance, combinations, decisive};
pub(crate) use winding::Winding;
