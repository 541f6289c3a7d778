//! All closures of a mechanism, compared with those found by elimination in closed form.

use kin_runtime::cli::run_from;
use kin_runtime::{Assemblies, Instant, Kinematics, SolveError, Uncertified, mechanism};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::PathBuf;
use std::process::ExitCode;

/// A crank and two dyads in series, the second one on the rocker of the first.
#[mechanism]
#[bodies(crank, coupler, rocker, rod, lever)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(C: ground @ (0.4, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (0.15, 0.05), rod @ (0, 0))]
#[revolute(E: rod @ (reach, 0), lever @ (0.2, 0))]
#[revolute(F: ground @ (0.8, 0.1), lever @ (0, 0))]
#[driver(drive: crank.phi = 1 + t)]
struct TwoDyads {
    #[param(0.35)]
    reach: f64,
}

fn is_proven(all: &Assemblies) -> bool {
    assert!(all.undecided.is_empty(), "{:?}", all.undecided);
    all.is_complete()
}

#[test]
fn dyads_close_in_all_combinations_of_their_signs() {
    let mechanism = TwoDyads::default();
    let solver = mechanism.solver();
    let all = solver.assemblies(&Instant::at(0.0)).unwrap();
    assert!(is_proven(&all));
    assert_eq!(all.found.len(), 4);
    for assembly in &all.found {
        // Position analysis with the modes of the closure finds the same closure.
        let asked =
            assembly.modes.iter().fold(mechanism.solver(), |solver, &(name, sign)| solver.with_mode(name, sign));
        let state = asked.state(&Instant::at(0.0)).unwrap();
        for k in [5, 8, 11, 14] {
            let off = (state.q[k] - assembly.q[k]) / TAU;
            assert!((off - off.round()).abs() < 1e-12, "{}", assembly.name());
        }
        let certificate = assembly.certificate.as_ref().unwrap();
        assert!(certificate.radius() < 1e-13 && certificate.covers(&assembly.q));
    }
    let names: Vec<String> = all.found.iter().map(|assembly| assembly.name()).collect();
    assert!(names.iter().enumerate().all(|(k, name)| !names[..k].contains(name)), "{names:?}");

    // A rod that reaches the lever from both positions of the rocker, from one and from none.
    let counts = [0.35, 0.18, 0.02].map(|reach| {
        let all = TwoDyads { reach }.solver().assemblies(&Instant::at(0.0)).unwrap();
        assert!(is_proven(&all), "{reach}");
        // In closed form: the positions of D, and whether F can be reached from each.
        let (ax, ay) = (0.1 * 1.0_f64.cos(), 0.1 * 1.0_f64.sin());
        let (dx, dy) = (0.4 - ax, -ay);
        let distance = dx.hypot(dy);
        let cosine = (0.3_f64.powi(2) + distance * distance - 0.4_f64.powi(2)) / (2.0 * 0.3 * distance);
        let towards = (-dy).atan2(-dx);
        let close = |sign: f64| {
            let phi = towards + sign * cosine.acos();
            let (x, y) = (0.4 + 0.15 * phi.cos() - 0.05 * phi.sin(), 0.15 * phi.sin() + 0.05 * phi.cos());
            let gap = (0.8 - x).hypot(0.1 - y);
            if gap < reach + 0.2 && gap > (reach - 0.2).abs() { 2 } else { 0 }
        };
        assert_eq!(all.found.len(), close(1.0) + close(-1.0), "{reach}");
        all.found.len()
    });
    assert_eq!((counts[0], counts[2]), (4, 0));
}

/// The forward position problem of a 3-RRR robot: the crank angles are given, and the platform closes three loops at
/// once. One crank turns with t.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (base*cos(2*pi*i/3 - 5*pi/6), base*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (l, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (l, 0), platform @ (size*cos(2*pi*i/3 - 5*pi/6), size*sin(2*pi*i/3 - 5*pi/6)))]
#[driver(a: crank[0].phi = angle[0] + t)]
#[driver(b: crank[1].phi = angle[1])]
#[driver(c: crank[2].phi = angle[2])]
pub(crate) struct Forward {
    #[param(0.5)]
    pub(crate) base: f64,
    #[param(0.25)]
    pub(crate) size: f64,
    #[param(0.3)]
    pub(crate) l: f64,
    #[param([0.9, 3.1, -1.2])]
    pub(crate) angle: [f64; 3],
}

