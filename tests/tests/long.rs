//! Mechanisms whose kernels are longer than one block of generated code.

use kin_runtime::{Instant, Kinematics, Mechanism, Subset, mechanism};
use kin_tests::works;

/// A chain of forty links, every one driven against the one before, its end tied to a slider.
#[mechanism]
#[bodies(link[40], slider)]
#[revolute(root: ground @ (0, 0), link[0] @ (-l[0]/2, 0.01))]
#[revolute(pin[i in 0..39]: link[i] @ (l[i]/2, 0.01), link[i + 1] @ (-l[i + 1]/2, 0.01))]
#[driver(first: link[0].phi = 0.2*sin(t))]
#[relative_angle(bend[i in 0..39]: link[i], link[i + 1] = 0.1*t + 0.05*cos(2*t))]
#[revolute(end: link[39] @ (l[39]/2, 0), slider @ (0, 0))]
#[relative_angle(level: link[39], slider = 0.3)]
#[point(joint[i in 0..40] = link[i] @ (l[i]/2, 0.01))]
struct Chain {
    #[param(0.1)]
    l: [f64; 40],
}

#[test]
fn a_long_chain_closes_and_agrees_with_dual_numbers() {
    let chain = Chain::default();
    let operations = Chain::model().operations;
    assert!(operations.add + operations.mul > 900, "no longer than one block: {operations:?}");
    works(&chain);
    let state = chain.state_at(&Instant::at(0.7)).unwrap();
    assert!(state.residual < 1e-12, "{}", state.residual);
    let motion = chain.solver().motion(&state).unwrap();
    // The same chain by summing links.
    let (mut x, mut y, mut phi) = (0.0, 0.0, 0.2 * 0.7_f64.sin());
    for k in 0..40 {
        (x, y) = (x + 0.1 * phi.cos(), y + 0.1 * phi.sin());
        let [found_x, found_y] = motion[Chain::joint[k]].r;
        assert!((found_x - x).abs() < 1e-12 && (found_y - y).abs() < 1e-12, "joint[{k}]");
        phi += 0.07 + 0.05 * 1.4_f64.cos();
    }
}

#[test]
fn every_subset_of_a_long_kernel_agrees_with_the_whole() {
    let chain = Chain::default();
    let n = Chain::COORDINATES;
    let q: Vec<f64> = (0..n).map(|k| (k as f64 * 0.7).sin()).collect();
    let w: Vec<f64> = (0..n).map(|k| (k as f64 * 1.3).cos()).collect();
    let evaluate = |subset| {
        let mut workspace = Chain::workspace::<f64>();
        chain.evaluate(subset, &Instant::at(0.4), &q, &w, &mut workspace).unwrap();
        workspace
    };
    let whole = evaluate(Subset::ALL);
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(close(evaluate(Subset::PHI).phi(), whole.phi()));
    assert!(close(evaluate(Subset::POSITION).phi_q(), whole.phi_q()));
    assert!(close(evaluate(Subset::VELOCITY).phi_t(), whole.phi_t()));
    assert!(close(evaluate(Subset::GAMMA).gamma(), whole.gamma()));
}
