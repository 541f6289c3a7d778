//! Dyads of every kind near, at and beyond their limits: rounding errors grow as the conditioning predicts, the mode is
//! kept, and a group that cannot close is named.

use kin_runtime::{Instant, Kinematics, Limit, Options, PlanError, Planned, Sign, SolveError, mechanism};
use kin_tests::compare::largest;
use kin_tests::random::Random;

/// Coupler and rocker are stretched where cos φ = 0.1375 / 0.3.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.3, 0), coupler @ (-0.125, 0))]
#[revolute(B: coupler @ (0.125, 0), rocker @ (0.1, 0))]
#[revolute(D: ground @ (0.5, 0), rocker @ (-0.1, 0))]
#[driver(drive: crank.phi = t)]
#[guess(coupler.phi = 0.9, rocker.phi = 2.2)]
#[derive(Default)]
struct Rockers;

/// The rod is upright where sin φ = 2/3.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.3, 0), rod @ (-0.1, 0))]
#[revolute(B: rod @ (0.1, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
#[guess(rod.phi = -0.4, slider.x = 0.5)]
#[derive(Default)]
struct Slider;

/// The crank's pin comes so near to the rocker's pivot that no line with this offset passes through it.
#[mechanism]
#[bodies(crank, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(D: ground @ (0.5, 0), rocker @ (0, 0))]
#[point_on_line(slot: rocker @ (0, 0), crank @ (0.3, 0), axis = (1, 0), offset = 0.25)]
#[driver(drive: crank.phi = 1.5 - t)]
#[guess(rocker.phi = 1.0)]
#[derive(Default)]
struct Guide;

/// A cylinder that gets longer than the sum of both arms.
#[mechanism]
#[bodies(boom)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[distance(ram: ground @ (1, 0), boom @ (1.2, 0), length = 0.9 + t)]
#[guess(boom.phi = 0.8)]
#[derive(Default)]
struct Crane;

/// A parallelogram, which is flat at t = 0.3 where another branch crosses, with a wheel that turns so fast that it
/// hides jumps of the other velocities.
#[mechanism]
#[bodies(crank, coupler, rocker, wheel)]
#[revolute(O: ground @ (0, 0), crank @ (-0.1, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (-0.25, 0))]
#[revolute(B: coupler @ (0.25, 0), rocker @ (0.1, 0))]
#[revolute(D: ground @ (0.5, 0), rocker @ (-0.1, 0))]
#[revolute(W: ground @ (0, 1), wheel @ (0, 0))]
#[driver(turn: crank.phi = t - 0.3)]
#[driver(spin: wheel.phi = 60 * t)]
#[guess(coupler.phi = 0, rocker.phi = -0.3)]
#[derive(Default)]
struct Flat;

/// The times of the limits.
fn limits() -> [f64; 4] {
    [(0.1375 / 0.3_f64).acos(), (2.0 / 3.0_f64).asin(), 1.5 - (0.2775 / 0.3_f64).acos(), 1.3]
}