impl Forward {
    /// The angles at which the platform closes. With the elbows E and the platform's corners s, turned by φ, the
    /// platform's position p satisfies |p + s_i(φ) − E_i|² = l². The differences of two of these equations are linear
    /// in p; their solution, inserted in one equation, leaves a function of φ alone, whose sign changes are counted and
    /// bisected.
    pub(crate) fn platform_angles(&self) -> Vec<f64> {
        let direction = |i: usize| 2.0 * PI * i as f64 / 3.0 - 5.0 * PI / 6.0;
        let miss = |phi: f64| {
            let away = [0, 1, 2].map(|i| {
                let (d, a) = (direction(i), self.angle[i]);
                let elbow = [self.base * d.cos() + self.l * a.cos(), self.base * d.sin() + self.l * a.sin()];
                [self.size * (d + phi).cos() - elbow[0], self.size * (d + phi).sin() - elbow[1]]
            });
            // |p|² + 2 p·w_i + |w_i|² = l², minus the equation of i = 0.
            let square = |w: [f64; 2]| w[0] * w[0] + w[1] * w[1];
            let row = |i: usize| {
                let w = [away[i][0] - away[0][0], away[i][1] - away[0][1]];
                ([2.0 * w[0], 2.0 * w[1]], square(away[0]) - square(away[i]))
            };
            let ((m, u), (n, v)) = (row(1), row(2));
            let det = m[0] * n[1] - m[1] * n[0];
            let p = [u * n[1] - v * m[1], m[0] * v - n[0] * u];
            let shifted = [p[0] + det * away[0][0], p[1] + det * away[0][1]];
            square(shifted) - det * det * self.l * self.l
        };
        let steps = 20_000;
        let at = |k: usize| -PI + TAU * k as f64 / steps as f64;
        let changes = (0..steps).filter(|&k| miss(at(k)) * miss(at(k + 1)) < 0.0);
        changes
            .map(|k| {
                let (mut low, mut high) = (at(k), at(k + 1));
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if miss(low) * miss(middle) <= 0.0 { high = middle } else { low = middle }
                }
                0.5 * (low + high)
            })
            .collect()
    }
}

#[test]
fn all_closures_of_a_3rrr_robot_are_those_of_an_elimination() {
    let angles = [[0.9, 3.1, -1.2], [0.3, 2.5, 4.6], [1.4, 3.4, -0.6], [0.0, 0.0, 0.0]];
    let angles = if cfg!(debug_assertions) { &angles[..2] } else { &angles[..] };
    let mut most = 0;
    for &angle in angles {
        let robot = Forward { angle, ..Forward::default() };
        let all = robot.solver().assemblies(&Instant::at(0.0)).unwrap();
        assert!(is_proven(&all), "{angle:?}");
        let expected = robot.platform_angles();
        assert_eq!(all.found.len(), expected.len(), "{angle:?}: {expected:?}");
        for phi in expected {
            let near = |q: &[f64]| (((q[2] - phi) / TAU).round() * TAU + phi - q[2]).abs() < 1e-9;
            assert_eq!(all.found.iter().filter(|assembly| near(&assembly.q)).count(), 1, "{angle:?}: {phi}");
        }
        most = most.max(all.found.len());
    }
    assert!(most >= 2, "{most}");
}

/// The output of a command of the robot's program, as json.
fn json(command: &str) -> Value {
    let out = tempfile(&command.replace(' ', "-"));
    let words = format!("robot {command} --format json --out {}", out.display());
    let code = run_from::<Forward>(words.split(' '));
    assert_eq!(format!("{code:?}"), format!("{:?}", ExitCode::SUCCESS), "{command}");
    let text = std::fs::read_to_string(&out).expect("the file is there");
    std::fs::remove_file(&out).expect("it can be removed");
    serde_json::from_str(&text).expect("one JSON document")
}

/// A file that no other test writes.
fn tempfile(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("kin-{}-{name}.json", std::process::id()))
}

