//! Synthesis: the published problems of `tests/data/SYNTHESIS.md`, the effect of conditions, and errors.
//!
//! Most problems take seconds with optimisation and minutes without: `cargo test --release -p kin-tests --test
//! synthesis -- --include-ignored` runs all of them, each with ten seeds.

mod command;
// Quick with optimisation, and minutes without.
#[cfg(not(debug_assertions))]
mod examples;
mod guide;
mod laws;
mod printed;
mod published;
