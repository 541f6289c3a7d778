//! Mechanisms in a crate of edition 2021 with `missing_docs` denied: the items that `#[mechanism]` adds must have
//! documentation.
#![deny(missing_docs, warnings)]
#![deny(rust_2018_idioms, unreachable_pub, unused, clippy::all, clippy::pedantic)]
#![deny(missing_debug_implementations, missing_copy_implementations, unsafe_code, single_use_lifetimes)]

use kin_runtime::mechanism;

/// The lecture's four-bar.
#[mechanism]
#[derive(Debug, Clone, Copy, PartialEq)]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = pi/4 + omega * t)]
#[point(tip = coupler @ (0, 0.1))]
#[define(transmission = rocker.phi - coupler.phi)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBar {
    /// Crank length
    #[param(0.1, unit = "m")]
    pub l1: f64,
    /// Coupler length
    #[param(0.4, unit = "m")]
    pub l2: f64,
    /// Rocker length
    #[param(0.3, unit = "m")]
    pub l3: f64,
    /// Ground pin D, x
    #[param(0.4, unit = "m")]
    pub d1: f64,
    /// Ground pin D, y
    #[param(0.1, unit = "m")]
    pub d2: f64,
    /// Crank speed
    #[param(1, unit = "rad/s")]
    pub omega: f64,
}

/// A motion without parameters.
#[mechanism]
#[derive(Debug, Clone, Copy)]
#[coordinates(gen, dyn_)]
#[driver(drive: gen = t)]
#[constraint(follow: dyn_ = sin(gen))]
pub struct Follower;

#[cfg(test)]
mod tests {
    use super::{Follower, FourBar};
    use kin_runtime::{Instant, Kinematics};

    #[test]
    fn they_move() {
        let state = FourBar::default().state_at(&Instant::at(0.0)).unwrap();
        assert!((state.q[8] - 5.0).abs() < 5e-4, "{state:?}");
        assert!(FourBar::default().cross_check().unwrap().passes(1e-12));
        assert!(Follower.kinematic_analysis(&[0.0, 1.0]).unwrap().len() == 2);
    }
}
