//! Where ropes go slack, and where they are taut again.

use kin_runtime::{Instant, Kinematics, Measure, Mechanism, State, mechanism};

/// A load of mass 2 on a rope whose length vibrates: its tension is m (g + ÿ) with ÿ = a ω² sin ωt.
#[mechanism]
#[bodies(load)]
#[translational(way: ground @ (0, 0), load @ (0, 0), axis = (0, 1))]
#[rope(stay: ground @ (0, 2), load @ (0, 0), length = 1 + a*sin(omega*t))]
#[guess(load.y = 1)]
#[gravity(0, -9.81)]
#[mass(load @ (0, 0), mass = 2)]
struct Hoist {
    #[param(0.01)]
    a: f64,
    #[param(40)]
    omega: f64,
}

/// Times of one period, `steps` intervals.
fn period(omega: f64, steps: u32, shift: f64) -> Vec<f64> {
    (0..=steps).map(|k| std::f64::consts::TAU / omega * (f64::from(k) + shift) / f64::from(steps)).collect()
}

#[test]
fn a_rope_goes_slack_where_its_load_falls_as_fast_as_it_is_let_down() {
    let hoist = Hoist::default();
    // a ω² sin ωt = -g in the second half of the period.
    let phase = (9.81_f64 / 16.0).asin();
    let exact = [std::f64::consts::PI + phase, std::f64::consts::TAU - phase].map(|angle| angle / 40.0);
    for steps in [24, 100] {
        let states = hoist.solver().sweep(&period(40.0, steps, 0.0)).unwrap().states;
        let changes = hoist.solver().contact_changes(&states).unwrap();
        let found: Vec<_> = changes.iter().map(|change| (change.name, change.lifts_off, change.rope)).collect();
        assert_eq!(vec![("stay", true, true), ("stay", false, true)], found);
        for (change, exact) in changes.iter().zip(exact) {
            assert!((change.t - exact).abs() < 1e-10, "{change}: {exact}");
        }
        assert_eq!("stay goes slack at t = ", &changes[0].to_string()[..23]);
        assert_eq!("stay is taut again at t = ", &changes[1].to_string()[..26]);
        let back: Vec<State> = states.into_iter().rev().collect();
        let changes = hoist.solver().contact_changes(&back).unwrap();
        assert_eq!([true, false], [0, 1].map(|k: usize| changes[k].lifts_off));
        assert!((changes[0].t - exact[1]).abs() < 1e-10);
    }
    // A little faster than where it only comes to rest on the rope, both changes lie between two states; slower it never
    // goes slack.
    let quick = Hoist { omega: 31.33, ..hoist };
    let changes = quick.solver().contact_changes(&quick.solver().sweep(&period(31.33, 24, 0.4)).unwrap().states);
    let first = (std::f64::consts::PI + (9.81 / (0.01 * 31.33_f64.powi(2))).asin()) / 31.33;
    let changes = changes.unwrap();
    assert!(changes.len() == 2 && (changes[0].t - first).abs() < 1e-7, "{changes:?} {first}");
    let slow = Hoist { omega: 31.0, ..hoist };
    let states = slow.solver().sweep(&period(31.0, 24, 0.4)).unwrap().states;
    assert!(slow.solver().contact_changes(&states).unwrap().is_empty());
}

/// m (g + ÿ) at every instant, also where the rope would have to push: in the reaction, as a quantity with a sign, and its
/// derivative with respect to the amplitude.
#[test]
fn a_tension_has_a_sign() {
    let hoist = Hoist::default();
    let solver = hoist.solver();
    let tension = [Measure::named(Hoist::model(), "stay.tension").expect("a quantity")];
    let amplitude = Hoist::model().parameters.iter().position(|parameter| parameter.name == "a").expect("a parameter");
    let mut signs = [false; 2];
    for state in solver.sweep(&period(40.0, 24, 0.0)).unwrap().states {
        let wave = 1600.0 * (40.0 * state.t).sin();
        let expected = 2.0 * (9.81 + 0.01 * wave);
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        near(solver.forces(&state).unwrap().reaction("stay").unwrap().tension.unwrap(), expected);
        near(solver.measure(&state, &tension).unwrap()[0], expected);
        near(solver.measure_sensitivities(&state, &tension, &[amplitude]).unwrap()[0][0], 2.0 * wave);
        signs[usize::from(expected > 0.0)] = true;
    }
    assert_eq!([true; 2], signs);
}

