//! Two groups that meet their limits at once where the plan has no branch values of them: with a prescribed coordinate, where
//! the plan divides by a parameter that is 0, and by full Newton with redundant rows. The determinant of Φ_q keeps its sign
//! there.

use kin_runtime::{Kinematics, Options, Signal, SweepError, Trajectory, mechanism};

/// Two slider-cranks on one slider.
#[mechanism]
#[bodies(a, b, c, d)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[revolute(A: a @ (r, 0), b @ (0, 0))]
#[revolute(B: b @ (l, 0), slider @ (0, 0))]
#[revolute(P: ground @ (0, 0), c @ (0, 0))]
#[revolute(C: c @ (r2, 0), d @ (0, 0))]
#[revolute(D: d @ (l2, 0), slider @ (0, 0))]
struct Twins {
    r: f64,
    l: f64,
    r2: f64,
    l2: f64,
}

/// The same beside a pendulum that nothing drives, so that a degree of freedom is left.
#[mechanism]
#[bodies(a, b, c, d, pendulum)]
#[body(slider, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[revolute(A: a @ (r, 0), b @ (0, 0))]
#[revolute(B: b @ (l, 0), slider @ (0, 0))]
#[revolute(P: ground @ (0, 0), c @ (0, 0))]
#[revolute(C: c @ (r, 0), d @ (0, 0))]
#[revolute(D: d @ (l, 0), slider @ (0, 0))]
#[revolute(S: ground @ (0, 1), pendulum @ (0, 0))]
struct BesidePendulum {
    r: f64,
    l: f64,
}

/// A lift of two stages.
#[mechanism]
#[bodies(a1, b1, a2, b2)]
#[body(foot, y = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), a1 @ (0, 0))]
#[revolute(F: foot @ (0, 0), b1 @ (0, 0))]
#[revolute(M1: a1 @ (l / 2, 0), b1 @ (l / 2, 0))]
#[revolute(J1: a1 @ (l, 0), b2 @ (0, 0))]
#[revolute(K1: b1 @ (l, 0), a2 @ (0, 0))]
#[revolute(M2: a2 @ (l / 2, 0), b2 @ (l / 2, 0))]
struct Lift {
    l: f64,
}

/// Two numbers that are coupled by w, which may be 0.
#[mechanism]
#[coordinates(u, v)]
#[constraint(first: u * u + w * v = g + (t - 1) * (t - 1))]
#[constraint(second: v * v + w * u = g + (t - 1) * (t - 1))]
#[guess(u = 1, v = 1)]
struct Coupled {
    w: f64,
    g: f64,
}

/// The same twice, so that rows are redundant.
#[mechanism(allow_redundant)]
#[coordinates(u, v)]
#[constraint(first: u * u = g + (t - 1) * (t - 1))]
#[constraint(second: v * v = g + (t - 1) * (t - 1))]
#[constraint(product: 2 * u * v = 2 * g + 2 * (t - 1) * (t - 1))]
#[guess(u = 1, v = 1)]
struct Repeated {
    g: f64,
}

/// What a sweep that should stay at `expected` did: true if it passed, false if it ended.
fn passes(found: Result<Trajectory, SweepError>, k: usize, expected: &dyn Fn(f64) -> f64, says: &str) -> bool {
    let states = match &found {
        Ok(trajectory) => &trajectory.states,
        Err(error) => &error.trajectory.states,
    };
    for state in states {
        let (found, right) = (state.q[k], expected(state.t));
        assert!((found - right).abs() < 1e-6, "{says}: {found} instead of {right} at {}", state.t);
    }
    found.is_ok()
}

