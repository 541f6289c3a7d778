//! Groups much smaller than the body that carries them: their pins are near one another, but never nearer.

use kin_runtime::{Instant, Kinematics, Options, Planned, mechanism};
use kin_tests::random::Random;

/// A triangle with the sides u, 0.9 u and u at the end of a crank of length 1, which turns with it.
#[mechanism]
#[bodies(crank, small)]
#[revolute(O: ground @ (x0, y0), crank @ (0, 0))]
#[revolute(T: small @ (0, 0), crank @ (1, 0))]
#[distance(V: small @ (u, 0), crank @ (1 + u, 0), length = 0.9 * u)]
#[driver(drive: crank.phi = 0.3 + speed * t)]
#[guess(crank.phi = 0.3, small.phi = 1.2)]
#[derive(Clone, Debug)]
struct Far {
    u: f64,
    x0: f64,
    y0: f64,
    speed: f64,
}

impl Far {
    /// The angle between the triangle and the crank, at every instant.
    fn angle() -> f64 {
        2.0 * 0.45_f64.asin()
    }
}

#[test]
fn a_small_triangle_turns_with_its_crank() {
    let times: Vec<f64> = (0..=20).map(|k| 0.1 * f64::from(k)).collect();
    let sizes = [1e-2_f64, 1e-3, 2e-4, 1.3e-4, 1e-4, 7e-5, 2e-5, 1e-5, 2e-6, 1e-6];
    for (u, [x0, y0]) in sizes.into_iter().flat_map(|u| [[0.0_f64, 0.0], [-30.0, 17.0]].map(|origin| (u, origin))) {
        // Rounding of the coordinates of the pins, relative to their distance.
        let rounding = f64::EPSILON * (2.0 + x0.abs() + y0.abs()) / u;
        if rounding > 1e-8 {
            continue;
        }
        let far = Far { u, x0, y0, speed: 1.0 };
        let right = |q: &[f64], q_dot: &[f64], q_ddot: &[f64], what: &str| {
            // Newton's method may find an angle that is whole turns away.
            let off = (0.5 * (q[5] - q[2] - Far::angle())).sin() * 2.0;
            assert!(off.abs() <= 8.0 * rounding, "{u:e} {x0} {what}: {off:e}");
            assert!((q_dot[5] - 1.0).abs() <= 20.0 * rounding, "{u:e} {x0} {what}: {:e}", q_dot[5] - 1.0);
            assert!(q_ddot[5].abs() <= 200.0 * rounding, "{u:e} {x0} {what}: {:e}", q_ddot[5]);
        };
        for use_plan in [true, false] {
            let options = Options { use_plan, ..Options::default() };
            let swept = far.solver().with_options(options).sweep(&times).unwrap_or_else(|e| panic!("{u:e} {x0}: {e}"));
            swept.states.iter().for_each(|state| right(&state.q, &state.q_dot, &state.q_ddot, "sweep"));
            assert_eq!(times.len(), swept.states.len());
        }
        let first = far.state_at(&Instant::at(0.0)).expect("it closes");
        let mut planned = Planned::new(&far, &Instant::at(0.0), &first.q).expect("it has a plan");
        for t in &times {
            planned.at(&Instant::at(*t)).unwrap_or_else(|error| panic!("{u:e} {x0} at {t}: {error}"));
            right(planned.q(), planned.q_dot(), planned.q_ddot(), "planned");
        }
    }
}

/// At rest, too.
#[test]
fn a_small_triangle_may_stand_still() {
    for u in [1e-3, 1e-4, 1e-5] {
        let far = Far { u, x0: 0.0, y0: 0.0, speed: 0.0 };
        let state = far.state_at(&Instant::at(0.0));
        let state = state.unwrap_or_else(|error| panic!("{u:e}: {error}"));
        assert!((state.q[5] - 0.3 - Far::angle()).abs() < 1e-9 && state.q_dot[5].abs() < 1e-12, "{u:e}");
        let mut planned =
            Planned::new(&far, &Instant::at(0.0), &state.q).unwrap_or_else(|error| panic!("{u:e}: {error}"));
        planned.at(&Instant::at(1.0)).unwrap_or_else(|error| panic!("{u:e}: {error}"));
        assert!((planned.q()[5] - state.q[5]).abs() < 1e-9 && planned.q_dot()[5].abs() < 1e-12, "{u:e}");
    }
}

/// A four-bar with such a triangle on its coupler.
#[mechanism]
#[bodies(crank, coupler, rocker, small)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(C: rocker @ (0, 0), ground @ (1, 0))]
#[revolute(T: small @ (0, 0), coupler @ (0.3, u))]
#[distance(V: small @ (u, 0), coupler @ (0.3 + u, u), length = 0.9 * u)]
#[driver(drive: crank.phi = 0.7 + t)]
struct Carried {
    a: f64,
    b: f64,
    c: f64,
    u: f64,
}

/// Without guesses Newton's iteration begins far from closed: a row of a small distance must not dominate all others there.
#[test]
fn small_bodies_do_not_keep_a_mechanism_from_closing() {
    let mut random = Random::new(0x5a11);
    for (u, _) in [0.1, 1e-3, 1e-5, 1e-6].into_iter().flat_map(|u| (0..20).map(move |k| (u, k))) {
        let [a, b, c] = [random.between(0.1, 0.3), random.between(0.9, 1.2), random.between(0.8, 1.1)];
        let carried = Carried { a, b, c, u };
        let options = Options { use_plan: false, ..Options::default() };
        let state = carried.solver().with_options(options).state(&Instant::at(0.0));
        let state = state.unwrap_or_else(|error| panic!("{a} {b} {c} {u:e}: {error}"));
        // The triangle turns with the coupler.
        assert!((state.q_dot[11] - state.q_dot[5]).abs() < 1e-8, "{a} {b} {c} {u:e}: {:?}", state.q_dot);
    }
}
