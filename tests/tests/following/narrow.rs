//! Known functions with a peak, a pole or a gap much narrower than a step, between places at which nothing shows it.

use crate::hidden::ends_at;
use kin_runtime::function::{FromFn, MotionLaw, Sequence};
use kin_runtime::{Instant, Kinematics, Options, PlanError, Refusal, SolveError, mechanism};

/// A rod of length 0.7 couples a slider to an arm of length 0.2: it closes for 0.5 ≤ x ≤ 0.9. The slider is driven.
macro_rules! driven {
    ($($name:ident: ($($x:tt)*)),* $(,)?) => { $(
        #[mechanism]
        #[body(arm, x = 0, y = 0)]
        #[body(slider, y = 0, phi = 0)]
        #[driver(push: slider.x = $($x)*)]
        #[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
        #[guess(arm.phi = 1, slider.x = 0.8)]
        struct $name { c: f64, w: f64 }
    )* };
}
driven!(
    Gauss: (0.8 + 0.15 * exp(-pow((t - c) / w, 2))),
    Lorentz: (0.8 + 0.15 / (1 + pow((t - c) / w, 2))),
    Pole: (0.8 + 0.001 * w / pow(t - c, 2)),
    OnAWave: (0.8 + 0.02 * sin(t) + 0.15 * exp(-pow((t - c) / w, 2))),
    Gap: (0.8 + 0.001 * sqrt(pow(t - c, 2) - w * w)),
);

/// The peak is a function of an angle; a scalar coordinate takes it to the slider.
#[mechanism]
#[coordinates(s)]
#[body(crank, x = 0, y = 0)]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[driver(drive: crank.phi = t)]
#[constraint(peak: s = 0.8 + 0.15 * exp(-pow((crank.phi - c) / w, 2)))]
#[constraint(push: slider.x = s)]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[guess(arm.phi = 1, slider.x = 0.8, s = 0.8)]
struct OfAngle {
    c: f64,
    w: f64,
}

/// The peak is on the outline of a cam.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[driver(drive: cam.phi = -t)]
#[on_curve(contact: cam @ (0, 0), slider @ (0, 0), polar(theta) = 0.8 + 0.15 * exp(-pow((theta - c) / w, 2)))]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[guess(arm.phi = 1, slider.x = 0.8)]
struct OnACam {
    c: f64,
    w: f64,
}

/// The slider is told to rise and to return, between two dwells.
#[mechanism]
#[function(lift)]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[driver(push: slider.x = 0.8 + lift(t))]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[guess(arm.phi = 1, slider.x = 0.8)]
struct Told {
    lift: Sequence,
}

/// Places and widths of a peak, and grids of instants that do not show it.
fn everywhere(mut check: impl FnMut(f64, f64, &[f64])) {
    for (c, w) in [(1.1, 0.03), (2.903, 0.004), (1.733, 0.0006), (0.611, 1e-4)] {
        for count in [1_u32, 2, 7] {
            let times: Vec<f64> = (0..=count).map(|k| 3.1 * f64::from(k) / f64::from(count)).collect();
            assert!(times.iter().all(|t| (t - c).abs() > 3.0 * w), "the grid shows the peak");
            check(c, w, &times);
        }
    }
}

#[test]
fn a_peak_is_found_however_narrow_it_is() {
    everywhere(|c, w, times| {
        let first = |w: f64| c - w * 1.5_f64.ln().sqrt();
        ends_at(&Gauss { c, w }, times, first(w));
        ends_at(&Lorentz { c, w }, times, c - w * 0.5_f64.sqrt());
        ends_at(&Pole { c, w }, times, c - (0.01 * w).sqrt());
        // On flanks that are steeper, the Jacobian of all rows counts as singular somewhat earlier.
        let w = w.max(6e-4);
        ends_at(&OfAngle { c, w }, times, first(w));
        ends_at(&OnACam { c, w }, times, first(w));
    });
}

