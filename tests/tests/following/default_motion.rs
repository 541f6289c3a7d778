//! Motions of the command line whose end is not given.

use kin_runtime::{cli, mechanism};

/// Two rockers that lock after a tenth of the driven turn.
#[mechanism]
#[bodies(left, floater, right)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: left @ (1, 0), floater @ (0, 0))]
#[revolute(C: floater @ (0.8, 0), right @ (1.1, 0))]
#[revolute(D: ground @ (1.5, 0), right @ (0, 0))]
#[driver(swing: left.phi = 1.2 + t)]
#[guess(floater.phi = -0.1, right.phi = 1.9)]
struct Rockers;

/// t of all rows of a sweep, which succeeds.
fn times(options: &[&str]) -> Vec<f64> {
    let name = format!("kin-default-motion-{}-{}.csv", std::process::id(), options.concat());
    let file = std::env::temp_dir().join(name);
    let out = file.to_str().expect("a path of characters");
    let line = ["rockers", "sweep", "left.phi", "--out", out];
    let status = cli::run_from::<Rockers>(line.iter().chain(options));
    assert_eq!(format!("{status:?}"), format!("{:?}", std::process::ExitCode::SUCCESS), "{options:?}");
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    text.lines().skip(1).map(|row| row.split(',').next().unwrap().parse().unwrap()).collect()
}

/// The rockers lock where floater and right are in line: 1.5² + 1² − 2·1.5·cos φ = 1.9².
#[test]
fn a_motion_that_locks_in_its_first_step_ends_at_the_limit() {
    let locks = ((1.5_f64.powi(2) + 1.0 - 1.9_f64.powi(2)) / 3.0).acos() - 1.2;
    for steps in ["1", "3", "7"] {
        let found = times(&["--steps", steps]);
        assert!(found.len() > 2 && found[0] == 0.0, "{found:?}");
        assert!((found.last().unwrap() - locks).abs() < 1e-9, "{found:?} and {locks}");
    }
    // Otherwise the rows are those of the whole turn, as far as it goes.
    let found = times(&["--steps", "100"]);
    assert!((found[1] - std::f64::consts::TAU / 100.0).abs() < 1e-12 && *found.last().unwrap() < locks, "{found:?}");
}
