//! Motions that pass a dead centre and return between two places at which positions, velocities and accelerations show
//! nothing of it.

use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, SolveError, mechanism};
use kin_tests::mechanisms::{
    Excavator, FourbarLectureAngles, FourbarLectureMid, GearedFivebar, KlannLeg, Peaucellier, QuickReturn, ScotchYoke,
    SliderCrankInline, WattSixbar,
};
use std::f64::consts::PI;

/// A rod of length 0.7 couples a slider to an arm of length 0.2: it closes for 0.5 ≤ x ≤ 0.9. The slider follows a cam
/// with the outline 0.8 − a sinⁿ(kθ), where θ is measured on the cam.
macro_rules! cams {
    ($($name:ident: $power:literal),*) => { $(
        #[mechanism]
        #[body(cam, x = 0, y = 0)]
        #[body(arm, x = 0, y = 0)]
        #[body(slider, y = 0, phi = 0)]
        #[driver(drive: cam.phi = t)]
        #[on_curve(contact: cam @ (0, 0), slider @ (0, 0), polar(theta) = 0.8 - a * pow(sin(k * theta), $power))]
        #[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
        #[guess(arm.phi = 1, slider.x = 0.8)]
        struct $name { a: f64, k: f64 }
    )* };
}
cams!(Cubed: 3, ToTheFifth: 5);

/// The same slider by a formula of an angle, with a scalar coordinate.
#[mechanism]
#[coordinates(s)]
#[body(crank, x = 0, y = 0)]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[driver(drive: crank.phi = t)]
#[constraint(wave: s = 0.8 + a * pow(sin(k * crank.phi), 3))]
#[constraint(push: slider.x = s)]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[guess(arm.phi = 1, slider.x = 0.8, s = 0.8)]
struct Wave {
    a: f64,
    k: f64,
}

/// The same slider by a formula of time.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[driver(push: slider.x = 0.8 + a * pow(sin(k * t), 3))]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[guess(arm.phi = 1, slider.x = 0.8)]
struct Driven {
    a: f64,
    k: f64,
}

/// The same with a redundant row.
#[mechanism(allow_redundant)]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[driver(push: slider.x = 0.8 + a * pow(sin(k * t), 3))]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[constraint(again: 2 * slider.x = 1.6 + 2 * a * pow(sin(k * t), 3))]
#[guess(arm.phi = 1, slider.x = 0.8)]
struct Redundant {
    a: f64,
    k: f64,
}

/// The same by two bodies that are held at angles of time: sin³ x = ¾ sin x − ¼ sin 3x.
#[mechanism]
#[body(one, x = 0.8, y = 0, phi = k * t - pi / 2)]
#[body(two, origin = one @ (0.75 * a, 0), phi = 3 * k * t + pi / 2)]
#[body(arm, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[point_on_line(push: slider @ (0, 0), two @ (0.25 * a, 0), axis = (0, 1))]
#[distance(rod: arm @ (0.2, 0), slider @ (0, 0), length = 0.7)]
#[guess(arm.phi = 1, slider.x = 0.8)]
struct Held {
    a: f64,
    k: f64,
}

