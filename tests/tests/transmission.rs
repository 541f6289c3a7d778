//! Transmission angles against the law of cosines, and which joints have one.

use kin_runtime::{Instant, Kinematics};
use kin_tests::mechanisms::*;

/// cos μ = (l2² + l3² − d²)/(2 l2 l3), d the distance from the crank's end to the rocker's pivot.
#[test]
fn the_four_bar_has_one_at_the_joint_of_coupler_and_rocker() {
    let four_bar = FourbarLectureMid::default();
    let solver = four_bar.solver();
    for state in solver.sweep(&[0.0, 0.5, 1.0, 1.5, 2.0, 2.5]).unwrap().iter() {
        let angles = solver.transmission_angles(&state.instant(), &state.q).unwrap();
        let [angle] = angles.as_slice() else { panic!("{angles:?}") };
        assert_eq!((angle.joint, angle.between), ("B", ["A", "D"]));
        let (l1, l2, l3, d1, d2) = (0.1_f64, 0.4_f64, 0.3_f64, 0.4_f64, 0.1_f64);
        let phi = state.q[2];
        let d = (d1 - l1 * phi.cos()).hypot(d2 - l1 * phi.sin());
        let expected = ((l2 * l2 + l3 * l3 - d * d) / (2.0 * l2 * l3)).acos();
        assert!((angle.angle - expected).abs() < 1e-12, "{} and {expected}", angle.angle);
        assert!((angle.deviation() - (expected - std::f64::consts::FRAC_PI_2).abs()).abs() < 1e-12);
    }
}

/// The pins of a driven crank transmit from the drive, not to an output.
#[test]
fn driven_bodies_have_none() {
    let squeezer = AndrewsPins::default();
    let solver = squeezer.solver();
    let state = solver.state(&Instant::at(0.0)).unwrap();
    let angles = solver.transmission_angles(&state.instant(), &state.q).unwrap();
    let crank: Vec<&str> =
        ["O", "F"].into_iter().filter(|joint| angles.iter().any(|angle| angle.joint == *joint)).collect();
    assert!(crank.is_empty(), "{angles:?}");
    assert!(!angles.is_empty());
}
