//! Every command from its arguments to its streams and status.

use std::f64::consts::PI;

use std::ffi::OsString;
use std::io::{self, Write};

use serde_json::Value;

use super::engine::Bound;
use super::fixture::{CrossHead, DRIVEN, FREE, WITH_INPUT};
use super::run;
use super::session::Surroundings;

/// The output and the status of a run.
#[derive(Debug)]
struct Ran {
    status: u8,
    out: String,
    err: String,
}

impl Ran {
    fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or(Value::Null)
    }
}

fn kind<const KIND: u8>(line: &str) -> Ran {
    let args = std::iter::once("cross_head").chain(line.split_whitespace()).map(OsString::from).collect();
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let status = run(&mut Bound::new(CrossHead::<KIND>::default()), args, &mut out, &mut err, Surroundings::plain());
    Ran { status, out: String::from_utf8_lossy(&out).into(), err: String::from_utf8_lossy(&err).into() }
}

fn driven(line: &str) -> Ran {
    kind::<DRIVEN>(line)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn near(value: &Value, expected: f64) {
    assert!((number(value) - expected).abs() < 1e-12, "{value} is not {expected}");
}

/// s and its derivatives for φ = angle, φ̇ = rate.
fn stroke(angle: f64, rate: f64) -> [f64; 3] {
    [0.1 * angle.cos(), -0.1 * angle.sin() * rate, -0.1 * angle.cos() * rate * rate]
}

#[test]
fn help_and_version_are_results() {
    for line in ["--help", "-h", "info --help", "solve --help", "sweep --help", "check --help", "--version"] {
        let ran = driven(line);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{line}");
        assert!(ran.out.contains("Example") || line == "--version", "{line}: {}", ran.out);
    }
    assert!(driven("--help").out.starts_with("A crank moves a cross-head."));
    assert!(driven("--version").out.starts_with("CrossHead"));
}

#[test]
fn bad_options_are_usage_errors() {
    let cases = [
        ("jump", "jump"),
        ("solve --at x", "--at: `x` is not a number"),
        ("solve --at NaN", "--at: `NaN` is not finite"),
        ("solve --at --format json", "a value is required for '--at <T>'"),
        ("solve --at -inf", "--at: `-inf` is not finite"),
        ("solve --at", "a value is required for '--at <T>'"),
        ("solve --format xml", "xml"),
        ("solve --set rr=1", "--set: no parameter named `rr`; did you mean `r`?\n  parameters: r, phi0, omega"),
        ("solve --set r=", "--set: `r` has no value"),
        ("solve --set r=inf", "--set r: `inf` is not finite"),
        ("solve --set r=1 --set r=2", "--set: `r` is set twice"),
        ("solve --guess crank.ph=1", "--guess: no coordinate named `crank.ph`; did you mean `crank.phi`?"),
        ("solve --given s=1:2:3:4", "--given s: `s` has 4 numbers"),
        ("solve --input u=1", "--input: `u`: this mechanism has no inputs"),
        ("solve --at 2mm", "--at: `2mm`: `t` is in s, and this is mm"),
        ("solve --set r=2s", "--set r: `2s`: `r` is in m, and this is s"),
        ("solve --set r=2furlong", "--set r: `2furlong`: no unit `furlong` is known; there are m, mm, in"),
        ("solve --at 1turn", "--at: an angle says when only if a crank is driven at constant speed"),
        ("solve --guess crank.phi=1m", "--guess crank.phi: `1m`: `crank.phi` is in rad, and this is m"),
        ("sweep --to 1 --steps 0", "--steps: at least 1"),
        ("sweep --to 1 --steps -3", "--steps: `-3` is no number of steps"),
        ("sweep --from 1 --to 1", "--from and --to are both 1"),
        ("sweep --to 1e300 --from 1e300", "--from and --to are both 1e300 (numbers of this size are"),
        ("sweep --vary r=1..2:3,phi0=1", "--vary: `r=1..2:3,phi0=1`: write --vary again for each further parameter"),
        ("sensitivities --tolerance r=-1mm", "--tolerance r: `-1mm` is negative"),
        ("sweep --times 0,1 --from 0", "--times: cannot be combined with --from"),
        ("sweep --times 0,,1", "--times: a number is missing"),
        ("info --format csv", "--format: `info` has no csv form"),
        ("check --format csv", "--format: `check` has no csv form"),
        ("--format csv", "--format: the report has no csv form"),
    ];
    for (line, expected) in cases {
        let ran = driven(line);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{line}");
        assert!(ran.err.starts_with("error: ") && ran.err.contains(expected), "{line}: {}", ran.err);
    }
}

#[test]
fn solve_gives_one_json_object_with_t_first() {
    let ran = driven("solve --at -0.5 --format json --set phi0=-0.2,omega=3");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert!(ran.out.starts_with("{\n  \"t\": -0.5,\n  \"coordinates\": ["));
    let json = ran.json();
    let [s, s_dot, s_ddot] = stroke(-1.7, 3.0);
    near(&json["q"][0], -1.7);
    near(&json["q"][1], s);
    near(&json["q_dot"][1], s_dot);
    near(&json["q_ddot"][1], s_ddot);
    near(&json["points"]["tip"]["r"][0], s);
    near(&json["points"]["tip"]["v"][0], s_dot);
    near(&json["points"]["tip"]["a"][0], s_ddot);
    near(&json["bodies"]["crank"]["phi_dot"], 3.0);
    near(&json["defines"]["twice"]["acceleration"], 2.0 * s_ddot);
    near(&json["joints"]["slide"]["stroke"]["rate"], s_dot);
    near(&json["parameters"]["omega"], 3.0);
    assert_eq!((json["degrees_of_freedom"].as_u64(), json["degrees_of_freedom_left"].as_u64()), (Some(1), Some(0)));
    near(&json["velocity_ratios"]["drive"]["first"][0], 1.0);
}

#[test]
fn sweep_csv_groups_every_coordinate_with_its_rates() {
    let ran = driven("sweep --from -1 --to 1 --steps 4 --format csv");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines.first(), Some(&"t,crank.phi,crank.phi_dot,crank.phi_ddot,s,s_dot,s_ddot"));
    assert_eq!(lines.len(), 6);
    for (line, t) in lines.iter().skip(1).zip([-1.0, -0.5, 0.0, 0.5, 1.0]) {
        let row: Vec<f64> = line.split(',').filter_map(|n| n.parse().ok()).collect();
        let expected: Vec<f64> = [t, 0.3 + 2.0 * t, 2.0, 0.0].into_iter().chain(stroke(0.3 + 2.0 * t, 2.0)).collect();
        assert!(row.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{line}: {expected:?}");
        assert_eq!(row.len(), expected.len());
    }
    let one = driven("solve --at 0.5 --format csv");
    assert_eq!((one.out.lines().count(), one.out.lines().next()), (2, lines.first().copied()));
    let more = driven("sweep --times -1,0,1 --points --format csv");
    assert!(more.out.starts_with("t,crank.phi,") && more.out.contains(",tip.x,tip.x_dot,tip.x_ddot,"));
}

#[test]
fn sweep_json_and_text() {
    let json = driven("sweep --times 0,10,-3 --format json").json();
    assert_eq!(json["complete"], Value::Bool(true));
    assert_eq!(json["states"].as_array().map(Vec::len), Some(3));
    near(&json["states"][1]["q"][0], 20.3);
    let text = driven("sweep --to 1 --steps 2").out;
    assert!(text.starts_with("CrossHead, 3 instants from t = 0 to t = 1\n"));
    assert!(text.contains("\n  0.5   1.300000"), "{text}");
}

#[test]
fn info_counts() {
    let ran = driven("info --format json");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let json = ran.json();
    assert_eq!(json["coordinates"], serde_json::json!(["crank.phi", "s"]));
    assert_eq!(json["rows"][1]["name"], "drive");
    assert_eq!(json["rows"][1]["driving"], true);
    assert_eq!(json["rows"][1]["classes"], serde_json::json!(["holonomic", "rheonomic", "bilateral"]));
    assert_eq!(json["operations"]["mul"], 5);
    assert_eq!(json["degrees_of_freedom"], 1);
    assert_eq!(json["counts"]["bodies"], 1);
    let text = driven("info").out;
    assert!(text.starts_with("CrossHead\n  A crank moves a cross-head.\n") && text.contains("degrees of freedom"));
}

#[test]
fn the_report_says_everything() {
    let ran = driven("");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for part in ["CrossHead", "degrees of freedom", "crank.phi", "0.300000", "holonomic", "tip", "worst error"] {
        assert!(ran.out.contains(part), "{part} is missing in\n{}", ran.out);
    }
    assert!(ran.out.lines().all(|l| l.chars().count() <= 100), "{}", ran.out);
    let json = driven("--at 0.5 --format json").json();
    near(&json["state"]["q"][0], 1.3);
    assert_eq!(json["check"]["passed"], true);
}

#[test]
fn check_passes() {
    let ran = driven("check --configurations 10");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert!(ran.out.ends_with("  passed\n"), "{}", ran.out);
    assert_eq!(driven("check --format json").json()["passed"], true);
}

#[test]
fn an_open_motion_needs_given_coordinates_or_least_norm() {
    for line in ["solve", "sweep --to 1", ""] {
        let ran = kind::<FREE>(line);
        assert_eq!(ran.status, 1, "{line}");
        assert!(ran.err.contains("under-driven at t = 0: 1 degree of freedom is left open"), "{line}: {}", ran.err);
        assert!(ran.err.contains("could be given: crank.phi, s"), "{line}: {}", ran.err);
    }
    assert_eq!(kind::<FREE>("solve --format json").out, "");
    let given = kind::<FREE>("solve --given crank.phi=0.7:2 --format json");
    assert_eq!((given.status, given.err.as_str()), (0, ""));
    let [s, s_dot, s_ddot] = stroke(0.7, 2.0);
    near(&given.json()["q"][1], s);
    near(&given.json()["q_dot"][1], s_dot);
    near(&given.json()["q_ddot"][1], s_ddot);
    assert_eq!(kind::<FREE>("solve --least-norm").status, 0);
    let sweep = kind::<FREE>("sweep --to 1 --steps 2 --given crank.phi=0.7:2 --format json").json();
    near(&sweep["states"][2]["q"][0], 2.7);
    assert_eq!(kind::<FREE>("info").status, 0);
    // The equations themselves are correct.
    let check = kind::<FREE>("check");
    assert_eq!(check.status, 0, "{}", check.err);
    assert_eq!(check.err, "note: 1 degree of freedom left open; this is the answer of least norm\n");
    assert!(check.out.contains("velocity Φ_q q̇ = −Φ_t") && check.out.ends_with("  passed\n"), "{}", check.out);
}

#[test]
fn what_is_given_must_fit() {
    let ran = driven("solve --given s=5");
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.starts_with("error: CrossHead: "), "{}", ran.err);
}

