//! The command `sensitivities`.

use kin_runtime::cli::run_from;
use kin_runtime::{Kinematics, mechanism};
use kin_tests::mechanisms::{FourbarLectureMid, loaded};
use serde_json::Value;
use std::process::ExitCode;

/// The exit code and the output of the command with these arguments.
fn written<M: kin_runtime::Mechanism + Default>(name: &str, args: &[&str]) -> (ExitCode, String) {
    let file = std::env::temp_dir().join(format!("kin-sensitivities-{}-{name}", std::process::id()));
    let path = file.to_string_lossy().into_owned();
    let all = ["mechanism", "sensitivities"].iter().chain(args).copied().chain(["--out", &path]);
    let status = run_from::<M>(all.map(str::to_owned).collect::<Vec<String>>());
    let text = std::fs::read_to_string(&file).unwrap_or_default();
    let _ = std::fs::remove_file(&file);
    (status, text)
}

#[test]
fn json_has_every_quantity_by_every_parameter() {
    let (status, text) =
        written::<FourbarLectureMid>("all.json", &["--at", "0.37", "--tolerance", "l1=0.1mm,l2=0.0002"]);
    assert_eq!(ExitCode::SUCCESS, status);
    let found: Value = serde_json::from_str(&text).unwrap();
    let mechanism = FourbarLectureMid::default();
    let solver = mechanism.solver();
    let exact = solver.sensitivities(&solver.state(&0.37.into()).unwrap()).unwrap();
    let near = |found: &Value, exact: f64| {
        let found = found.as_f64().unwrap();
        assert!((found - exact).abs() <= 1e-12 * exact.abs().max(1.0), "{found} instead of {exact}");
    };
    near(&found["t"], 0.37);
    assert_eq!("coupler.phi", found["coordinates"][5]);
    for by in &exact.by {
        for (key, list) in [("dq", &by.q), ("dq_dot", &by.q_dot), ("dq_ddot", &by.q_ddot)] {
            list.iter().enumerate().for_each(|(k, exact)| near(&found[key][by.parameter][k], *exact));
        }
        let point = &found["points"]["B"][by.parameter];
        for (key, list) in [("r", by.points[0].r), ("v", by.points[0].v), ("a", by.points[0].a)] {
            (0..2).for_each(|axis| near(&point[key][axis], list[axis]));
        }
        near(&found["joints"]["B"]["angle"][by.parameter]["value"], by.joints[2][0].value);
    }
    let deviation = exact.deviation(&[1e-4, 2e-4], |by| by.q[5]);
    near(&found["tolerances"]["coupler.phi"]["worst"], deviation.worst);
    near(&found["tolerances"]["coupler.phi"]["root_sum_square"], deviation.root_sum_square);
}

#[test]
fn efforts_stand_by_driver_and_parameter() {
    let (_, text) = written::<loaded::FourbarLectureMid>("forces.json", &["--at", "0.37"]);
    let found: Value = serde_json::from_str(&text).unwrap();
    let mechanism = loaded::FourbarLectureMid::default();
    let solver = mechanism.solver();
    let exact = solver.sensitivities(&solver.state(&0.37.into()).unwrap()).unwrap();
    for by in &exact.by {
        let effort = by.forces.as_ref().unwrap().efforts[0].effort.unwrap();
        let found = found["efforts"]["drive"][by.parameter]["value"].as_f64().unwrap();
        assert!((found - effort).abs() <= 1e-12 * effort.abs().max(1.0), "{found} instead of {effort}");
    }
}

#[test]
fn the_report_says_which_dimension_matters_most() {
    let (_, text) = written::<FourbarLectureMid>("report.txt", &["--at", "0.37"]);
    assert!(text.contains("Point B: which dimension matters most"), "{text}");
    let (_, table) = written::<FourbarLectureMid>("table.csv", &["--at", "0.37"]);
    assert!(table.starts_with("quantity,l1,l2,l3,d1,d2,w\n"), "{table}");
    let (status, _) = written::<FourbarLectureMid>("wrong.json", &["--tolerance", "l9=0.1"]);
    assert_ne!(ExitCode::SUCCESS, status);
}

#[test]
fn along_a_motion_it_tells_the_greatest_deviations_and_when() {
    let args = ["B.transmission", "B.y", "--to", "2", "--steps", "8", "--tolerance", "l1=0.1mm,l2=0.2mm"];
    let (status, text) = written::<FourbarLectureMid>("motion.json", &args);
    assert_eq!(ExitCode::SUCCESS, status);
    let found: Value = serde_json::from_str(&text).unwrap();
    let mechanism = FourbarLectureMid::default();
    let solver = mechanism.solver();
    let state = solver.sweep(&[0.0, 0.5]).unwrap().states.pop().unwrap();
    let exact = solver.sensitivities(&state).unwrap().deviation(&[1e-4, 2e-4], |by| by.points[0].r[1]);
    assert_eq!(9, found["t"].as_array().unwrap().len());
    let at = &found["quantities"]["B.y"]["deviations"][2];
    assert!((at["worst"].as_f64().unwrap() - exact.worst).abs() <= 1e-9 * exact.worst, "{at} instead of {exact}");
    assert!(found["quantities"]["B.transmission"]["by"]["l3"][8].as_f64().unwrap().abs() > 0.0, "{text}");

    let (_, text) = written::<FourbarLectureMid>("motion.txt", &args);
    assert!(text.contains("Greatest deviations for these tolerances"), "{text}");
    let (_, table) = written::<FourbarLectureMid>("motion.csv", &args);
    assert!(table.starts_with("t,B.transmission,B.transmission_worst,B.transmission_root_sum_square,B.y,"), "{table}");
    assert_eq!(10, table.lines().count());
    // An unknown quantity, and a velocity ratio, which has no derivatives.
    for wrong in ["B.nothing", "B.y/drive"] {
        let (status, _) = written::<FourbarLectureMid>("wrong.txt", &[wrong]);
        assert_ne!(ExitCode::SUCCESS, status);
    }
}

/// An arm that starts at rest and without a force, the tip of which may be off its axis.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[point(tip = arm @ (l, off))]
#[driver(drive: arm.phi = t*t*t)]
#[mass(arm @ (l, off), mass = 1)]
struct Arm {
    #[param(2)]
    l: f64,
    #[param(0)]
    off: f64,
}

/// One percent of 0 is 0, but a dimension that is 0 matters nevertheless.
#[test]
fn a_dimension_of_zero_is_listed() {
    let (_, text) = written::<Arm>("zero.txt", &["tip.x", "--at", "1"]);
    let rows: Vec<&str> = text.lines().filter(|line| line.contains("tip.x")).collect();
    let [by_l, by_off] = rows[..] else { panic!("{text}") };
    assert!(by_l.contains(" l ") && by_off.contains(" off ") && by_off.contains("-0.841471"), "{text}");
    let (_, text) = written::<Arm>("all_zero.txt", &["tip.x", "--at", "1", "--set", "l=0"]);
    assert!(!text.contains("no parameter changes"), "{text}");
}

/// As in all tables, a cell without a number is empty: the magnitude of a force that is 0 has no derivative.
#[test]
fn cells_without_a_derivative_are_empty() {
    let (_, table) = written::<Arm>("rest.csv", &["O.force", "--to", "1", "--steps", "1", "--format", "csv"]);
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(["t,O.force,O.force by l,O.force by off", "0,0,,"], rows[..2], "{table}");
}
