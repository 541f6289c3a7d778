//! Tests of the command line as a process with its streams and exit status.

use std::path::PathBuf;
use std::process::{Command, Stdio};

mod arc;
mod between_limits;
mod completions;
mod files;
mod forces;
mod help;
#[cfg(target_os = "linux")]
mod interrupt;
mod matrices;
mod no_limit;
mod options;
mod pictures;
mod plan;
mod quantities;
mod terminal;
mod turns;
mod unclosed;
mod unwatched;
mod values;

use serde_json::Value;

/// The result of one run.
struct Ran {
    status: Option<i32>,
    out: String,
    err: String,
}

fn kin(line: &str) -> Ran {
    let output = Command::new(env!("CARGO_BIN_EXE_several"))
        .args(line.split_whitespace())
        .stdin(Stdio::null())
        .output()
        .expect("the program starts");
    Ran {
        status: output.status.code(),
        out: String::from_utf8(output.stdout).expect("stdout is UTF-8"),
        err: String::from_utf8(output.stderr).expect("stderr is UTF-8"),
    }
}

/// The output of a run that succeeds without messages.
fn good(line: &str) -> String {
    let ran = kin(line);
    assert_eq!((ran.status, ran.err.as_str()), (Some(0), ""), "{line}");
    ran.out
}

fn json(line: &str) -> Value {
    serde_json::from_str(&good(line)).expect("one JSON document")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
}

fn failed(line: &str, status: i32, expected: &[&str]) -> Ran {
    let ran = kin(line);
    assert_eq!(ran.status, Some(status), "{line}: {}", ran.err);
    for text in expected {
        assert!(ran.err.contains(text), "{line}: `{text}` is not in\n{}", ran.err);
    }
    assert!(ran.err.starts_with("error: ") || ran.err.contains("\nerror: "), "{line}: {}", ran.err);
    ran
}

#[test]
fn the_report_names_everything_and_fits_the_screen() {
    let text = good("fourbar");
    let parts = [
        "FourbarLectureMid",
        "crank, coupler, rocker",
        "degrees of freedom",
        "fully driven",
        "scleronomic",
        "rheonomic",
        "bilateral",
        "crank.phi",
        "0.785398",
        "2.300000",
        "revolute",
        "driver",
        "condition",
        "worst error",
    ];
    for part in parts {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    for line in text.lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }
    // Numbers of ordinary size are printed without exponents.
    let tables = text.split("Checks").next().unwrap_or_default();
    assert!(!tables.lines().filter(|l| l.contains("coupler.")).any(|l| l.contains("e-")), "{tables}");
}

#[test]
fn solve_json_has_the_documented_keys_in_order() {
    let text = good("fourbar solve --at 0.5 --format json");
    let keys = ["t", "coordinates", "q", "q_dot", "q_ddot", "points", "bodies", "defines", "joints", "mechanism"];
    let places: Vec<_> = keys.iter().map(|k| text.find(&format!("\n  \"{k}\": "))).collect();
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}\n{text}");
    let solved: Value = serde_json::from_str(&text).expect("one JSON object");
    assert_eq!(solved["coordinates"].as_array().map(Vec::len), Some(9));
    assert_eq!((numbers(&solved["q"]).len(), numbers(&solved["q_ddot"]).len()), (9, 9));
    for part in ["r", "v", "a"] {
        assert_eq!(numbers(&solved["points"]["B"][part]).len(), 2);
    }
    let crank = numbers(&solved["q"])[2];
    assert_eq!(solved["bodies"]["crank"]["phi"].as_f64(), Some(crank));
    assert!((crank - (std::f64::consts::FRAC_PI_4 + 2.3 * 0.5)).abs() < 1e-12);
    assert_eq!(solved["degrees_of_freedom_left"], 0);
    let held = json("ends solve --format json");
    assert_eq!(held["bodies"]["crank"]["x"].as_f64(), Some(0.0));
}

#[test]
fn sweep_csv_is_a_header_and_one_row_per_instant() {
    let text = good("fourbar sweep --from -1 --to 1 --steps 8 --format csv");
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("t,crank.x,crank.x_dot,crank.x_ddot,crank.y,crank.y_dot,crank.y_ddot,crank.phi,"));
    assert_eq!((lines.len(), lines[0].split(',').count()), (10, 28));
    let first: Vec<f64> = lines[1].split(',').map(|n| n.parse().expect("a number")).collect();
    assert_eq!((first.len(), first[0]), (28, -1.0));
    let solved = json("fourbar sweep --times -1,1 --format json");
    let (q, last) = (numbers(&solved["states"][1]["q"]), lines[9]);
    let row: Vec<f64> = last.split(',').map(|n| n.parse().expect("a number")).collect();
    for (k, value) in q.iter().enumerate() {
        assert!((row[1 + 3 * k] - value).abs() < 1e-9, "far-apart instants give the same branch");
    }
}

