//! Mechanisms with known solutions, and helpers of the tests that read and compare them.
#![deny(missing_docs, warnings)]

pub mod case;
pub mod compare;
pub mod examples;
pub mod mechanisms;
pub mod programs;
pub mod random;
pub mod stencil;
pub mod subject;

use kin_runtime::{Instant, Kinematics, Mechanism, Signal};

/// Fails unless the mechanism assembles at t = 0 with all inputs at 0, has no degrees of freedom left, and passes the
/// cross-check of its closed forms.
pub fn works<M: Kinematics>(mechanism: &M) {
    let inputs = vec![Signal::default(); M::INPUTS];
    let state = mechanism.state_at(&Instant { t: 0.0, inputs: &inputs }).unwrap();
    assert_eq!(0, state.degrees_of_freedom_left);
    let check = mechanism.cross_check().unwrap();
    assert!(check.passes(1e-12), "{check}");
}

/// The modes of a configuration, a sign ±1 for each.
pub fn modes<M: Mechanism>(mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Vec<f64> {
    signs(&branch_values(mechanism, at, q)[..M::model().plan.modes.len()])
}

/// The branch values of a configuration, whose signs are those of its groups.
pub fn branch_values<M: Mechanism>(mechanism: &M, at: &Instant<'_>, q: &[f64]) -> Vec<f64> {
    let mut branches = vec![f64::NAN; M::model().plan.signs()];
    mechanism.branches_with(mechanism.parameters::<f64>().as_ref(), at, q, &mut branches).unwrap();
    branches
}

fn signs(branches: &[f64]) -> Vec<f64> {
    branches.iter().map(|w| w.signum()).collect()
}

/// The README, whose code is compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
