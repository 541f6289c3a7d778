//! Options take effect or are refused.

use serde_json::Value;

use super::{failed, good, json, kin, numbers};

/// Derivatives of angles in degrees, at one instant as along a motion.
#[test]
fn sensitivities_at_an_instant_are_in_degrees() {
    let derivatives = |options: &str| {
        let text = good(&format!("fourbar sensitivities --at 0.3 --format csv {options}"));
        let row = text.lines().find(|line| line.starts_with("coupler.phi,")).expect("a row").to_owned();
        let place = text.lines().find(|line| line.starts_with("coupler.x,")).expect("a row").to_owned();
        let of = |row: String| row.split(',').skip(1).map(|x| x.parse().expect("a number")).collect::<Vec<f64>>();
        (of(row), of(place))
    };
    let ((radians, place), (degrees, same_place)) = (derivatives(""), derivatives("--degrees"));
    assert_eq!(place, same_place);
    assert!(radians.iter().any(|x| x.abs() > 0.1));
    for (a, b) in radians.iter().zip(&degrees) {
        assert!((a.to_degrees() - b).abs() <= 1e-14 * b.abs(), "{a} {b}");
    }
    let [plain, turned] = ["", "--degrees"].map(|options| {
        let found = json(&format!("fourbar sensitivities --at 0.3 --tolerance l2=0.001 --format json {options}"));
        found["tolerances"]["coupler.phi"]["worst"].as_f64().expect("a number")
    });
    assert!((plain.to_degrees() - turned).abs() <= 1e-14 * turned, "{plain} {turned}");
    assert!(
        good("fourbar sensitivities --degrees").starts_with("FourbarLectureMid, sensitivities at t = 0, angles in")
    );
}

/// A closure has its number at the first instant of the motion: here nothing closes at t = 0.
#[test]
fn a_closure_is_that_of_the_first_instant() {
    let least = json("fourbar extremes rocker.phi --set l3=0.05 --mode closure=2 --from 0.3 --to 0.32 --format json");
    let varied = "fourbar sensitivities rocker.phi --set l3=0.05 --mode closure=2 --from 0.3 --to 0.32 --steps 1";
    let first = json(&format!("{varied} --format json"))["quantities"]["rocker.phi"]["value"][0].as_f64();
    assert_eq!(first, least["motions"][0]["extremes"][0]["least"]["value"].as_f64());
    let text = good(&format!("{varied} --degrees"));
    assert!(
        text.starts_with("FourbarLectureMid, sensitivities from t = 0.3 to t = 0.32, angles in degrees\n"),
        "{text}"
    );
}

/// A closure and a mode that contradict each other are refused, and the modes of a file give way to a closure.
#[test]
fn a_closure_contradicts_the_modes_of_another() {
    let at = "fourbar solve rocker.phi --mode closure";
    let value =
        |line: &str| json(&format!("{line} --format json"))["quantities"]["rocker.phi"].as_f64().expect("a number");
    let signs = json("fourbar modes --format json");
    for (number, other) in [(1, 2), (2, 1)] {
        let sign = |number: usize| signs[number - 1]["mode"].as_str().expect("a mode");
        let alone = value(&format!("{at}={number}"));
        assert_eq!(alone, value(&format!("{at}={number},{}", sign(number))));
        let said = format!("--mode: closure {number} is {}; leave one of both out", sign(number));
        failed(&format!("{at}={number},{}", sign(other)), 2, &[&said]);
        let (name, sign) = sign(other).split_once('=').expect("a sign");
        let file = std::env::temp_dir().join(format!("kin-modes-{}-{number}.json", std::process::id()));
        let text = format!("{{\"parameters\": {{}}, \"modes\": {{\"{name}\": \"{sign}\"}}}}");
        std::fs::write(&file, text).expect("a file");
        assert_eq!(alone, value(&format!("{at}={number} --set @{}", file.display())));
        std::fs::remove_file(&file).expect("it is there");
    }
}