#[test]
fn info_json_counts() {
    let info = json("fourbar info --format json");
    assert_eq!(info["degrees_of_freedom"], 1);
    assert_eq!(info["rows"].as_array().map(Vec::len), Some(9));
    assert_eq!(info["rows"][8]["joint"], "drive");
    assert_eq!(info["rows"][8]["classes"], serde_json::json!(["holonomic", "rheonomic", "bilateral"]));
    for operation in ["add", "mul", "neg", "div", "sqrt", "sincos", "function"] {
        assert!(info["operations"][operation].is_u64(), "{operation}");
    }
    assert_eq!(info["operations"]["sincos"], 3);
    let twice = json("redundant info --format json");
    assert_eq!((twice["rank"].as_u64(), twice["redundant"].as_array().map(Vec::len)), (Some(12), Some(1)));
}

#[test]
fn info_is_given_as_far_as_it_goes_without_a_configuration() {
    let ran = failed("infeasible info --format json", 1, &["not assembled", "need a configuration"]);
    let info: Value = serde_json::from_str(&ran.out).expect("one JSON object");
    assert!(info["degrees_of_freedom"].is_null() && info["rows"].is_array());
    let solve = failed("infeasible solve --format json", 1, &["not assembled at t = 0", "--guess"]);
    assert_eq!(solve.out, "");
}

#[test]
fn info_tells_the_rank_of_a_singular_configuration() {
    failed("singular solve --at 0.475", 1, &["singular configuration at t = 0.475: rank 8 instead of 9"]);
    assert_eq!(json("singular info --at 0.475 --format json")["rank"], 8);
    assert_eq!(json("singular info --at 0.1 --format json")["rank"], 9);
}

#[test]
fn check_passes() {
    for name in ["fourbar", "ends", "redundant", "singular"] {
        assert!(good(&format!("{name} check")).ends_with("  passed\n"), "{name}");
    }
}

#[test]
fn an_under_driven_mechanism_says_what_could_be_given() {
    let open = ["under-driven", "could be given: ", "crank2.phi", "--given", "--least-norm"];
    for command in ["solve", "sweep --to 1 --steps 2", ""] {
        let ran = failed(&format!("underdriven {command}"), 1, &open);
        assert!(!ran.err.contains("crank1.phi"), "what the driver moves is not open: {}", ran.err);
    }
    let given = json("underdriven solve --given crank2.phi=2.5:-0.4:0.1 --format json");
    assert_eq!(given["degrees_of_freedom_left"], 0);
    for (key, expected) in [("phi", 2.5), ("phi_dot", -0.4), ("phi_ddot", 0.1)] {
        let value = given["bodies"]["crank2"][key].as_f64().expect("a number");
        assert!((value - expected).abs() < 1e-12, "{key} = {value}");
    }
    let least = kin("underdriven solve --least-norm --format json");
    assert_eq!(least.status, Some(0));
    assert_eq!(least.err, "note: 1 degree of freedom left open; this is the answer of least norm\n");
    let check = kin("underdriven check");
    assert_eq!((check.status, check.err), (Some(0), least.err));
    let moved = json("underdriven sweep --to 0.5 --steps 5 --given crank2.phi=2.5:0.2 --format json");
    let phi = numbers(&moved["states"][5]["q"])[5];
    assert!((phi - 2.6).abs() < 1e-12, "{phi}");
    assert_eq!(json("underdriven info --format json")["degrees_of_freedom"], 2);
}

#[test]
fn what_is_given_twice_or_against_the_rows_is_refused() {
    failed("fourbar solve --given crank.phi=0.1", 1, &["`crank.phi` = 0.1 cannot be given"]);
    let open = "could be given, 1 of them: crank2.x";
    failed("underdriven solve --given crank2.phi=2.5,link2.phi=0.1", 1, &["`link2.phi` = 0.1 cannot be given", open]);
    failed("underdriven solve --given crank1.phi=1.2", 1, &["`crank1.phi` = 1.2 cannot be given", open]);
}

