//! Families of parts: a scissor lift with twenty stages and a chain of thirty links, each in a dozen lines.

#![allow(unreachable_pub, reason = "public as in a library of a user")]

use kin_runtime::{Instant, Kinematics, Mechanism, mechanism};

/// A scissor lift with twenty stages.
#[mechanism]
#[bodies(left[20], right[20])]
#[revolute(middle[i in 0..20]: left[i] @ (0, 0), right[i] @ (0, 0))]
#[revolute(near[i in 0..19]: left[i] @ (l/2, 0), right[i + 1] @ (-l/2, 0))]
#[revolute(far[i in 0..19]: right[i] @ (l/2, 0), left[i + 1] @ (-l/2, 0))]
#[revolute(foot: ground @ (0, 0), left[0] @ (-l/2, 0))]
#[y(slide: right[0] @ (-l/2, 0) = 0)]
#[driver(pull: right[0].phi = pi - 0.5 - 0.2 * sin(t))]
#[define(height = left[19].y + l/2 * sin(left[19].phi))]
#[guess(left[i in 0..20].phi = 0.5, right[i in 0..20].phi = pi - 0.5)]
pub struct ScissorLift {
    /// Length of a bar.
    #[param(1.5)]
    pub l: f64,
}

#[test]
fn the_lift_is_as_high_as_its_bars_make_it() {
    let lift = ScissorLift::default();
    let times: Vec<f64> = (0..6).map(|k| 0.3 * f64::from(k)).collect();
    let sweep = lift.kinematic_analysis(&times).expect("the lift moves");
    for state in &sweep {
        // n stages of bars of length l at the angle θ: h = n l sin θ.
        let (theta, rate) = (0.5 + 0.2 * state.t.sin(), 0.2 * state.t.cos());
        let motion = lift.solver().motion(state).expect("the same lift");
        let height = motion[ScissorLift::height];
        assert!((height.value - 20.0 * 1.5 * theta.sin()).abs() < 1e-11, "{} at t = {}", height.value, state.t);
        assert!((height.rate - 20.0 * 1.5 * theta.cos() * rate).abs() < 1e-11);
    }
    let mobility = lift.mobility(&Instant::at(0.0), &sweep.states[0].q).expect("finite");
    assert_eq!((mobility.coordinates, mobility.degrees_of_freedom), (120, 1));
}

/// A chain of thirty links; the angle of each relative to the one before is driven.
#[mechanism]
#[bodies(link[30])]
#[revolute(root: ground @ (0, 0), link[0] @ (0, 0))]
#[revolute(pin[i in 0..29]: link[i] @ (l[i], 0), link[i + 1] @ (0, 0))]
#[driver(swing: link[0].phi = 0.4 * sin(t))]
#[driver(bend[i in 1..30]: link[i].phi - link[i - 1].phi = turn[i] * cos(t))]
#[point(end = link[29] @ (l[29], 0))]
pub struct Chain {
    /// Lengths.
    #[param(0.1)]
    pub l: [f64; 30],
    /// Bends.
    #[param(0.05)]
    pub turn: [f64; 30],
}

#[test]
fn the_chain_ends_where_its_links_lead() {
    let mut chain = Chain::default();
    (0..30).for_each(|k| {
        chain.l[k] = 0.1 + 0.01 * k as f64;
        chain.turn[k] = 0.02 * (k as f64).sin();
    });
    let t = 0.7_f64;
    let state = chain.state_at(&Instant::at(t)).expect("the chain hangs together");
    let end = chain.solver().motion(&state).expect("the same chain")[Chain::end];
    let (mut angle, mut r) = (0.4 * t.sin(), [0.0, 0.0]);
    for k in 0..30 {
        if k > 0 {
            angle += chain.turn[k] * t.cos();
        }
        let place = Chain::model().coordinate(&format!("link[{k}].phi")).expect("its name");
        assert!((state.q[place] - angle).abs() < 1e-12, "link[{k}]");
        r = [r[0] + chain.l[k] * angle.cos(), r[1] + chain.l[k] * angle.sin()];
    }
    assert!((end.r[0] - r[0]).hypot(end.r[1] - r[1]) < 1e-12);
}

/// Pendulums along a wall, each longer than the one before: indices used as values, also through a family of points.
#[mechanism]
#[bodies(bob[6])]
#[point(hook[i in 0..6] = ground @ (spacing * i, 0.1 * (i - 2)))]
#[revolute(pin[k in 1..6]: hook[k], bob[k] @ (0.5 + k/10, 0))]
#[revolute(first: hook[0], bob[0] @ (0.5, 0))]
#[driver(swing[k in 0..6]: bob[k].phi = pi/2 + k * sin(t))]
#[guess(bob[i in 0..6].x = i)]
pub struct Pendulums {
    /// Distance of the hooks.
    #[param(0.3)]
    pub spacing: f64,
}

#[test]
fn an_index_is_a_number() {
    let t = 0.4_f64;
    let pendulums = Pendulums::default();
    assert_eq!(pendulums.solver().guess()[3], Some(1.0));
    let state = pendulums.state_at(&Instant::at(t)).expect("six pendulums");
    for k in 0..6 {
        let (i, angle) = (f64::from(k), core::f64::consts::FRAC_PI_2 + f64::from(k) * t.sin());
        let length = 0.5 + i / 10.0;
        let expected = [0.3 * i - length * angle.cos(), 0.1 * (i - 2.0) - length * angle.sin(), angle];
        for (found, expected) in state.q[3 * k as usize..].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "bob[{k}]: {found} and {expected}");
        }
    }
}