/// The closures of groups that close by iteration have numbers, by which a motion takes them.
#[test]
fn a_motion_begins_in_the_closure_that_modes_names() {
    let all = json("modes");
    let all = all.as_array().expect("a list");
    assert!(all.len() >= 2);
    for (k, closure) in all.iter().enumerate() {
        let name = closure["mode"].as_str().expect("a name");
        assert_eq!((name, &closure["certified"]), (format!("closure={}", k + 1).as_str(), &Value::Bool(true)));
        let swept = json(&format!("sweep --mode {name} --to 0.001 --steps 1"));
        let numbers = |q: &Value| q.as_array().expect("q").iter().filter_map(Value::as_f64).collect::<Vec<_>>();
        let (start, found) = (numbers(&swept["states"][0]["q"]), numbers(&closure["q"]));
        assert!(start.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-9), "{name}: {start:?} {found:?}");
    }
    let far = run_from::<Forward>(["robot", "sweep", "--mode", "closure=9"]);
    assert_ne!(format!("{far:?}"), format!("{:?}", ExitCode::SUCCESS));
}

/// A page offers every closure, each with its motion.
#[test]
fn a_page_has_all_closures_as_a_choice() {
    let all = json("modes --at 0.002");
    let count = all.as_array().expect("a list").len();
    let out = tempfile("page").with_extension("html");
    let words = format!("robot animate --from 0.002 --to 0.003 --steps 2 --out {}", out.display());
    let code = run_from::<Forward>(words.split(' '));
    assert_eq!(format!("{code:?}"), format!("{:?}", ExitCode::SUCCESS));
    let page = std::fs::read_to_string(&out).expect("the page is there");
    std::fs::remove_file(&out).expect("it can be removed");
    for k in 1..=count {
        assert!(page.contains(&format!("closure {k} of {count}")), "{k} of {count}");
    }
}

/// A dyad that is exactly stretched: its two closures coincide, so that none can be certified.
#[mechanism]
#[bodies(left, right)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: left @ (1, 0), right @ (1, 0))]
#[revolute(C: ground @ (width, 0), right @ (0, 0))]
struct Bridge {
    #[param(2)]
    width: f64,
}

#[test]
fn what_is_at_its_limit_is_undecided_and_beyond_it_is_proven() {
    let at = |width| Bridge { width }.solver().assemblies(&Instant::at(0.0)).unwrap();
    let limit = at(2.0);
    assert!(!limit.is_complete(), "{limit:?}");
    let beyond = at(2.0 + 1e-9);
    assert!(beyond.is_complete() && beyond.found.is_empty(), "{beyond:?}");
    let before = at(2.0 - 1e-9);
    assert!(before.is_complete() && before.found.len() == 2, "{before:?}");
}

/// A mechanism without a driver.
#[mechanism]
#[bodies(arm)]
#[revolute(A: ground @ (0, 0), arm @ (0, 0))]
struct Pendulum;

#[test]
fn open_degrees_of_freedom_have_no_list_of_closures() {
    let error = Pendulum.solver().assemblies(&Instant::at(0.0)).unwrap_err();
    let SolveError::NotCertified { why: Uncertified::Open { degrees_of_freedom: 1 }, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(
        error.to_string(),
        "nothing is proven at t = 0: a degree of freedom is open, so that no solution is isolated"
    );
}

/// A cabin and its counterweight on one rope, each below a pulley.
#[mechanism]
#[body(cabin, x = 0, phi = 0)]
#[body(weight, x = 1, phi = 0)]
#[rope(rope: cabin @ (0, 0), ground @ (0, 10), ground @ (1, 10), weight @ (0, 0), length = 12)]
#[driver(drive: cabin.y = 1 + t)]
#[guess(weight.y = 5)]
struct Hanging;

/// The weight hangs as far below its pulley as it could stand above it; at the pulley itself the row has a value, and no
/// derivative.
#[test]
fn weights_below_pulleys_have_two_closures() {
    let all = Hanging.solver().assemblies(&Instant::at(2.0)).expect("rows of position level");
    assert!(all.is_complete(), "{all}");
    let mut heights: Vec<f64> = all.found.iter().map(|found| found.q[1]).collect();
    heights.sort_by(f64::total_cmp);
    assert!(heights.len() == 2 && (heights[0] - 6.0).abs() + (heights[1] - 14.0).abs() < 1e-12, "{heights:?}");
}