/// Instants that approach the limit, followed by the limit itself and instants beyond it.
fn approaches<M: Kinematics + Default>(limit: f64, joints: &[&str]) {
    let mechanism = M::default();
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).unwrap();
    let sign = planned.mode(0);
    for k in 1..=30 {
        let t = limit - 0.5_f64.powi(k);
        let found = planned.at(&Instant::at(t)).unwrap_or_else(|error| panic!("{error}"));
        let phi = mechanism.constraints(&Instant::at(t), found.q()).unwrap();
        assert!(largest(phi.as_ref()) < 1e-14, "2^-{k}: {:e}", largest(phi.as_ref()));
        let modes = mechanism.solver().modes(&Instant::at(t), found.q()).unwrap();
        assert_eq!(modes[0].sign, sign, "2^-{k}");
        // Margin and closure agree: the margin is proportional to w².
        let (margin, closure) = (found.margins()[0], modes[0].closure);
        assert!((closure * closure / margin - 1.0).abs() < 1e-3 + 1e-14 / margin, "2^-{k}: {margin} {closure}");
    }
    let last = (planned.t(), planned.q().to_vec());
    for beyond in [0.0, 1e-13, 1e-9, 1e-3, 0.05] {
        let error = planned.at(&Instant::at(limit + beyond)).unwrap_err();
        let PlanError::Limit { t, limit: found } = error else { panic!("{error}") };
        assert_eq!((t, found.step.joints().collect::<Vec<_>>()), (limit + beyond, joints.to_vec()));
        assert!(found.margin < 1e-12 && (found.margin < 0.0 || beyond < 1e-12), "{error}");
        assert!(error.to_string().contains(&format!("of {}", joints.join(", "))), "{error}");
        assert_eq!((planned.t(), planned.q()), (last.0, &last.1[..]));
    }
    // In random order, the mode is the same, or there is no solution.
    let mut random = Random::new(11);
    for _ in 0..2000 {
        let t = limit + random.between(-1.0, 0.01) * random.between(0.0, 1.0).powi(8);
        match planned.at(&Instant::at(t)) {
            Ok(found) => {
                assert!(t < limit);
                assert!(largest(found.q()) < 10.0, "turns count on: {:?}", found.q());
                let modes = mechanism.solver().modes(&Instant::at(t), found.q()).unwrap();
                assert_eq!(modes[0].sign, sign, "{t}");
            }
            Err(PlanError::Limit { .. }) => assert!(t > limit - 1e-11, "{t}"),
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn modes_are_kept_up_to_the_limit_and_beyond_it_is_an_error() {
    let [rockers, slider, guide, crane] = limits();
    approaches::<Rockers>(rockers, &["A", "B", "D"]);
    approaches::<Slider>(slider, &["A", "B", "guide"]);
    approaches::<Guide>(guide, &["D", "slot"]);
    approaches::<Crane>(crane, &["pin", "ram"]);
}

/// x = r cos φ ± √((l − r sin φ)(l + r sin φ)), as accurate as the rounding of t allows.
#[test]
fn errors_grow_as_conditioning_says() {
    let limit = limits()[1];
    let mut planned = Slider.solver().planned(&Instant::at(0.0)).unwrap();
    for k in 1..=36 {
        let t = limit - 0.5_f64.powi(k);
        let x = planned.at(&Instant::at(t)).unwrap().q()[6];
        let (sin, cos) = t.sin_cos();
        let expected = 0.3 * cos + ((0.2 - 0.3 * sin) * (0.2 + 0.3 * sin)).sqrt();
        let known = 2e-16 / 0.5_f64.powi(k).sqrt();
        assert!((x - expected).abs() < known, "2^-{k}: {:e} and {known:e}", x - expected);
    }
}

fn sweep_ends<M: Kinematics + Default>(limit: f64, joints: &[&str]) {
    let mechanism = M::default();
    let error = mechanism.solver().sweep(&[0.0, 0.2, limit + 0.05]).unwrap_err();
    assert_eq!(error.trajectory.len(), 2);
    let (SolveError::Singular { t, .. } | SolveError::StepRefused { t, .. }) = error.source else { panic!("{error}") };
    assert!((t - limit).abs() < 1e-9, "{t} and {limit}");
    let found = error.source.limit().unwrap_or_else(|| panic!("{error}"));
    assert_eq!(found.step.joints().collect::<Vec<_>>(), joints);
    assert!(found.margin < 1e-9, "{error}");
    let beyond = mechanism.solver().state(&Instant::at(limit + 0.05)).unwrap_err();
    assert!(matches!(beyond, SolveError::NotAssembled { .. }), "{beyond}");
    let found = beyond.limit().unwrap_or_else(|| panic!("{beyond}"));
    assert_eq!(found.step.joints().collect::<Vec<_>>(), joints);
    assert!(found.margin < -1e-2, "{beyond}");
}

#[test]
fn sweeps_and_states_name_the_dyad() {
    let [rockers, slider, guide, crane] = limits();
    sweep_ends::<Rockers>(rockers, &["A", "B", "D"]);
    sweep_ends::<Slider>(slider, &["A", "B", "guide"]);
    sweep_ends::<Guide>(guide, &["D", "slot"]);
    sweep_ends::<Crane>(crane, &["pin", "ram"]);
}

/// Each sign gives a different configuration, and a sweep stays in its mode.
fn both_modes<M: Kinematics + Default>(name: &str, until: f64) {
    let mechanism = M::default();
    let at = Instant::at(0.0);
    assert_eq!(M::modes().iter().map(|mode| mode.name).collect::<Vec<_>>(), [name]);
    let found = [Sign::Plus, Sign::Minus].map(|sign| {
        let solver = mechanism.solver().with_mode(name, sign);
        let sweep = solver.sweep(&[0.0, until]).unwrap();
        for state in &sweep {
            assert_eq!(solver.modes(&state.instant(), &state.q).unwrap()[0].sign, Some(sign));
        }
        let mut planned = Planned::new(&mechanism, &at, &sweep.states[0].q).unwrap();
        assert_eq!(planned.mode(name), Some(sign));
        planned.flip(name).unwrap();
        (sweep.states[0].q.clone(), planned.at(&at).unwrap().q().to_vec())
    });
    let [(plus, flipped_plus), (minus, flipped_minus)] = found;
    let far = |a: &[f64], b: &[f64]| largest(&a.iter().zip(b).map(|(a, b)| (a - b).sin()).collect::<Vec<_>>());
    assert!(far(&plus, &minus) > 0.1);
    assert!(far(&plus, &flipped_minus) < 1e-14 && far(&minus, &flipped_plus) < 1e-14);
}

#[test]
fn either_mode_can_be_asked_for() {
    both_modes::<Rockers>("A-B-D", 1.0);
    both_modes::<Slider>("A-B-guide", 0.7);
    both_modes::<Guide>("D-slot", 1.0);
    both_modes::<Crane>("pin-ram", 0.3);
}

#[test]
fn a_sign_that_is_kept_leads_across_no_crossing() {
    for times in [&[0.0, 0.6][..], &[0.0, 0.2, 0.299, 0.301, 0.4]] {
        for use_plan in [true, false] {
            let options = Options { use_plan, ..Options::default() };
            let error = Flat.solver().with_options(options).sweep(times).unwrap_err();
            let SolveError::Singular { t, .. } = error.source else { panic!("{error}") };
            assert!((t - 0.3).abs() < 2e-3, "{error}");
            assert_eq!(error.trajectory.len(), times.iter().filter(|t| **t < 0.3).count());
        }
    }
}

/// A beam on a rope that runs over its end and becomes shorter, up to the shortest rope that reaches the end.
#[mechanism]
#[bodies(beam)]
#[revolute(hinge: ground @ (0, 0), beam @ (0, 0))]
#[rope(tackle: ground @ (-1.144, 1.456), beam @ (0.65, 0.28), ground @ (0.941, 0.312), length = 2.425 + 0.33 * sin(0.245 * t))]
#[guess(beam.phi = 1)]
struct Hoist;

/// The limit is where it is, not at the last instant before it, at which rates are inaccurate already.
#[test]
fn a_limit_is_not_moved_to_an_instant_beside_it() {
    let length = |phi: f64| {
        let (sin, cos) = phi.sin_cos();
        let [x, y] = [0.65 * cos - 0.28 * sin, 0.65 * sin + 0.28 * cos];
        (x + 1.144).hypot(y - 1.456) + (x - 0.941).hypot(y - 0.312)
    };
    let near = Hoist.solver().sweep(&[0.0, 6.0, 13.0]).expect("it is before the limit").states[2].q[2];
    let (mut low, mut high) = (near - 0.8, near + 0.8);
    while high - low > 1e-9 {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if length(a) < length(b) { high = b } else { low = a }
    }
    let shortest = length(0.5 * (low + high));
    let limit = (std::f64::consts::PI - ((shortest - 2.425) / 0.33).asin()) / 0.245;
    for before in [3e-8, 1e-7, 2e-7, 1e-6] {
        for times in [vec![0.0, limit - before, 14.0], vec![0.0, 6.0, 13.0, limit - before, 14.0]] {
            let error = Hoist.solver().sweep(&times).expect_err("the rope is too short");
            let at = error.source.limit().and_then(Limit::at).expect("it is located");
            assert!((at - limit).abs() < 1e-9 * limit, "{before} {}: {at} {limit}", times.len());
        }
    }
}
