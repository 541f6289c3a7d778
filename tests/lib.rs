//! Mechanisms with known solutions, and helpers of the tests that read and compare them.
#![deny(missing_docs, warnings)]

pub mod case;
pub mod compare;
pub mod examples;
pub mod mechanisms;
pub mod programs;
pub mod random;
pub mod stencil;

use kin_runtime::{Instant, Kinematics, Signal};

/// Fails unless the mechanism assembles at t = 0 with all inputs at 0, has no degrees of freedom left, and passes the
/// cross-check of its closed forms.
pub fn works<M: Kinematics>(mechanism: &M) {
    let inputs = vec![Signal::default(); M::INPUTS];
    let state = mechanism.state_at(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    assert_eq!(0, state.degrees_of_freedom_left);
    let check = mechanism.cross_check().unwrap();
    assert!(check.passes(1e-12), "{check}");
}

/// The README, whose code is compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
