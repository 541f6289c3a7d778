//! Tests of the checks of a step by full Newton: its corrections, and the velocity at its end.

use super::*;
use crate::Kinematics;
use crate::equations::system::Evaluator;
use crate::fixture::{FourBarLoop, StretchedSlider};
use crate::mechanism::Mechanism;
use crate::options::Options;
use crate::signal::Instant;

/// The equations of a mechanism at an instant, without a scale.
fn equations<M: Mechanism>(mechanism: &M, t: f64) -> Equations<'_> {
    let system = Box::new(Evaluator::<_, M>::new(mechanism));
    Equations::new(system, Options::default(), &[], None, &Instant::at(t)).unwrap()
}

/// Whether the velocity `new` is accepted after a step h from a velocity `old` with an acceleration; only the first
/// coordinate moves.
fn is_expected([old, acceleration, new]: [f64; 3], h: f64) -> bool {
    let mechanism = FourBarLoop::default();
    let state = mechanism.state_at(&Instant::at(0.0)).unwrap();
    let mut equations = equations(&mechanism, 0.0);
    equations.evaluate(Subset::VELOCITY, &state.q, None).unwrap();
    let factor = equations.factorise(Purpose::Rank, None);
    let orientation = Orientation::here(&equations, &factor).unwrap();
    let basis = Basis { orientation, factor, groups: Vec::new(), turns: Vec::new() };
    let node = Node { s: 0.0, state, basis: None };
    let (q_dot, q_ddot) = ([old, 0.1, 0.0], [acceleration, 0.0, 0.0]);
    let start = StepStart { node: &node, basis: &basis, s: 0.0, q_dot: &q_dot, q_ddot: &q_ddot };
    expected(&equations, &mut Vec::new(), &start, h, &[new, 0.1, 0.0])
}

#[test]
fn a_velocity_may_differ_from_its_prediction_by_half_of_the_larger_one() {
    for side in [1.0, -1.0] {
        let of = |numbers: [f64; 3], h: f64| is_expected(numbers.map(|x| side * x), h);
        assert!(of([1.0, 0.0, 1.99], 0.1) && !of([1.0, 0.0, 2.01], 0.1));
        assert!(of([1.0, 0.0, 0.51], 0.1) && !of([1.0, 0.0, 0.49], 0.1));
        // The prediction includes the acceleration, forwards and backwards in time, but a large acceleration does not
        // widen the tolerance.
        assert!(of([1.0, 20.0, 3.0], 0.1) && !of([1.0, 20.0, 3.0], -0.1));
        assert!(!of([1.0, 20.0, -1.0], 0.1) && of([1.0, 20.0, -1.0], -0.1));
        assert!(!of([1.0, 2000.0, 1.0], 0.1));
    }
}

#[test]
fn a_velocity_that_jumps_in_no_time_is_that_of_the_driver() {
    for h in [1.1e-7, -1.1e-7] {
        assert!(is_expected([0.9, 0.0, -0.9], h) && !is_expected([0.9, 0.0, -0.9], 1.02 * h), "{h}");
    }
}

/// The result of Newton's corrections from a q to Φ = 0, no farther than `allowed`.
fn corrected<M: Mechanism>(
    mechanism: &M,
    t: f64,
    from: &[f64],
    allowed: f64,
    last_step: f64,
) -> Result<(Corrected, Vec<f64>), Fault> {
    let mut equations = equations(mechanism, t);
    let mut scratch = StepBuffers::new(&equations);
    scratch.predicted = from.to_vec();
    let mut q = Vec::new();
    let found = correct(&mut equations, &mut scratch, &mut q, allowed, last_step)?;
    Ok((found, q))
}

#[test]
fn a_correction_is_as_long_as_it_is_and_no_longer_than_allowed() {
    let mechanism = FourBarLoop::default();
    let q = mechanism.state_at(&Instant::at(0.3)).unwrap().q;
    // The row of the driver has the largest residual.
    let from = [q[0] + 0.02, q[1], q[2]];
    let (found, closed) = corrected(&mechanism, 0.3, &from, 1.0, 1e-9).unwrap();
    closed.iter().zip(&q).for_each(|(a, b)| assert!((a - b).abs() < 1e-14, "{closed:?}"));
    assert!((found.correction - 0.02).abs() < 1e-3 && found.worst == 2, "{} {}", found.correction, found.worst);
    assert!((2..=4).contains(&found.iterations));
    assert!(corrected(&mechanism, 0.3, &from, 1.001 * found.correction, 1e-9).is_ok());
    let refused = corrected(&mechanism, 0.3, &from, 0.999 * found.correction, 1e-9);
    assert!(matches!(refused, Err(Fault::Open(2))));
    // A position that already satisfies Φ = 0 needs a single iteration.
    let (none, _) = corrected(&mechanism, 0.3, &q, 1e-12, 1e-9).unwrap();
    assert_eq!(1, none.iterations);
}

/// In the stretched position two solutions coincide: each correction is half as long as the one before, so Newton's
/// iteration converges only linearly.
#[test]
fn corrections_that_do_not_contract_lead_nowhere() {
    let at = |phi: f64| {
        let (sin, cos) = f64::sin_cos(phi);
        [0.0, 0.0, phi, 0.23 * cos + 0.355, 0.23 * sin, 0.0, 0.94, 0.0, 0.0]
    };
    // The fourth correction would be shorter than `last_step`.
    assert!(matches!(corrected(&StretchedSlider, 0.475, &at(0.1), 10.0, 1e-2), Err(Fault::Open(_))));
}