/// A record with angles in degrees says so.
#[test]
fn derivatives_have_units() {
    for what in ["", "rocker.phi", "--to 0.1 --steps 1"] {
        for (options, angle) in [("", "rad"), ("--degrees", "deg")] {
            let found = json(&format!("fourbar sensitivities {what} {options} --format json"));
            assert_eq!(found["units"]["angle"], angle, "{what}");
        }
    }
}

/// Every motion of several says whether it is complete, also one that does not begin.
#[test]
fn a_motion_that_does_not_begin_is_not_complete() {
    let ran = kin("fourbar sweep rocker.phi --vary l1=0.1,3 --steps 2 --format json");
    let all: Value = serde_json::from_str(&ran.out).expect("JSON");
    let complete: Vec<&Value> = all["motions"].as_array().expect("a list").iter().map(|one| &one["complete"]).collect();
    assert_eq!((ran.status, complete), (Some(1), vec![&Value::from(true), &Value::from(false)]));
}

/// So does one whose limit cannot be searched for.
#[test]
fn a_motion_without_a_limit_to_be_found_is_not_complete() {
    let ran = kin("fourbar sweep rocker.phi --to limit --vary l1=3,0.4 --steps 2 --format json");
    let all: Value = serde_json::from_str(&ran.out).expect("JSON");
    let motions = all["motions"].as_array().expect("a list");
    let said = |k: usize| (motions[k]["varied"]["l1"].as_f64(), motions[k]["complete"].as_bool());
    assert_eq!((2, Some(1)), (motions.len(), ran.status), "{}", ran.err);
    assert_eq!((Some(3.0), Some(false)), said(0));
    assert_eq!(Some(0.4), said(1).0);
}

/// An instant is solved once, however it is written.
#[test]
fn no_instant_follows_itself() {
    let said = "--times: the instant 0 is given twice in succession";
    failed("fourbar sweep rocker.phi --times 0,0turn --format csv", 2, &[said]);
    good("fourbar sweep rocker.phi --times 0,1turn,0 --format csv");
}

/// What a command cannot do at the same time is refused, with both options in the message.
#[test]
fn options_that_exclude_one_another_are_refused() {
    for motion in ["--steps 4", "--times 0,1", "--from 0", "--to 1"] {
        let option = motion.split(' ').next().expect("an option");
        failed(&format!("fourbar sensitivities coupler.phi --at 0.3 {motion}"), 2, &["--at", option]);
    }
    good("fourbar sensitivities coupler.phi --steps 4");
    failed("limits sweep --along-arc --stop-at-events --steps 4", 2, &["--along-arc", "--stop-at-events"]);
    for command in ["modes", "limits"] {
        let said = format!("--mode: `{command}` lists all modes; leave `A-B-D=+` out");
        failed(&format!("fourbar {command} --mode A-B-D=+"), 2, &[&said]);
        assert!(!good(&format!("fourbar {command} --help")).contains("--mode NAME"));
    }
}

/// The bounds of a certificate enclose the numbers beside them.
#[test]
fn a_certificate_has_columns() {
    let text = good("fourbar solve --at 0.3 --certify --format csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((rows.len(), rows[0].len()), (2, 1 + 9 * 3 * 3));
    let value = |name: &str| {
        let place = rows[0].iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name}"));
        rows[1][place].parse::<f64>().expect("a number")
    };
    for name in ["crank.x", "coupler.phi", "rocker.phi_dot", "coupler.y_ddot"] {
        let [least, most] = ["lower", "upper"].map(|end| value(&format!("{name}_{end}")));
        assert!(least < most && most - least < 1e-9 && (value(name) - least).abs() < 1e-9, "{name}: {least} {most}");
    }
    let proven = json("fourbar solve --at 0.3 --certify --format json");
    let first = numbers(&proven["q"])[5];
    assert!(value("coupler.phi_lower") <= first + 1e-12 && first - 1e-12 <= value("coupler.phi_upper"));
}
