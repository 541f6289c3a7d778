//! Quantities of one instant by name, and the units beside the numbers of the tables.

use serde_json::Value;

use super::{failed, good, json, kin};

/// The numbers of a CSV with one row, with their names.
fn row(line: &str) -> Vec<(String, f64)> {
    let text = good(line);
    let [names, values] = [0, 1].map(|k| text.lines().nth(k).expect("two lines").split(','));
    names.map(str::to_owned).zip(values.map(|value| value.parse().expect("a number"))).collect()
}

/// The Jacobian of the excavator's tip is a list of velocity ratios, and the tip's velocity is their sum times the
/// rates of the cylinders.
#[test]
fn the_jacobian_of_a_point_is_told_at_one_instant() {
    let inputs = "boom_length=1.42,0.1 --input stick_length=1.94,-0.07 --input bucket_length=1.17,0.03";
    let ratios = "tip.x/boom_length tip.x/stick_length tip.x/bucket_length";
    let found = row(&format!("excavator solve {ratios} tip.x_dot --input {inputs} --format csv"));
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names.join(" "), format!("t {ratios} tip.x_dot"));
    let sum: f64 = found[1..4].iter().zip([0.1, -0.07, 0.03]).map(|((_, ratio), rate)| ratio * rate).sum();
    assert!(found[1..4].iter().all(|(_, ratio)| ratio.abs() > 1e-3), "{found:?}");
    assert!((sum - found[4].1).abs() < 1e-12, "{sum} instead of {}", found[4].1);
}

#[test]
fn quantities_of_an_instant_are_those_of_a_sweep() {
    let what = "rocker.phi rocker.phi/drive B.transmission";
    let swept = row(&format!("fourbar sweep {what} --times 0.3,0.4 --degrees --format csv"));
    let solved = row(&format!("fourbar solve {what} --at 0.3 --degrees --format csv"));
    for ((name, a), (_, b)) in swept.iter().zip(&solved) {
        assert!((a - b).abs() < 1e-9, "{name}: {a} and {b}");
    }
    let record = json(&format!("fourbar solve {what} --at 0.3 --degrees --format json"));
    let number = |value: &Value| value.as_f64().expect("a number");
    assert!((number(&record["quantities"]["rocker.phi/drive"]) - solved[2].1).abs() < 1e-12, "{record}");
    assert_eq!((number(&record["t"]), &record["units"]["angle"]), (0.3, &Value::from("deg")));

    let text = good(&format!("fourbar solve {what} --at 0.3"));
    assert!(text.lines().next().is_some_and(|line| line.ends_with("at t = 0.3")), "{text}");
    let line = text.lines().find(|line| line.contains("B.transmission")).expect("a line");
    assert!(line.ends_with("rad"), "{line}");
    failed("fourbar solve rocker.psi", 2, &["WHAT", "no quantity named `rocker.psi`", "quantities: t, crank.x"]);
    failed("fourbar solve rocker.phi --forces", 2, &["cannot be used with"]);
}

/// Every table with lengths or angles says their units, and those of degrees where angles are in degrees.
#[test]
fn tables_have_units() {
    for (options, angle) in [("", "rad"), (" --degrees", "°")] {
        let text = good(&format!("with_units solve{options}"));
        let both = format!("m, {angle}");
        let expected = [
            ("rod.x", "m"),
            ("rod.phi", angle),
            ("slider", both.as_str()),
            ("middle", "m"),
            ("turn", angle),
            ("lean", angle),
            ("B", angle),
        ];
        for (first, unit) in expected {
            let line = text.lines().find(|line| line.split_whitespace().next() == Some(first)).expect(first);
            assert!(line.ends_with(&format!("  {unit}")), "{line}");
        }
    }
    // Lengths without a unit have none.
    let text = good("loaded solve");
    let line = text.lines().find(|line| line.trim_start().starts_with("beam.x")).expect("a coordinate");
    assert!(line.ends_with(char::is_numeric), "{line}");
}

#[test]
fn times_in_sentences_are_rounded() {
    for command in ["solve --at pi/2", "--at pi/2", "check --at pi/2", "modes --at pi/2", "sensitivities --at pi/2"] {
        let text = good(&format!("fourbar {command}"));
        assert!(text.contains("t = 1.570796\n") || text.contains("t = 1.570796,"), "{command}: {text}");
    }
}

#[test]
fn poses_of_held_bodies_are_quantities() {
    let out = good("with_units sweep slider.y slider.phi_dot slider.x --input turn=0 --steps 1 --format csv");
    assert!(out.lines().skip(1).all(|line| line.contains(",0,0,")), "{out}");
    assert!(out.starts_with("t,slider.y,slider.phi_dot,slider.x"), "{out}");
}

