//! Whether a plan exists, and what the check of a plan reports: neither false alarms nor agreement where nothing was
//! compared.

use kin_runtime::cross_check::{Configuration, CrossCheckOptions};
use kin_runtime::{Kinematics, Mechanism, cli, mechanism};

/// A crank whose pin runs in a slot of an arm; the distance of the pivots is that of pin and crank pivot, so the arm
/// turns at half the crank's rate and all accelerations are 0.
#[mechanism]
#[bodies(crank, arm)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(D: ground @ (d, 0), arm @ (0, 0))]
#[point_on_line(slot: arm @ (0, 0), crank @ (r, 0), axis = (1, 0))]
#[driver(drive: crank.phi = 0.6 + 1.7 * t)]
#[guess(arm.phi = 1.9)]
struct SlottedArm {
    #[param(0.3)]
    r: f64,
    #[param(0.3)]
    d: f64,
}

/// Two links stretched out between two fixed pins: the only configuration is singular.
#[mechanism]
#[bodies(left, right)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: left @ (1, 0), right @ (0, 0))]
#[revolute(C: right @ (1, 0), ground @ (2, 0))]
struct Stretched;

/// As many rows as coordinates; one row is redundant with two others.
#[mechanism(allow_redundant)]
#[bodies(lower, upper)]
#[translational(floor: ground @ (0, 0), lower @ (0, 0), axis = (1, 0))]
#[translational(slope: lower @ (0, 0), upper @ (0, 0), axis = (4, 3))]
#[translational(wall: ground @ (1, 0), upper @ (0, 0), axis = (0, 1))]
struct Wedges;

#[test]
fn rounding_of_accelerations_that_cancel_is_no_error() {
    let mechanism = SlottedArm::default();
    let solver = mechanism.solver();
    let states = solver.sweep(&[0.0, 0.1, 0.25, 0.4, 0.55]).unwrap();
    let given = states.iter().map(|s| Configuration {
        t: s.t,
        q: s.q.clone(),
        q_dot: s.q_dot.clone(),
        inputs: s.inputs.clone(),
    });
    let options = CrossCheckOptions { given: given.collect(), ..CrossCheckOptions::default() };
    let check = solver.plan_check(&options).unwrap();
    assert!(check.configurations > 30 && check.max_error < 1e-12, "{check}");
    // All accelerations are 0 but for rounding, so that a relative error would compare rounding errors.
    assert!(states.iter().all(|s| s.q_ddot.iter().all(|a| a.abs() < 1e-12)));
}

#[test]
fn a_check_that_compares_nothing_says_so() {
    let file = std::env::temp_dir().join(format!("kin-plan-check-{}.txt", std::process::id()));
    let out = file.to_str().expect("a path of characters");
    let _ = cli::run_from::<Stretched>(["stretched", "check", "--configurations", "20", "--out", out]);
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = "compared with full Newton nothing all configurations are at or beyond limits of the plan";
    assert!(words.contains(line) && words.contains("where full Newton solves"), "{text}");
    // Only the report on the closed forms has an error.
    assert_eq!(words.matches("worst error").count(), 1, "{text}");
}

#[test]
fn rows_of_less_rank_than_coordinates_make_no_plan() {
    let model = Wedges::model();
    let structure = model.structure.unwrap();
    assert_eq!((Wedges::COORDINATES, Wedges::ROWS, structure.rank), (6, 6, 5));
    assert_eq!(model.plan.absent, Some("6 rows of rank 5 leave 1 of 6 coordinates undetermined"));
    assert_eq!(SlottedArm::model().plan.absent, None);
}

/// A gate on a hydraulic cylinder, in millimetres: it closes with strokes from 545 to 1351 only.
#[mechanism]
#[bodies(gate)]
#[input(stroke, unit = "mm")]
#[revolute(hinge: ground @ (0, 0), gate @ (0, 0))]
#[distance(cylinder: ground @ (-300, 900), gate @ (400, 50), length = stroke)]
#[guess(gate.phi = -0.5)]
struct Gate;

#[test]
fn inputs_without_values_are_drawn_around_those_that_fit_the_guess() {
    for check in [Gate.solver().plan_check(&CrossCheckOptions::default()), Gate.cross_check()] {
        let check = check.unwrap();
        assert!(check.configurations >= 16 && check.max_error < 1e-10, "{check}");
    }
}