/// A rope between two points has the closed form of a distance; over a pulley it is solved by iteration, and has the same
/// tension.
#[test]
fn a_rope_between_two_points_has_a_closed_form() {
    #[mechanism]
    #[bodies(load)]
    #[translational(way: ground @ (0, 0), load @ (0, 0), axis = (0, 1))]
    #[rope(stay: ground @ (1, 2), ground @ (0, 2), load @ (0, 0), length = 2 + 0.01*sin(40*t))]
    #[guess(load.y = 1)]
    #[gravity(0, -9.81)]
    #[mass(load @ (0, 0), mass = 2)]
    struct OverPulley;

    let closed_and_iterated =
        [Hoist::model(), OverPulley::model()].map(|model| [model.plan.modes.len(), model.plan.iterations]);
    assert_eq!([[1, 0], [0, 1]], closed_and_iterated);
    for t in period(40.0, 24, 0.0) {
        let [straight, bent] = [forces_at(&Hoist::default(), t), forces_at(&OverPulley, t)];
        for (a, b) in straight.into_iter().zip(bent) {
            assert!((a - b).abs() < 1e-9, "{t}: {a} {b}");
        }
    }
}

/// The tension of the rope, its effort, and the force on its last point.
fn forces_at<M: Kinematics>(hoist: &M, t: f64) -> [f64; 4] {
    let forces = hoist.solver().forces(&hoist.state_at(&Instant::at(t)).unwrap()).unwrap();
    let stay = forces.reaction("stay").unwrap();
    let [x, y] = stay.force.unwrap();
    [stay.tension.unwrap(), forces.effort("stay").unwrap(), x, y]
}

/// A load across its guide leaves the rope without tension: rounding errors are no changes.
#[test]
fn a_rope_without_load_does_not_go_slack() {
    #[mechanism]
    #[bodies(load)]
    #[translational(way: ground @ (0, 0), load @ (0, 0), axis = (0.3, 0.7))]
    #[rope(stay: ground @ (0.3, 2), load @ (0.1, 0.2), length = 1 + 0.2*sin(t))]
    #[guess(load.x = 0.3, load.y = 0.7)]
    #[force(push: load @ (0, 0), (-0.7*sin(7*t), 0.3*sin(7*t)))]
    struct Idle;

    let states = Idle.solver().sweep(&period(1.0, 200, 0.0)).unwrap().states;
    let changes = Idle.solver().contact_changes(&states).unwrap();
    assert!(changes.is_empty(), "{changes:?}");
}

/// The same on the command line, and for another program.
#[test]
fn a_sweep_tells_where_ropes_go_slack() {
    let file = format!("{}/slack.json", env!("CARGO_TARGET_TMPDIR"));
    let args = ["hoist", "sweep", "--from", "0", "--to", "0.157", "--steps", "24", "--format", "json", "--out", &file];
    assert_eq!(std::process::ExitCode::SUCCESS, kin_runtime::cli::run_from::<Hoist>(args));
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let changes = json["contacts"].as_array().unwrap();
    let first = (std::f64::consts::PI + (9.81_f64 / 16.0).asin()) / 40.0;
    assert!((changes[0]["t"].as_f64().unwrap() - first).abs() < 1e-10, "{changes:?}");
    let parts = |k: usize| ["lifts_off", "rope"].map(|part| changes[k][part].as_bool().unwrap());
    assert_eq!([[true, true], [false, true]], [parts(0), parts(1)]);
}