/// A rise by half of 1 − cos πτ has passed two thirds of its height where cos πτ = −1/3.
#[test]
fn a_rise_and_return_between_two_instants_is_found() {
    everywhere(|c, w, times| {
        let rest = Sequence::starting_at(0.0, 0.0).dwell(c - w);
        let moved = rest.rise(MotionLaw::Harmonic, 0.15, w).fall(MotionLaw::Cycloidal, 0.15, w);
        let lift = moved.dwell(5.0).build().expect("a sequence");
        ends_at(&Told { lift: lift.clone() }, times, c - w + w * (-1.0_f64 / 3.0).acos() / std::f64::consts::PI);
        // A smaller rise is followed.
        let lift = Sequence::starting_at(0.0, 0.0).dwell(c - w).rise(MotionLaw::Harmonic, 0.09, w);
        let lift = lift.fall(MotionLaw::Cycloidal, 0.09, w).dwell(5.0).build().expect("a sequence");
        let told = Told { lift };
        assert_eq!(times.len(), told.solver().sweep(times).expect("it closes everywhere").states.len());
    });
}

#[test]
fn a_peak_is_found_on_a_motion() {
    everywhere(|c, w, times| {
        let x = |t: f64| 0.02 * t.sin() + 0.15 * (-((t - c) / w).powi(2)).exp();
        let (mut before, mut after) = (c - 5.0 * w, c);
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            if x(middle) < 0.1 { before = middle } else { after = middle }
        }
        ends_at(&OnAWave { c, w }, times, before);
    });
}

/// A scalar coordinate that has no value in a gap of angles.
#[mechanism]
#[coordinates(s)]
#[body(crank, x = 0, y = 0)]
#[driver(drive: crank.phi = t)]
#[constraint(wave: s = 0.001 * sqrt(pow(crank.phi - c, 2) - w * w))]
struct GapOfAngle {
    c: f64,
    w: f64,
}

/// A gap beside a function without an enclosure.
#[mechanism]
#[coordinates(s, u)]
#[function(f)]
#[driver(drive: u = f(t))]
#[driver(wave: s = 0.001 * sqrt(pow(t - c, 2) - w * w))]
struct GapBesideAFunction {
    c: f64,
    w: f64,
    f: FromFn<fn(f64) -> [f64; 3]>,
}

/// Beyond a gap in which a row has no value, the mechanism is not reached.
fn ends_at_gap<M: Kinematics>(mechanism: &M, times: &[f64], start: f64) {
    for use_plan in [true, false] {
        let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
        match solver.sweep(times).expect_err("a gap").source {
            SolveError::StepRefused { t, reason: Refusal::Undefined, .. } => {
                assert!((t - start).abs() < 1e-9, "{t} instead of {start}");
            }
            error => panic!("{error}"),
        }
    }
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).expect("it closes");
    let error = times[1..].iter().find_map(|&t| planned.at(&Instant::at(t)).err()).expect("a gap");
    assert!(matches!(error, PlanError::NonFinite { .. }), "{error}");
}

#[test]
fn a_gap_ends_the_motion() {
    everywhere(|c, w, times| {
        ends_at_gap(&Gap { c, w }, times, c - w);
        ends_at_gap(&GapOfAngle { c, w }, times, c - w);
    });
    // In the middle of the only step.
    let (c, w, f) = (1.0, 0.01, FromFn((|x| [x, 1.0, 0.0]) as fn(f64) -> [f64; 3]));
    ends_at_gap(&GapBesideAFunction { c, w, f }, &[0.0, 2.0], c - w);
    // So short a step is not divided before.
    ends_at_gap(&GapBesideAFunction { c: 0.05, w: 0.001, f }, &[0.0, 0.1], 0.049);
}

/// Peaks that the mechanism can follow are followed.
#[test]
fn what_hides_in_a_step_is_followed() {
    everywhere(|c, w, times| {
        let shallow = Shallow { c, w };
        let at = *times.last().expect("times");
        let x = |t: f64| 0.7 + 0.15 / (1.0 + ((t - c) / w).powi(2));
        let states = shallow.solver().sweep(times).expect("it closes everywhere").states;
        assert!((states.last().expect("states")[Shallow::slider].x - x(at)).abs() < 1e-12);
        let mut planned = shallow.solver().planned(&Instant::at(0.0)).expect("it closes");
        for &t in times {
            // The angle of the arm and the place of the slider; all other coordinates are held.
            let q = planned.at(&Instant::at(t)).expect("it closes everywhere").q();
            assert!(q[0] > 0.0 && (q[1] - x(t)).abs() < 1e-12, "{q:?}");
        }
    });
}
driven!(Shallow: (0.7 + 0.15 / (1 + pow((t - c) / w, 2))));
