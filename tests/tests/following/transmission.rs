//! Transmission angles compared with the law of cosines, and which joints have one.

use kin_runtime::{Instant, Kinematics, Measure, Mechanism, mechanism};
use kin_tests::mechanisms::*;

/// cos μ = (l2² + l3² − d²)/(2 l2 l3), d the distance from the end of the crank to the rocker's pivot.
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

/// The joints of a driven crank have no transmission angle.
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

/// Two four-bars in series on a bell crank: each has the angle at the end of its coupler, and the joints of the other
/// do not enter.
#[mechanism]
#[bodies(crank, coupler, bell, rod, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), bell @ (0.3, 0))]
#[revolute(D: ground @ (0.4, 0), bell @ (0, 0))]
#[revolute(E: bell @ (0, 0.3), rod @ (0, 0))]
#[revolute(F: rod @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(G: ground @ (0.8, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[guess(crank.phi = 0, bell.phi = 2, rocker.phi = 2)]
struct TwoInARow;

#[test]
fn joints_of_another_group_have_nothing_to_do_with_it() {
    let mechanism = TwoInARow;
    let state = mechanism.state_at(&Instant::at(0.3)).unwrap();
    let angles = mechanism.solver().transmission_angles(&state.instant(), &state.q).unwrap();
    let found: Vec<_> = angles.iter().map(|angle| (angle.joint, angle.between)).collect();
    assert_eq!(found, [("B", ["A", "D"]), ("F", ["E", "G"])]);
}

/// A slider on a guide that is inclined by 30° and lies e beside the crank's pivot.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(Q: crank @ (r, 0), rod @ (0, 0))]
#[revolute(R: rod @ (l, 0), slider @ (0, 0))]
#[translational(rail: slider @ (0, 0), ground @ (-e*sin(0.5235987755982988), e*cos(0.5235987755982988)),
    axis = (cos(0.2), sin(0.2)), angle = -0.3235987755982988)]
#[driver(drive: crank.phi = t)]
#[guess(rod.phi = 0.4, slider.x = 0.3, slider.phi = 0.3235987755982988)]
struct Guided {
    #[param(0.1)]
    r: f64,
    #[param(0.3)]
    l: f64,
    #[param(0.04)]
    e: f64,
}

/// cos μ = (r sin(φ − α) − e)/l, where α is the inclination of the guide.
#[test]
fn a_slider_has_one_at_its_pin_to_the_normal_of_its_guide() {
    let guided = Guided::default();
    let solver = guided.solver();
    let measures = Measure::transmission_angles(Guided::model());
    for state in solver.sweep(&[0.0, 0.7, 2.0, 4.0, 6.0]).unwrap().iter() {
        let angles = solver.transmission_angles(&state.instant(), &state.q).unwrap();
        let [angle] = angles.as_slice() else { panic!("{angles:?}") };
        assert_eq!((angle.joint, angle.between), ("R", ["Q", "rail"]));
        let cosine = (0.1 * (state.q[2] - std::f64::consts::FRAC_PI_6).sin() - 0.04) / 0.3;
        assert!((angle.angle - cosine.acos()).abs() < 1e-12, "{} and {}", angle.angle, cosine.acos());
        // ∂μ/∂e = 1/(l sin μ).
        let rates = solver.measure_sensitivities(state, &measures, &[2]).unwrap();
        let expected = 1.0 / (0.3 * angle.angle.sin());
        assert!((rates[0][0] - expected).abs() < 1e-10, "{rates:?} and {expected}");
    }
}

/// With the slider driven, the crank is the output: its pin has the angle, and the slider's has none.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(Q: crank @ (0.1, 0), rod @ (0, 0))]
#[revolute(R: rod @ (0.3, 0), slider @ (0, 0))]
#[translational(rail: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: slider.x = 0.3 + 0.05*sin(t))]
#[guess(crank.phi = 1.5, slider.x = 0.3)]
struct PushedSlider;

#[test]
fn a_driven_slider_has_none() {
    let state = PushedSlider.state_at(&Instant::at(0.3)).unwrap();
    let angles = PushedSlider.solver().transmission_angles(&state.instant(), &state.q).unwrap();
    let found: Vec<_> = angles.iter().map(|angle| (angle.joint, angle.between)).collect();
    assert_eq!(found, [("Q", ["O", "R"])]);
}