/// Every way from one of these times to the next ends at the dead centre, and passes no instant beyond it.
pub(crate) fn ends_at<M: Kinematics + Sync>(mechanism: &M, times: &[f64], limit: f64) {
    let name = format!("{}, {} steps to {}", M::model().name, times.len() - 1, times.last().expect("times"));
    let sign = limit.signum();
    let last = times.iter().take_while(|t| sign * **t < sign * limit).count();
    let is = |error: &SolveError, what: &str| match error {
        SolveError::Singular { t, .. } | SolveError::StepRefused { t, .. } => {
            assert!((t - limit).abs() < 1e-5, "{name}, {what}: {error}, expected {limit}");
        }
        error => panic!("{name}, {what}: {error}"),
    };
    for use_plan in [true, false] {
        let solver = mechanism.solver().with_options(Options { use_plan, ..Options::default() });
        let error = solver.sweep(times).expect_err(&name);
        is(&error.source, "sweep");
        assert_eq!(last, error.trajectory.states.len(), "{name}, {use_plan}");
    }
    let solver = mechanism.solver();
    let mut planned = solver.planned(&Instant::at(times[0])).expect("it closes");
    let mut tracker = solver.tracker(&Instant::at(times[0])).expect("it closes");
    for (k, &t) in times.iter().enumerate().skip(1).take(last) {
        let at = Instant::at(t);
        match (planned.at(&at), tracker.update(&at)) {
            (Ok(_), Ok(_)) => assert!(k < last, "{name}: passed the limit"),
            (Err(planned), Err(tracker)) => {
                assert_eq!(k, last, "{name}: {planned}");
                let at = planned.limit().and_then(|limit| limit.at()).expect("located");
                assert!((at - limit).abs() < 1e-9, "{name}: {planned}");
                is(&tracker, "tracker");
            }
            (planned, tracker) => panic!("{name}, t = {t}: {:?} {:?}", planned.map(|_| ()), tracker.map(|_| ())),
        }
    }
    let q = solver.state(&Instant::at(times[0])).expect("it closes").q;
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let parameters = mechanism.parameters::<f64>();
    let parameters: Vec<_> = parameters.as_ref().iter().map(|p| Column::Shared(*p)).collect();
    let sweeps = Sweeps { parameters: &parameters, times, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(1, Vec::new());
    sweep(mechanism, &sweeps, &mut out, &always, |_: &mut Vec<f64>, _| ()).unwrap();
    let end = out.ends().next().flatten().expect("a limit");
    let at = end.limit.as_ref().and_then(|limit| limit.at()).expect("located");
    assert!(end.instant == last && (at - limit).abs() < 1e-9, "{name}: batch {end:?}");
}

/// The first t > 0 at which a sinⁿ(kt) is 0.1.
fn first(a: f64, k: f64, power: i32) -> f64 {
    (0.1 / a).powf(1.0 / f64::from(power)).asin() / k
}

/// Instants at which sin(kt) is 0, in steps of one, two or three of its zeros, and others.
fn grids(k: f64, sign: f64) -> Vec<Vec<f64>> {
    let steps = [1.0, 2.0, 3.0, 1.3, 0.77].map(|zeros| sign * zeros * PI / k);
    steps.iter().map(|step| (0..=3).map(|i| step * f64::from(i)).collect()).collect()
}

#[test]
fn a_lobe_of_a_cam_within_a_step_is_found() {
    let a = 0.155;
    for k in [8.0, 29.0] {
        // sinⁿ is negative first for θ > 0, where the cam has turned back.
        for times in grids(k, 1.0) {
            ends_at(&Cubed { a, k }, &times, first(a, k, 3));
            ends_at(&ToTheFifth { a, k }, &times, first(a, k, 5));
            ends_at(&Wave { a, k }, &times, first(a, k, 3));
            ends_at(&Driven { a, k }, &times, first(a, k, 3));
            ends_at(&Redundant { a, k }, &times, first(a, k, 3));
            ends_at(&Held { a, k }, &times, first(a, k, 3));
        }
        for times in grids(k, -1.0) {
            ends_at(&Cubed { a: -a, k }, &times, -first(a, k, 3));
            ends_at(&Driven { a: -a, k }, &times, -first(a, k, 3));
        }
    }
}

/// Lobes that exceed the range only at their tips, where no place within a step need be.
#[test]
fn the_tip_of_a_lobe_is_found() {
    let (a, k) = (0.103, 8.0);
    for times in grids(k, 1.0) {
        ends_at(&Cubed { a, k }, &times, first(a, k, 3));
        ends_at(&Wave { a, k }, &times, first(a, k, 3));
        ends_at(&Driven { a, k }, &times, first(a, k, 3));
    }
}

/// A driver that rests at both instants and has many lobes between them.
#[test]
fn many_lobes_within_a_step_are_found() {
    let (a, k) = (0.155, 8.0);
    for lobes in [34.0, 89.0, 144.0, 233.0, 360.0] {
        ends_at(&Driven { a, k }, &[0.0, lobes * PI / k], first(a, k, 3));
    }
}

/// Lobes that do not reach the dead centre are no limit, and every instant has the position of the closed form.
#[test]
fn lobes_that_stay_within_the_range_are_followed() {
    for k in [8.0, 60.0] {
        for times in grids(k, 1.0) {
            for use_plan in [true, false] {
                let solver = Cubed { a: 0.09, k };
                let solver = solver.solver().with_options(Options { use_plan, ..Options::default() });
                let states = solver.sweep(&times).expect("it closes everywhere").states;
                assert_eq!(times.len(), states.len());
                for state in states {
                    let x = 0.8 + 0.09 * (k * state.t).sin().powi(3);
                    assert!((state.q[2] - x).abs() < 1e-12, "{}: {} and {x}", state.t, state.q[2]);
                }
            }
        }
    }
}

/// A platform on three parallel cranks, of which one is redundant, driven unevenly.
#[mechanism(allow_redundant)]
#[bodies(first, second, third, platform)]
#[revolute(A: ground @ (0, 0), first @ (0, 0))]
#[revolute(B: ground @ (0.8, 0), second @ (0, 0))]
#[revolute(C: ground @ (0.3, 0.4), third @ (0, 0))]
#[revolute(D: first @ (0.3, 0), platform @ (0, 0))]
#[revolute(E: second @ (0.3, 0), platform @ (0.8, 0))]
#[revolute(F: third @ (0.3, 0), platform @ (0.3, 0.4))]
#[driver(drive: first.phi = start + 1.4 * t + 0.1 * pow(sin(3 * t), 3))]
#[guess(second.phi = start, third.phi = start)]
struct Platform {
    start: f64,
}

/// The cranks that the plan uses pass their limits, where the third one holds the platform, in steps that are looked
/// into.
#[test]
fn limits_of_the_rows_that_a_plan_uses_are_passed() {
    const { assert!(Platform::KNOWN_VALUES_CURVE) };
    for start in [0.6, 2.3, -1.1] {
        let platform = Platform { start };
        let solver = platform.solver();
        for count in [3_u32, 20, 77] {
            let times: Vec<f64> = (0..=count).map(|k| 13.0 * f64::from(k) / f64::from(count)).collect();
            let phi = |t: f64| start + 1.4 * t + 0.1 * (3.0 * t).sin().powi(3);
            let check = |t: f64, q: &[f64]| {
                let all = [phi(t), phi(t), phi(t), 0.0];
                let off = all.iter().enumerate().map(|(k, phi)| (q[3 * k + 2] - phi).abs()).fold(0.0, f64::max);
                assert!(off < 1e-9, "{start}, {count} steps, t = {t}: {q:?}");
            };
            let states = solver.sweep(&times).expect("the third crank holds it").states;
            assert_eq!(times.len(), states.len());
            states.iter().for_each(|state| check(state.t, &state.q));
            let mut planned = solver.planned(&Instant::at(0.0)).expect("it closes");
            for &t in &times[1..] {
                let state = planned.at(&Instant::at(t)).expect("the third crank holds it");
                check(t, state.q());
            }
        }
    }
}

/// One sinusoid shows its motion in its rates, and rotated vectors turn no faster than the bodies.
#[test]
fn steps_are_looked_into_only_where_functions_may_hide_motion() {
    /// A crank driven by a function of time.
    macro_rules! driven {
        ($($name:ident: $($value:tt)*),* $(,)?) => { $(
            #[mechanism]
            #[body(crank, x = 0, y = 0)]
            #[driver(drive: crank.phi = $($value)*)]
            struct $name { a: f64, w: f64 }
        )* };
    }
    driven!(OneSine: (0.3 + t - a * sin(w * t + 0.2)));
    driven!(Squared: (a * t + pow(w - a * cos(w * t), 2)));
    driven!(TwoSines: (a * sin(w * t) - a * sin(3 * w * t) / 3));
    driven!(Product: (a * pow(t, 2) * sin(w * t)));
    driven!(Chirp: (sin(a * t + w * pow(t, 2))));
    driven!(Bump: (a * exp(-pow(t * w, 2))));
    driven!(Quintic: (a * pow(t, 5) + w * t));
    let unseen = [
        OneSine::KNOWN_VALUES_CURVE,
        Squared::KNOWN_VALUES_CURVE,
        Excavator::KNOWN_VALUES_CURVE,
        FourbarLectureAngles::KNOWN_VALUES_CURVE,
        FourbarLectureMid::KNOWN_VALUES_CURVE,
        GearedFivebar::KNOWN_VALUES_CURVE,
        KlannLeg::KNOWN_VALUES_CURVE,
        Peaucellier::KNOWN_VALUES_CURVE,
        QuickReturn::KNOWN_VALUES_CURVE,
        ScotchYoke::KNOWN_VALUES_CURVE,
        SliderCrankInline::KNOWN_VALUES_CURVE,
        WattSixbar::KNOWN_VALUES_CURVE,
    ];
    assert_eq!([false; 12], unseen);
    let seen = [
        TwoSines::KNOWN_VALUES_CURVE,
        Product::KNOWN_VALUES_CURVE,
        Chirp::KNOWN_VALUES_CURVE,
        Bump::KNOWN_VALUES_CURVE,
        Quintic::KNOWN_VALUES_CURVE,
        Cubed::KNOWN_VALUES_CURVE,
        Wave::KNOWN_VALUES_CURVE,
        Driven::KNOWN_VALUES_CURVE,
    ];
    assert_eq!([true; 8], seen);
    driven!(Cubic: (t * (w * t - a) * (t - w)));
    driven!(Products: (a * t * t * t * (w - t) * (w - t) * (w - t)));
    driven!(Inverse: (a * pow(1 + pow(w * t, 2), -1)));
    const { assert!(!Cubic::KNOWN_VALUES_CURVE && Products::KNOWN_VALUES_CURVE && Inverse::KNOWN_VALUES_CURVE) };
}