#[test]
fn a_sweep_that_ends_early_keeps_its_rows() {
    let line = "singular sweep --from 0 --to 0.6 --steps 6 --format csv";
    let ran = failed(line, 1, &["the sweep ended early: 5 of 7 instants written", "t = "]);
    assert_eq!(ran.out.lines().count(), 6, "{}", ran.out);
    let file = temporary("early.json");
    let ran = failed(&format!("singular sweep --to 0.6 --steps 6 --out {}", file.display()), 1, &["ended early"]);
    let written: Value = serde_json::from_str(&std::fs::read_to_string(&file).expect("a file")).expect("JSON");
    assert_eq!((ran.out.as_str(), &written["complete"]), ("", &Value::Bool(false)));
    std::fs::remove_file(file).expect("the file goes");
}

#[test]
fn inputs_come_with_value_rate_and_acceleration() {
    let inputs = "--input motor[0]=-0.5,0.8,-0.3 --input motor[1]=-2.6,-0.9";
    let solved = json(&format!("leg solve --format json {inputs}"));
    assert_eq!(numbers(&serde_json::json!([-0.5, 0.8, -0.3])), rates(&solved["inputs"]["motor[0]"]));
    assert_eq!(numbers(&serde_json::json!([-2.6, -0.9, 0.0])), rates(&solved["inputs"]["motor[1]"]));
    // The angle of the second thigh is that of the second motor.
    let ratio = &solved["input_ratios"]["motor[1]"];
    let first = numbers(&ratio["first"]);
    assert!(first[2].abs() < 1e-15 && (first[5] - 1.0).abs() < 1e-15, "{first:?}");

    // Over a time grid the inputs continue with constant acceleration.
    let swept = json(&format!("leg sweep --from 1 --to 1.5 --steps 1 --format json {inputs}"));
    let (value, rate) = (-0.5 + 0.5 * (0.8 - 0.25 * 0.3), 0.8 - 0.5 * 0.3);
    let last = rates(&swept["states"][1]["inputs"]["motor[0]"]);
    assert!((last[0] - value).abs() < 1e-15 && (last[1] - rate).abs() < 1e-15, "{last:?}");
    let q = numbers(&swept["states"][1]["q"]);
    assert!((q[2] - value).abs() < 1e-12, "{q:?}");
    let at_once = json(&format!(
        "leg solve --at 1.5 --format json --input motor[0]={value},{rate},-0.3,motor[1]={},-0.9",
        -2.6 - 0.45
    ));
    for (a, b) in numbers(&at_once["q_ddot"]).iter().zip(numbers(&swept["states"][1]["q_ddot"])) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }

    assert!(good(&format!("leg check {inputs}")).contains("passed"));
    assert!(good(&format!("leg info {inputs}")).contains("2  motor[0], motor[1]\n"));
    failed("leg solve --input motor[0]=1", 2, &["inputs without a value: motor[1]", "write --input motor[1]=value"]);
    failed("leg solve --input motor[2]=1", 2, &["no input named `motor[2]`"]);
    failed("leg solve --input motor=1", 2, &["motor[0]"]);
    failed("leg sweep --to 1", 2, &["inputs without a value"]);
}

fn rates(input: &Value) -> Vec<f64> {
    ["value", "rate", "acceleration"].map(|part| input[part].as_f64().expect("a number")).to_vec()
}

#[test]
fn bad_options_are_named_with_status_2() {
    failed("fourbar solve --set l9=1", 2, &["--set: no parameter named `l9`; did you mean", "l1, l2, l3, d1, d2, w"]);
    failed("fourbar solve --set l1=NaN", 2, &["--set l1: `NaN` is not finite"]);
    failed("fourbar solve --guess rocker=1", 2, &["--guess: no coordinate named `rocker`"]);
    failed("fourbar solve --input u=1", 2, &["this mechanism has no inputs"]);
    failed("fourbar sweep --to 1 --steps 0", 2, &["--steps"]);
    failed("fourbar sweep --times 0,1 --to 2", 2, &["--times: cannot be combined with --to"]);
    failed("fourbar sweep --times 0,nan", 2, &["--times"]);
    failed("fourbar swep", 2, &["swep"]);
    failed("fourbar --at 1 solve", 2, &["Options follow the command"]);
    failed("fourbar solve --at", 2, &["--at"]);
    let twice = failed("fourbar solve --at 1 --at 2", 2, &["multiple times"]);
    assert!(!twice.err.contains("behind the command"), "{}", twice.err);
}