/// Without names the search leaves out what is driven, unless nothing else changes.
#[test]
fn extremes_of_what_is_driven_are_found_where_nothing_else_changes() {
    let text = good("lever extremes --to 6");
    assert!(
        text.contains("lever.phi   -0.3  rad   4.712389") && text.contains("lever.phi       0.3  rad   1.570796"),
        "{text}"
    );
    assert!(!good("fourbar extremes").contains("\n  crank.phi"));
}

/// Beside a crossing of branches that the motion passes closely, instants are refused whose rates are rounding errors.
#[test]
fn an_extreme_that_cannot_be_resolved_says_so() {
    let ran = kin("nearly extremes rocker.phi_ddot --from -1 --to 1");
    assert!(ran.status == Some(0) && ran.out.contains("unresolved"), "{}", ran.out);
    assert!(ran.err.starts_with("note: the motion cannot be solved everywhere: within "), "{}", ran.err);
    // Farther from the crossing it is found.
    let resolved = good("nearly extremes rocker.phi_ddot --from -1 --to 1 --set more=1e-5");
    assert!(!resolved.contains("unresolved") && !resolved.contains("kink"), "{resolved}");
}

/// Among many crests of nearly one height the highest is found, and at a limit that is higher than all crests the limit.
#[test]
fn the_highest_of_many_crests_and_a_limit_are_found() {
    let most = |line: &str| {
        let json: serde_json::Value = serde_json::from_str(&kin(line).out).expect("JSON");
        let of = |end: &str| json["motions"][0]["extremes"][0][end].clone();
        [of("least"), of("greatest")]
    };
    let value = |extreme: &serde_json::Value| extreme["value"].as_f64().expect("a number");
    let wave = |u: f64| (60.0 * u).sin() + 0.003 * (u + 0.3).sin();
    let values = (0..=2_000_000).map(|k| wave(3.0 * f64::from(k) / 2e6));
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    let [least, greatest] = most("waves extremes crests --to 3 --set r=4 --format json");
    assert!((value(&least) - low).abs() < 1e-8 && (value(&greatest) - high).abs() < 1e-8, "{least} {greatest}");
    let [_, greatest] = most("waves extremes rising --to limit --format json");
    assert!((value(&greatest) - 1.001).abs() < 1e-12 && greatest["where"] == "limit", "{greatest}");
}

/// A crest at the first instant is there, and not a rounding error beside it.
#[test]
fn a_crest_at_an_end_of_the_motion_is_at_that_instant() {
    let most = json("waves extremes x --to 0.9 --format json")["motions"][0]["extremes"][0]["greatest"].clone();
    assert_eq!((&most["t"], &most["where"]), (&Value::from(0.0), &Value::from("first instant")), "{most}");
}

/// Of a motion without a single row nothing is said.
#[test]
fn a_motion_without_rows_has_no_table() {
    for command in ["extremes", "sensitivities drive.effort --to 1", "sweep drive.effort", "plot drive.effort"] {
        let ran = kin(&format!("balanced {command} --set m=-1"));
        assert!(ran.status == Some(1) && ran.err.contains("a mass of `rotor` is -1"), "{command}: {}", ran.err);
        assert_eq!(ran.out, "", "{command}");
    }
}

/// An empty table would hide that there is nothing to differentiate.
#[test]
fn a_quantity_without_derivatives_is_refused() {
    let held = "--given upper.phi=0.7,fore.phi=-0.2";
    let why = ["Arm: `upper.phi.effort` has no derivatives by dimensions here"];
    for line in ["sensitivities upper.phi.effort", "plot upper.phi.effort --tolerance a=1 --to 1 --out never.svg"] {
        failed(&format!("arm {line} {held}"), 1, &why);
    }
    assert!(
        good(&format!("arm sensitivities upper.phi {held}")).contains("no parameter changes any of these quantities")
    );
    // Nothing is determined along the redundant direction.
    failed("arm sensitivities upper.phi --least-norm", 1, &["at t = 0"]);
}

/// The list of limits is empty for what turns all the way and for what closes nowhere.
#[test]
fn an_empty_list_of_limits_is_explained() {
    let turns = kin("fourbar limits --format json");
    assert!(turns.out.trim() == "[]" && turns.err.contains("note: no range has a limit from t = 0"), "{}", turns.err);
    let nowhere = kin("infeasible limits --format json");
    assert!(
        nowhere.out.trim() == "[]" && nowhere.err.contains("note: it closes nowhere from t = 0"),
        "{}",
        nowhere.err
    );
}
