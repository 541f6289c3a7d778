//! The ranges of inputs that turn bodies, or that move nothing but sliders: closed forms.

use kin_runtime::{Instant, Kinematics, PlanError, Planned, Signal, SolveError, mechanism};

/// A slider on a line, 0.5 beside the fixed end of its rod, whose length is the input.
#[mechanism]
#[body(slider, y = 0, phi = 0)]
#[input(u)]
#[distance(rod: ground @ (0, 0.5), slider @ (0, 0), length = u)]
#[guess(slider.x = 1)]
struct Slide;

/// A boom on a screw jack: `lead` is the way of its nut per radian.
#[mechanism]
#[bodies(motor, boom)]
#[input(theta)]
#[revolute(M: ground @ (5, 0), motor @ (0, 0))]
#[driver(drive: motor.phi = theta)]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[distance(ram: ground @ (0.6, 0), boom @ (1, 0), length = 0.8 + lead * theta)]
#[guess(boom.phi = 0.7)]
struct Jack {
    #[param(0.001)]
    lead: f64,
}

/// A crank-rocker behind a gear, and a rack on the crank's shaft.
#[mechanism]
#[bodies(pinion, crank, coupler, rocker, rack)]
#[input(u)]
#[revolute(P: ground @ (-1, 0), pinion @ (0, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[gear(mesh: pinion, crank, radii = (r, 0.7))]
#[driver(drive: pinion.phi = u)]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[translational(guide: ground @ (0, 2), rack @ (0, 0), axis = (1, 0))]
#[rack_pinion(teeth: ground @ (0, 2), rack @ (0, 0), axis = (1, 0), pinion = crank, radius = 0.2)]
#[guess(coupler.phi = 0.9, rocker.phi = 2)]
struct Geared {
    #[param(0.3)]
    r: f64,
    #[param(0.4)]
    d: f64,
}

fn planned<M: Kinematics>(mechanism: &M, u: f64) -> Planned<'_, M> {
    mechanism.solver().planned(&Instant { t: 0.0, inputs: &[Signal::constant(u)] }).expect("it closes")
}

#[test]
fn a_slider_reaches_the_place_nearest_to_the_end_of_its_rod() {
    for u in [0.6, 1.2, 40.0] {
        let range = planned(&Slide, u).range_of(Slide::u).expect("it is found");
        assert!((range.least - 0.5).abs() < 1e-12 && range.greatest == f64::INFINITY, "{range}");
        assert!(!range.contains(-7.0));
    }
    let refused = Slide.solver().out_of_range(&Instant { t: 0.0, inputs: &[Signal::constant(0.3)] });
    assert_eq!(0.3, refused.expect("the input is the cause").value);
}

/// The boom ends where foot and both ends of the ram are on one line: at lengths of 0.4 and 1.6.
#[test]
fn the_motor_of_a_jack_turns_hundreds_of_times_up_to_its_limits() {
    for lead in [0.001, -0.002, 0.05] {
        let jack = Jack { lead };
        let mut expected = [(0.4 - 0.8) / lead, (1.6 - 0.8) / lead];
        expected.sort_by(f64::total_cmp);
        let range = planned(&jack, 0.0).range_of(Jack::theta).expect("it is found");
        let is_near = |found: f64, expected: f64| (found - expected).abs() < 1e-10 * expected.abs();
        assert!(is_near(range.least, expected[0]) && is_near(range.greatest, expected[1]), "{range}: {expected:?}");
    }
    // So many turns are not followed, and nothing is claimed.
    let slow = Jack { lead: 1e-7 };
    let refused = planned(&slow, 0.0).range_of(Jack::theta);
    assert!(matches!(refused, Err(PlanError::TooManySteps { .. })), "{refused:?}");
    let refused = slow.solver().range_of(&Instant { t: 0.0, inputs: &[Signal::constant(0.0)] }, Jack::theta);
    assert!(matches!(refused, Err(SolveError::Plan(PlanError::TooManySteps { .. }))), "{refused:?}");
}

/// With radii of 0.3 and 0.7, the motion repeats after seven turns of the pinion; the rack moves on.
#[test]
fn a_motion_that_repeats_after_some_turns_has_no_limits() {
    for r in [0.3, 0.7, 1.4, -0.3] {
        let geared = Geared { r, ..Geared::default() };
        let range = planned(&geared, 0.2).range_of(Geared::u).expect("it is found");
        assert_eq!([f64::NEG_INFINITY, f64::INFINITY], [range.least, range.greatest], "{r}");
    }
    // With a frame of 0.75 the crank reaches as far as coupler and rocker in line: 0.7 from the pivot of the rocker.
    let (d, reach) = (0.75, 0.7);
    let geared = Geared { d, ..Geared::default() };
    let at = |crank: f64| -0.7 / 0.3 * crank;
    let crank = ((d * d + 0.01 - reach * reach) / (2.0 * d * 0.1_f64)).acos();
    let range = planned(&geared, 0.0).range_of(Geared::u).expect("it is found");
    let expected = [at(crank), at(-crank)];
    assert!((range.least - expected[0]).abs() < 1e-9 && (range.greatest - expected[1]).abs() < 1e-9, "{range}");
}