#[test]
fn inputs_need_values() {
    let ran = kind::<WITH_INPUT>("solve");
    assert_eq!((ran.status, ran.out.as_str()), (2, ""));
    assert!(ran.err.contains("write --input u=value,rate,acceleration"), "{}", ran.err);
    let json = kind::<WITH_INPUT>("solve --format json --input u=0.5,-1,2").json();
    near(&json["q"][0], 0.8);
    near(&json["q_dot"][0], 1.0);
    near(&json["q_ddot"][0], 2.0);
    let sweep = kind::<WITH_INPUT>("sweep --from 1 --to 2 --steps 1 --format json --input u=0.5,-1,2").json();
    near(&sweep["states"][1]["q"][0], 0.3 + 4.0 + 0.5);
    near(&sweep["states"][1]["q_dot"][0], 2.0 + 1.0);
    assert!(kind::<WITH_INPUT>("info").err.contains("taken as 0: u"));
    let check = kind::<WITH_INPUT>("check");
    assert_eq!(check.status, 0);
    assert!(check.out.contains("passed") && !check.out.contains("position"), "{}", check.out);
    assert!(check.err.contains("no solution is checked: inputs without a value: u"), "{}", check.err);
    assert!(kind::<WITH_INPUT>("check --input u=0.5").out.contains("position"));
}

