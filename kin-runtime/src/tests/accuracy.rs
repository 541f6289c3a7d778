//! Position, velocity, acceleration, motion and ratios against known numbers.

use super::agree;
use crate::fixture::{FiveBar, FourBarLoop, Parallelogram, Squeezer, StretchedSlider};
use crate::{CrossCheckOptions, Instant, Kinematics, Signal, SolveError};

const FOUR_BAR: [[f64; 3]; 3] = [
    [core::f64::consts::FRAC_PI_4, 0.914_586_521_609_3, 5.000_498_421_347_2],
    [2.3, -0.623_820_247_603_630_4, -0.121_922_453_094_630_3],
    [0.0, 1.046_663_388_800_07, 2.788_295_632_026_088_5],
];

#[test]
fn the_lecture_four_bar() {
    let mechanism = FourBarLoop::default();
    let state = mechanism.state_at(&Instant::at(0.0)).unwrap();
    agree(&state.q, &FOUR_BAR[0], 1e-12);
    agree(&state.q_dot, &FOUR_BAR[1], 1e-12);
    agree(&state.q_ddot, &FOUR_BAR[2], 1e-12);
    assert!(state.residual < 1e-15 && state.degrees_of_freedom_left == 0);
    let far = mechanism.kinematic_analysis(&[0.0, 2.6]).unwrap();
    agree(&far.states[1].q, &[6.765_398_163_397_4, 1.004_568_524_919_6, 5.041_011_781_945_8], 1e-12);
}

#[test]
fn a_partial_guess_finds_the_pins() {
    let state = StretchedSlider.state_at(&Instant::at(0.0)).unwrap();
    agree(&state.q[2..6], &[1.242_312_074_011_6, 0.4121, 0.108_851_228_748_2, -0.311_643_285_263_6], 1e-12);
    agree(&state.q_dot[2..4], &[-1.655_593_008_969_684, 0.380_213_333_333_333_35], 1e-12);
}

#[test]
fn redundant_but_consistent_rows_solve() {
    let state = Parallelogram { length: 0.27 }.state_at(&Instant::at(1.6)).unwrap();
    agree(&state.q[3..6], &[0.085_896_520_944_2, 0.122_869_156_519_3, 0.0], 1e-12);
    agree(&state.q_dot[3..6], &[-0.154_298_689_040_834_57, -0.247_431_757_380_251_9, 0.0], 1e-12);
    agree(&state.q_ddot[3..6], &[0.295_800_129_274_530_3, -0.120_821_888_352_943_58, 0.0], 1e-12);
}

#[test]
fn under_driven_answers_have_the_least_norm() {
    let q = [
        0.0,
        0.0,
        1.2,
        0.377_897_074_600_8,
        0.023_862_492_969_4,
        2.5,
        0.159_980_880_847_3,
        0.238_773_045_841_5,
        0.736_634_777_036_5,
        0.293_869_558_076_2,
        0.247_306_247_068_9,
        1.640_998_630_009,
    ];
    let at = Instant::at(0.0);
    let q_dot = FiveBar.velocity_analysis(&at, &q).unwrap();
    agree(
        &q_dot[2..9],
        &[
            0.6,
            0.000_152_166_497_798,
            0.000_203_697_397_495,
            -0.002_825_091_996_298,
            -0.100_019_922_465_347,
            0.023_722_155_340_185,
            -0.225_813_352_791_82,
        ],
        1e-10,
    );
    let q_ddot = FiveBar.acceleration_analysis(&at, &q, &q_dot).unwrap();
    agree(&q_ddot[3..6], &[-0.011_148_558_369_486, -0.014_925_197_022_621, 0.206_992_532_627_754], 1e-10);
}

