//! Values and names that options give.

use super::{failed, good, json, kin};

/// A unit that is many times another is not rounded to a whole multiple of it.
#[test]
fn large_units_keep_their_digits() {
    let solved = json("dial solve theta --set turned=1Grad --format json");
    let theta = solved["quantities"]["theta"].as_f64().expect("a number");
    assert!((theta - 57_295_779_513.082_32).abs() < 2e-5, "{theta}");
    let exact = json("dial solve theta --set turned=1turn --format json");
    assert_eq!(exact["quantities"]["theta"].as_f64(), Some(360.0));
}

/// With `--from limit` the values of inputs are those at t = 0, wherever the motion ends.
#[test]
fn inputs_of_a_motion_from_a_limit_are_those_at_zero() {
    for (rest, first, last) in [
        ("--from limit --to -1 --input place=0.7,0.1", 0.5, 0.6),
        ("--from limit --to 1 --input place=0.7,0.1", 0.5, 0.8),
        ("--from limit --to limit --input place=0.7,0.1", 0.5, 0.9),
        // These do not close at t = 0.
        ("--from limit --to limit --input place=1.05,0.1", 0.5, 0.9),
        ("--from limit --to -2 --input place=1.05,0.1", 0.5, 0.85),
    ] {
        let ran = kin(&format!("dead_centre sweep place {rest} --steps 4 --format csv"));
        assert_eq!(ran.status, Some(0), "{rest}: {}", ran.err);
        let rows: Vec<Vec<f64>> =
            ran.out.lines().skip(1).map(|row| row.split(',').map(|x| x.parse().expect("a number")).collect()).collect();
        let start: f64 = if rest.contains("1.05") { 1.05 } else { 0.7 };
        for row in &rows {
            assert!((row[1] - (start + 0.1 * row[0])).abs() < 1e-9, "{rest}: {row:?}");
        }
        let ends = [rows[0][1], rows[rows.len() - 1][1]];
        assert!((ends[0] - first).abs() < 1e-9 && (ends[1] - last).abs() < 1e-9, "{rest}: {ends:?}");
    }
}

/// Notes about several motions say which one they are about.
#[test]
fn notes_on_several_motions_have_their_names() {
    let said = kin("pushed sweep --to 0.8 --steps 2 --vary least=0.7,0.9 --format csv").err;
    for line in [
        "event: least = 0.7: t = 0.5: high violated (slider.x < 0.85)\n",
        "note: least = 0.9: violated at the first instant: low\n",
        "event: least = 0.9: t = 0.5: high violated (slider.x < 0.85)\n",
    ] {
        assert!(said.contains(line), "{said}");
    }
    let alone = kin("pushed sweep --to 0.8 --steps 2 --vary least=0.7 --format csv").err;
    assert_eq!(alone, "event: t = 0.5: high violated (slider.x < 0.85)\n");
    let extremes = kin("pushed extremes slider.x --to 0.8 --vary least=0.7,0.9").err;
    assert!(extremes.contains("event: least = 0.9: t = 0.5: high violated"), "{extremes}");
}

/// A quantity is one column, and one key of a JSON object.
#[test]
fn a_quantity_is_named_once() {
    for command in ["solve", "sweep", "extremes", "sensitivities"] {
        failed(&format!("fourbar {command} crank.phi B.x crank.phi"), 2, &["WHAT: `crank.phi` is named twice"]);
    }
}

/// Where velocities are integrated a limit has no row of its own, and the help says so.
#[test]
fn the_help_says_which_limits_have_a_row() {
    let help = good("fourbar sweep --help");
    assert!(help.contains("The last row is the limit itself, at which rates have no value, unless"), "{help}");
}