#[test]
fn negative_numbers_are_values() {
    assert_eq!(json("fourbar solve --at -0.5 --set d2=-0.1,d1=.38 --format json")["t"], -0.5);
    assert_eq!(good("fourbar sweep --times -1,0,1 --format csv").lines().count(), 4);
    assert_eq!(good("fourbar sweep --from -1 --to -.5 --steps 1 --format csv").lines().count(), 3);
}

#[test]
fn guesses_choose_the_branch() {
    let angle = |guess: &str| {
        let solved = json(&format!("fourbar solve --guess coupler.phi={guess} --format json"));
        numbers(&solved["q"])[5]
    };
    assert!((angle("0.9,rocker.phi=5.0") - angle("-0.6,rocker.phi=1.4")).abs() > 0.5);
}

fn temporary(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("kin-cli-{}-{name}", std::process::id()))
}

#[test]
fn limits_are_reported_where_they_are_met() {
    let ran = kin("limits sweep --to 2 --steps 4 --format csv");
    assert_eq!((ran.status, ran.out.lines().count()), (Some(0), 6), "one row per instant: {}", ran.out);
    assert!(
        ran.err.starts_with("note: violated at the first instant: front, moving\nevent: t = 0.641046: front"),
        "{}",
        ran.err
    );
    assert!(ran.err.contains(": front satisfied again (slider.x < far)\n"), "{}", ran.err);
    assert!(
        ran.err.contains("event: t = 1.570796: ") && ran.err.contains(": reach touched (distance(pin, eye) > 2*r)")
    );
    let ran = kin("limits sweep --to 2 --steps 4 --format json");
    let whole: Value = serde_json::from_str(&ran.out).expect("one JSON document");
    assert_eq!(whole["violated_at_start"], serde_json::json!(["front", "moving"]));
    let events = whole["events"].as_array().expect("a list");
    assert_eq!(events.len(), 8);
    assert_eq!((&events[1]["name"], &events[1]["crossing"]), (&"slope".into(), &"violated".into()));
    assert_eq!((&whole["complete"], &whole["stopped"]), (&true.into(), &false.into()));
    let ran = kin("limits sweep --to 2 --steps 4 --format json --stop-at-events");
    let stopped: Value = serde_json::from_str(&ran.out).expect("one JSON document");
    assert_eq!((ran.status, &stopped["complete"], &stopped["stopped"]), (Some(0), &false.into(), &true.into()));
    let states = stopped["states"].as_array().expect("a list");
    assert_eq!((states.len(), &states[2]["q"]), (3, &events[0]["q"]));
    assert!(ran.err.ends_with("note: the sweep stopped there; the last row is the event\n"), "{}", ran.err);
}

#[test]
fn conditions_are_listed_with_their_margins() {
    let info = json("limits info --format json");
    assert_eq!(info["conditions"][5]["condition"], "slider.x - l < ahead + gap*t");
    assert_eq!(info["conditions"][5]["classes"], serde_json::json!(["holonomic", "rheonomic", "unilateral"]));
    assert_eq!((&info["counts"]["conditions"], &info["counts"]["rows"]), (&9.into(), &9.into()));
    let solved = json("limits solve --format json");
    let front = &solved["conditions"]["front"];
    assert!((front["value"].as_f64().expect("a number") + 0.05).abs() < 1e-12);
    assert_eq!(front["satisfied"], false);
    let text = good("limits solve");
    assert!(text.contains("Unilateral conditions") && text.contains("mark[2]    satisfied   0.100000"), "{text}");
    assert!(good("limits info").contains("  conditions           9  front, back, height"));
}

#[test]
fn supplied_functions_are_listed_and_checked() {
    let text = good("cam info");
    assert!(text.contains("supplied functions") && text.contains("lift"), "{text}");
    assert_eq!(json("cam info --format json")["functions"][0], "lift");
    assert!(good("cam solve --set a=0.2,omega=3 --at 0.1").contains("follower.y"));
    let check = json("cam check --format json");
    assert_eq!(check["cross_check"]["functions"][0]["function"], "lift");
    assert!(check["cross_check"]["functions"][0]["arguments"].as_u64().expect("a count") > 100);
    let parts = ["the derivatives of a supplied function differ from its difference quotients", "`lift`: f″ is"];
    let wrong = failed("wrong_cam check", 1, &parts);
    assert!(wrong.out.contains("FAILED") && wrong.out.contains("f″ of `lift`"), "{}", wrong.out);
}