#[test]
fn a_prescribed_coordinate_completes_the_system() {
    let given = Signal { value: 2.5, rate: 0.3, acceleration: -0.7 };
    let solver = FiveBar.solver();
    let state = solver.clone().with_given(5, given).state(&Instant::at(0.0)).unwrap();
    assert_eq!(state.degrees_of_freedom_left, 0);
    for (found, expected) in [(state.q[5], 2.5), (state.q_dot[5], 0.3), (state.q_ddot[5], -0.7)] {
        assert!((found - expected).abs() < 1e-12);
    }
    let sweep = solver.with_given(5, given).sweep(&[0.0, 0.2]).unwrap();
    let expected = 2.5 + 0.2 * 0.3 - 0.5 * 0.7 * 0.04;
    assert!((sweep.states[1].q[5] - expected).abs() < 1e-12);
    assert!((sweep.states[1].q_dot[5] - (0.3 - 0.7 * 0.2)).abs() < 1e-12);
}

#[test]
fn velocity_ratios_give_back_velocity_and_acceleration() {
    let mechanism = Squeezer;
    let state = mechanism.kinematic_analysis(&[0.0, 0.02]).unwrap().states.remove(1);
    let ratios = mechanism.solver().velocity_ratios(&state).unwrap();
    assert_eq!(ratios.drivers.len(), 1);
    let drive = &ratios.drivers[0];
    assert_eq!((drive.name, drive.joint, drive.row), ("drive", Some("drive"), Some(20)));
    assert!((drive.first[2] - 1.0).abs() < 1e-12);
    agree(&drive.q_dot, &state.q_dot, 1e-11);
    agree(&drive.q_ddot, &state.q_ddot, 1e-10);
}

#[test]
fn motion_repeats_the_poses() {
    let state = Squeezer.state_at(&Instant::at(0.0)).unwrap();
    let motion = Squeezer.solver().motion(&state).unwrap();
    for (k, body) in motion.bodies.iter().enumerate() {
        agree(&[body.x, body.y, body.phi], &state.q[3 * k..3 * k + 3], 0.0);
        agree(&[body.x_dot, body.y_dot, body.phi_dot], &state.q_dot[3 * k..3 * k + 3], 0.0);
        agree(&[body.x_ddot, body.y_ddot, body.phi_ddot], &state.q_ddot[3 * k..3 * k + 3], 0.0);
    }
}

#[test]
fn the_transmission_angle_of_a_slider_crank() {
    let at = Instant::at(0.0);
    let q = StretchedSlider.state_at(&at).unwrap().q;
    let angles = StretchedSlider.solver().transmission_angles(&at, &q).unwrap();
    let crank = angles.iter().find(|a| a.joint == "A").unwrap();
    assert_eq!(crank.between, ["O", "B"]);
    let (r, l, x) = (0.23_f64, 0.71_f64, 0.75_f64);
    let expected = ((r * r + l * l - x * x) / (2.0 * r * l)).acos();
    assert!((crank.angle - expected).abs() < 1e-12 && crank.deviation() > 0.0);
    assert_eq!(angles.len(), 1, "{angles:?}");
}

#[test]
fn the_cross_check_passes_and_names_a_planted_error() {
    let good = FourBarLoop::default().cross_check().unwrap();
    assert!(good.passes(1e-13) && good.configurations == 32 && good.skipped == 0, "{good}");
    assert!(Squeezer.cross_check().unwrap().passes(1e-12));
    let bad = FourBarLoop { wrong: 1e-3 }.solver().cross_check(&CrossCheckOptions::default()).unwrap();
    assert!(!bad.passes(1e-4) && bad.passes(1.1e-3));
    assert_eq!((bad.worst.matrix, bad.worst.row_name, bad.worst.column_name), ("Φ_q", "close_y", "phi2"));
    let nan = FourBarLoop { wrong: f64::NAN }.cross_check().unwrap();
    assert!(!nan.passes(1e300) && nan.worst.column_name == "phi2");
    let options = CrossCheckOptions { configurations: 0, ..CrossCheckOptions::default() };
    let nothing = FourBarLoop::default().solver().cross_check(&options);
    assert_eq!(nothing, Err(SolveError::NothingCompared { skipped: 0 }));
    assert_eq!(nothing.unwrap_err().to_string(), "nothing was compared: there are no configurations");
}
