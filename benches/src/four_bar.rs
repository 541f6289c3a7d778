//! The lecture's four-bar as kin derives it, and with hand-written equations.

use kin_runtime::{Scalar, mechanism};

/// The lecture's four-bar, joint by joint.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (d1, d2))]
#[driver(drive: crank.phi = phi0 + omega * t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBar {
    /// Length of the crank.
    #[param(0.1, unit = "m")]
    pub l1: f64,
    /// Length of the coupler.
    #[param(0.4, unit = "m")]
    pub l2: f64,
    /// Length of the rocker.
    #[param(0.3, unit = "m")]
    pub l3: f64,
    /// x of the ground pin.
    #[param(0.4, unit = "m")]
    pub d1: f64,
    /// y of the ground pin.
    #[param(0.1, unit = "m")]
    pub d2: f64,
    /// Crank angle at t = 0.
    #[param(0.7, unit = "rad")]
    pub phi0: f64,
    /// Angular velocity of the crank.
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

/// The same four-bar with a crank that is held at its pin, and with a named point of the coupler.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[bodies(coupler, rocker)]
#[revolute(A: crank @ (0.1, 0), coupler @ (-0.2, 0))]
#[revolute(B: coupler @ (0.2, 0), rocker @ (-0.15, 0))]
#[revolute(D: rocker @ (0.15, 0), ground @ (0.4, 0.1))]
#[point(tip = coupler @ (0, 0.1))]
#[driver(drive: crank.phi = 0.7 + t)]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct HeldFourBar;

/// Results of the hand-written evaluation: Φ, Φ_q by rows with its constant entries, Φ_t, γ.
pub struct ByHand {
    /// Φ.
    pub phi: [f64; 9],
    /// Φ_q.
    pub phi_q: [[f64; 9]; 9],
    /// Φ_t.
    pub phi_t: [f64; 9],
    /// γ.
    pub gamma: [f64; 9],
}

impl Default for ByHand {
    fn default() -> Self {
        let mut phi_q = [[0.0; 9]; 9];
        for (row, column, value) in [
            (0, 0, 1.0),
            (1, 1, 1.0),
            (2, 0, -1.0),
            (2, 3, 1.0),
            (3, 1, -1.0),
            (3, 4, 1.0),
            (4, 3, -1.0),
            (4, 6, 1.0),
            (5, 4, -1.0),
            (5, 7, 1.0),
            (6, 6, -1.0),
            (7, 7, -1.0),
            (8, 2, 1.0),
        ] {
            phi_q[row][column] = value;
        }
        Self { phi: [0.0; 9], phi_q, phi_t: [0.0; 9], gamma: [0.0; 9] }
    }
}

/// The evaluation as an engineer would write it from the lecture's equations: straight-line code with the sines and
/// cosines of the standard library.
#[inline(never)]
pub fn by_hand(four_bar: &FourBar, t: f64, q: &[f64; 9], w: &[f64; 9], out: &mut ByHand) {
    let turns = [q[2], q[5], q[8]].map(|angle| (angle.sin(), angle.cos()));
    straight(four_bar, t, q, w, turns, out);
}

/// The same evaluation with the sines and cosines of kin, to separate their effect.
#[inline(never)]
pub fn by_hand_in_lanes(four_bar: &FourBar, t: f64, q: &[f64; 9], w: &[f64; 9], out: &mut ByHand) {
    straight(four_bar, t, q, w, f64::sin_cos_all([q[2], q[5], q[8]]), out);
}

#[inline(always)]
fn straight(four_bar: &FourBar, t: f64, q: &[f64; 9], w: &[f64; 9], turns: [(f64, f64); 3], out: &mut ByHand) {
    let [a, b, c] = [0.5 * four_bar.l1, 0.5 * four_bar.l2, 0.5 * four_bar.l3];
    let [(s1, c1), (s2, c2), (s3, c3)] = turns;
    let (x1, y1) = (a * c1, a * s1);
    let (x2, y2) = (b * c2, b * s2);
    let (x3, y3) = (c * c3, c * s3);
    out.phi = [
        q[0] - x1,
        q[1] - y1,
        q[3] - x2 - q[0] - x1,
        q[4] - y2 - q[1] - y1,
        q[6] - x3 - q[3] - x2,
        q[7] - y3 - q[4] - y2,
        four_bar.d1 - q[6] - x3,
        four_bar.d2 - q[7] - y3,
        q[2] - (four_bar.phi0 + four_bar.omega * t),
    ];
    for (row, column, value) in [
        (0, 2, y1),
        (1, 2, -x1),
        (2, 2, y1),
        (2, 5, y2),
        (3, 2, -x1),
        (3, 5, -x2),
        (4, 5, y2),
        (4, 8, y3),
        (5, 5, -x2),
        (5, 8, -x3),
        (6, 8, y3),
        (7, 8, -x3),
    ] {
        out.phi_q[row][column] = value;
    }
    out.phi_t[8] = -four_bar.omega;
    let (w1, w2, w3) = (w[2] * w[2], w[5] * w[5], w[8] * w[8]);
    let (u1, v1, u2, v2, u3, v3) = (x1 * w1, y1 * w1, x2 * w2, y2 * w2, x3 * w3, y3 * w3);
    out.gamma = [-u1, -v1, -u1 - u2, -v1 - v2, -u2 - u3, -v2 - v3, -u3, -v3, 0.0];
}

#[cfg(test)]
mod tests {
    use super::*;
    use kin_runtime::{Instant, Kinematics};

    #[test]
    fn both_say_the_same() {
        let four_bar = FourBar::default();
        let q: [f64; 9] = core::array::from_fn(|k| 0.3 + 0.7 * k as f64);
        let w: [f64; 9] = core::array::from_fn(|k| 1.0 - 0.2 * k as f64);
        let at = Instant::at(0.4);
        let [mut hand, mut in_lanes] = [(); 2].map(|()| ByHand::default());
        by_hand(&four_bar, 0.4, &q, &w, &mut hand);
        by_hand_in_lanes(&four_bar, 0.4, &q, &w, &mut in_lanes);
        let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13);
        assert!(close(four_bar.constraints_dense(&at, &q).unwrap().as_slice(), &hand.phi));
        assert!(close(four_bar.time_derivative_dense(&at, &q).unwrap().as_slice(), &hand.phi_t));
        assert!(close(four_bar.gamma_dense(&at, &q, &w).unwrap().as_slice(), &hand.gamma));
        assert!(close(&in_lanes.phi, &hand.phi) && close(in_lanes.phi_q.as_flattened(), hand.phi_q.as_flattened()));
        assert!(close(&in_lanes.phi_t, &hand.phi_t) && close(&in_lanes.gamma, &hand.gamma));
        let jacobian = four_bar.jacobian_dense(&at, &q).unwrap();
        for (row, entries) in hand.phi_q.iter().enumerate() {
            let row: Vec<f64> = jacobian.row(row).iter().copied().collect();
            assert!(close(&row, entries));
        }
    }
}