#[test]
fn out_writes_a_file_and_nothing_else() {
    let dir = std::env::temp_dir().join(format!("kin-cli-{}", std::process::id()));
    assert!(std::fs::create_dir_all(&dir).is_ok());
    let file = dir.join("motion.csv");
    let ran = driven(&format!("sweep --to 1 --steps 2 --out {}", file.display()));
    assert_eq!((ran.status, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    assert!(std::fs::read_to_string(&file).is_ok_and(|t| t.starts_with("t,crank.phi,")));
    let bad = driven(&format!("solve --out {}", dir.join("missing/x.json").display()));
    assert_eq!(bad.status, 1);
    assert!(bad.err.starts_with("error: --out: cannot write "), "{}", bad.err);
    assert!(std::fs::remove_dir_all(&dir).is_ok());
}

/// A pipe whose reader has closed it.
struct Closed;

impl Write for Closed {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::BrokenPipe.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Err(io::ErrorKind::BrokenPipe.into())
    }
}

#[test]
fn a_reader_that_has_gone_is_told_nothing_and_the_status_says_so() {
    let args = ["cross_head", "--help"].map(OsString::from).to_vec();
    let mut err = Vec::new();
    assert_eq!(
        run(&mut Bound::new(CrossHead::<DRIVEN>::default()), args, &mut Closed, &mut err, Surroundings::plain()),
        141
    );
    assert!(err.is_empty());
}

#[test]
fn forces_without_masses_say_what_is_missing() {
    let ran = driven("sweep drive.effort");
    assert!(ran.err.contains("no quantity named `drive.effort`; forces need masses or loads"), "{}", ran.err);
    assert!(!driven("sweep drive.efort_x").err.contains("masses"));
}

#[test]
fn unknown_options_say_what_there_is() {
    let bad = |line: &str| {
        let ran = driven(line);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{line}");
        ran.err
    };
    let err = bad("solve --from 1");
    assert!(err.contains("--from is an option of `sweep`") && err.contains("\n`solve` has --at, --set,"), "{err}");
    #[cfg(feature = "plot")]
    {
        let err = bad("solve --vary r=0.1,0.2");
        assert!(err.contains("--vary is an option of `sweep`, `extremes` and `plot`\n`solve` has --at"), "{err}");
    }
    // The nearest option is suggested, and none where another command has the option itself.
    let err = bad("solve --st r=0.1");
    assert!(err.contains("similar argument exists: '--set'"), "{err}");
    let err = bad("sweep --at 1");
    assert!(err.contains("--at is an option of") && !err.contains("similar"), "{err}");
    let err = bad("--nothing");
    assert!(err.contains("the report has --at,") && !err.contains("is an option of"), "{err}");
}

#[test]
fn numbers_are_written_as_people_write_them() {
    let at = |line: &str| {
        let ran = driven(line);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{line}");
        ran.json()
    };
    let reference = at("solve --at 0.5 --set r=0.2,phi0=1.0471975511965976 --format json");
    let units = at("solve --at 500ms --set r=200mm,phi0=60deg --guess crank.phi=90° --format json");
    assert_eq!(reference["q"], units["q"]);
    assert_eq!(reference["parameters"]["r"], 0.2);
    assert_eq!(at("solve --at pi/2 --format json")["t"], std::f64::consts::FRAC_PI_2);
    let times = at("sweep --from -1/4 --to 2*0.5 --steps 1 --format json");
    assert_eq!((&times["states"][0]["t"], &times["states"][1]["t"]), (&(-0.25).into(), &1.0.into()));
    let given = kind::<FREE>("solve --given crank.phi=0.5turn:60rpm --format json").json();
    near(&given["q"][0], PI);
    near(&given["q_dot"][0], 2.0 * PI);
}

#[test]
fn degrees_are_of_angles_alone_and_json_says_so() {
    let both = |line: &str| {
        let [rad, deg] = ["", " --degrees"].map(|more| driven(&format!("{line}{more}")));
        assert_eq!((rad.status, deg.status), (0, 0), "{line}");
        (rad, deg)
    };
    let (rad, deg) = both("solve --at 0.5 --format json");
    let (rad, deg) = (rad.json(), deg.json());
    for part in ["q", "q_dot"] {
        near(&deg[part][0], rad[part][0].as_f64().unwrap_or(0.0).to_degrees());
        assert_eq!(deg[part][1], rad[part][1], "a length");
    }
    assert_eq!((&rad["units"]["angle"], &deg["units"]["angle"]), (&"rad".into(), &"deg".into()));
    near(&deg["bodies"]["crank"]["phi"], rad["q"][0].as_f64().unwrap_or(0.0).to_degrees());
    let (rad, deg) = both("sweep --times 0,1 --points --format csv");
    let numbers = |text: &str| -> Vec<f64> {
        text.lines().nth(2).unwrap_or_default().split(',').filter_map(|n| n.parse().ok()).collect()
    };
    let (rad, deg) = (numbers(&rad.out), numbers(&deg.out));
    assert!((deg[1] - rad[1].to_degrees()).abs() < 1e-9 && deg[4..] == rad[4..]);
    assert!(driven("solve --degrees").out.starts_with("CrossHead at t = 0, angles in degrees\n"));
    assert!(driven("sweep --times 0,1 --degrees").out.contains("from t = 0 to t = 1, angles in degrees\n"));
}

#[test]
fn what_comes_from_a_sweep_is_the_same_in_every_form() {
    let csv = driven("sweep --to 1 --steps 50 --points --format csv");
    let json = driven("sweep --to 1 --steps 50 --points --format json").json();
    let rows: Vec<Vec<f64>> =
        csv.out.lines().skip(1).map(|row| row.split(',').filter_map(|n| n.parse().ok()).collect()).collect();
    let states = json["states"].as_array().map_or(&[][..], Vec::as_slice);
    assert_eq!((rows.len(), states.len()), (51, 51));
    assert_eq!((&json["complete"], &json["units"]["length"]), (&true.into(), &"m".into()));
    for (row, state) in rows.iter().zip(states) {
        near(&state["t"], row[0]);
        near(&state["q"][0], row[1]);
        near(&state["q"][1], row[4]);
        near(&state["points"]["tip"]["r"][0], row[7]);
    }
    // Without --to the motion has a default end.
    let open = driven("sweep --steps 4 --format json").json();
    assert_eq!(open["states"].as_array().map(Vec::len), Some(5));
}
