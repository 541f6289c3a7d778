//! What the program says of the plan, of assembly modes, and of the comparison with full Newton.

use serde_json::Value;

use super::{failed, good, json, kin, numbers};

#[test]
fn info_prints_the_plan_and_its_modes() {
    let text = good("fourbar info");
    for part in
        ["Solution plan", "drive gives crank.phi", "dyad RRR of A, B, D in closed form, mode A-B-D", "singular with"]
    {
        assert!(text.contains(part), "`{part}` is not in\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    let info = json("fourbar info --format json");
    assert!(info["plan"]["absent"].is_null());
    let mode = &info["plan"]["modes"][0];
    assert_eq!((mode["name"].as_str(), mode["group"].as_str()), (Some("A-B-D"), Some("RRR")));
    let sign = mode["sign"].as_str().expect("a sign");
    assert_eq!(mode["closure"].as_f64().expect("a number") > 0.0, sign == "+");
    let steps = info["plan"]["steps"].as_array().expect("steps");
    let given: usize = steps.iter().map(|step| step["coordinates"].as_array().map_or(0, Vec::len)).sum();
    assert_eq!(given, 9);

    // A list of joints is not continued by what they give.
    let text = good("robot info");
    let iterated = text.lines().find(|line| line.contains(" Newton iteration of ")).expect("an iteration");
    assert!(iterated.contains(": "), "{text}");

    let none = kin("underdriven info").out;
    assert!(none.contains("Solution plan\n  none: "), "{none}");
}

#[test]
fn a_mode_can_be_asked_for() {
    let q = |line: &str| numbers(&json(line)["q"]);
    let as_guessed = json("fourbar solve --format json");
    let sign = as_guessed["modes"][0]["sign"].as_str().expect("a sign").to_owned();
    let other = if sign == "+" { "-" } else { "+" };
    assert_eq!(q(&format!("fourbar solve --mode A-B-D={sign} --format json")), numbers(&as_guessed["q"]));
    let flipped = json(&format!("fourbar solve --mode A-B-D={other} --format json"));
    assert_eq!(flipped["modes"][0]["sign"].as_str(), Some(other));
    assert!((numbers(&flipped["q"])[5] - numbers(&as_guessed["q"])[5]).abs() > 0.1);
    let sweep = json(&format!("fourbar sweep --to 1 --steps 5 --mode A-B-D={other} --format json"));
    assert_eq!(sweep["fallbacks"].as_array().map(Vec::len), Some(0));
    assert_eq!(numbers(&sweep["states"][0]["q"]), numbers(&flipped["q"]));
    assert!(good("fourbar solve").contains("Assembly modes"));

    failed("fourbar solve --mode A-B-C=+", 2, &["no mode named `A-B-C`; did you mean `A-B-D`?"]);
    failed("fourbar solve --mode A-B-D=up", 2, &["--mode A-B-D: `up` is no sign; write + or -"]);
    failed("underdriven solve --least-norm --mode A=+", 2, &["--mode: there are no modes, because there is no plan"]);
}

/// Without random configurations a check says why there is no solution either.
#[test]
fn a_check_of_nothing_says_why() {
    failed("fourbar check --configurations 0 --set l1=3", 1, &["not assembled at t = 0"]);
}

#[test]
fn check_compares_the_plan_with_full_newton() {
    let text = good("fourbar check");
    assert!(text.contains("compared with full Newton"), "{text}");
    let check = json("fourbar check --configurations 10 --format json");
    assert_eq!(check["plan"]["configurations"].as_u64(), Some(11));
    assert!(check["plan"]["max_error"].as_f64().is_some_and(|error| error < 1e-12));
    let none: Value = serde_json::from_str(&kin("underdriven check --format json").out).expect("one JSON document");
    assert!(none["plan"].is_null());
}