/// Prescribed motions to the part 1 − gap of the reach, and back.
fn prescribed<M: Kinematics>(
    mechanism: &M,
    (slider, crank): (usize, usize),
    reach: f64,
    configuration: &dyn Fn(f64) -> Vec<f64>,
) {
    for gap in [1e-2, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, -1e-10, -1e-8, -1e-6, -1e-4, -1e-2] {
        let (from, half) = (0.55 * reach, 1.4);
        let v = 2.0 * (reach * (1.0 - gap) - from) / half;
        let place = |t: f64| from + v * t - 0.5 * v / half * t * t;
        let solver = mechanism.solver().with_given(slider, Signal::new(from, v, -v / half));
        for n in [1_u32, 2, 3, 7, 20, 53, 200] {
            let times: Vec<f64> = (0..=n).map(|k| 2.75 * f64::from(k) / f64::from(n)).collect();
            let swept = solver.sweep_from(&configuration(from), &times);
            let says = format!("{}, gap {gap}, {n} steps", M::model().name);
            let passed = passes(swept, crank, &|t| configuration(place(t))[crank], &says);
            assert_eq!(gap > 0.0, passed, "{says}");
        }
    }
}

/// A slider-crank with its crank up: crank and bar.
fn slider_crank(r: f64, l: f64, x: f64) -> [f64; 6] {
    let a = ((x * x + r * r - l * l) / (2.0 * x * r)).acos();
    let (ax, ay) = (r * a.cos(), r * a.sin());
    [0.0, 0.0, a, ax, ay, (-ay).atan2(x - ax)]
}

#[test]
fn prescribed_motions_of_twins_keep_their_branch() {
    let (r, l): (f64, f64) = (0.5, 0.8);
    for (r2, l2) in [(r, l), (l, r), (r, l * (1.0 + 1e-12)), (r, l * (1.0 + 1e-9))] {
        let reach = (r + l).min(r2 + l2);
        let both = |x: f64| {
            let [first, second] = [slider_crank(r, l, x), slider_crank(r2, l2, x)];
            [&first[..], &second, &[x]].concat()
        };
        prescribed(&Twins { r, l, r2, l2 }, (12, 2), reach, &both);
        prescribed(&Twins { r, l, r2, l2 }, (12, 8), reach, &both);
    }
}

#[test]
fn prescribed_motions_keep_their_branch_beside_an_open_degree_of_freedom() {
    let (r, l) = (0.5, 0.8);
    let all = |x: f64| {
        let one = slider_crank(r, l, x);
        [&one[..], &one, &[0.0, 1.0, 0.3, x]].concat()
    };
    prescribed(&BesidePendulum { r, l }, (15, 2), r + l, &all);
}

#[test]
fn a_prescribed_lift_of_two_stages_keeps_its_branch() {
    let l = 1.3;
    let pi = std::f64::consts::PI;
    let configuration = |x: f64| {
        let z = (x / l).acos();
        let h = l * z.sin();
        vec![0.0, 0.0, z, x, 0.0, pi - z, 0.0, h, z, x, h, pi - z, x]
    };
    prescribed(&Lift { l }, (12, 2), l, &configuration);
}

#[test]
fn numbers_without_branch_values_keep_their_signs() {
    for gap in [1e-2, 1e-3, 1e-4, 1e-6, 1e-8, -1e-8, -1e-4, -1e-2] {
        let expected = |t: f64| (gap + (t - 1.0) * (t - 1.0)).max(0.0).sqrt();
        for n in [1_u32, 2, 3, 7, 20, 53, 200] {
            let times: Vec<f64> = (0..=n).map(|k| 2.13 * f64::from(k) / f64::from(n)).collect();
            for use_plan in [true, false] {
                let options = Options { use_plan, ..Options::default() };
                let says = format!("gap {gap}, {n} steps, plan {use_plan}");
                let coupled = Coupled { w: 0.0, g: gap };
                let swept = coupled.solver().with_options(options).sweep(&times);
                assert_eq!(gap > 0.0, passes(swept, 0, &expected, &says), "{says}");
                let repeated = Repeated { g: gap };
                let swept = repeated.solver().with_options(options).sweep(&times);
                assert_eq!(gap > 0.0, passes(swept, 1, &expected, &says), "{says}");
            }
        }
    }
}
