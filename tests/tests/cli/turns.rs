//! Turns of cranks whose angle is a scalar coordinate with a unit of its own.

use super::{json, kin, numbers};

/// An angle is a part of a turn, whatever the unit of the coordinate.
#[test]
fn an_angle_is_reached_in_the_unit_of_the_coordinate() {
    for (line, angle, t) in [
        ("dial solve --at 90deg", 90.0, 0.5),
        ("dial solve --at 0.25rev", 90.0, 0.5),
        ("counter solve --at 0.25rev", 0.25, 0.125),
        ("counter solve --at 90deg", 0.25, 0.125),
    ] {
        let solved = json(&format!("{line} --format json"));
        let (found, time) = (numbers(&solved["q"])[0], solved["t"].as_f64().expect("a time"));
        assert!((found - angle).abs() < 1e-12 * angle && (time - t).abs() < 1e-12, "{line}: {found} at {time}");
    }
}

/// The default motion of a crank at constant speed is a turn.
#[test]
fn the_default_motion_is_a_true_turn() {
    for (name, turn) in [("dial", 360.0), ("counter", 1.0)] {
        let swept = json(&format!("{name} sweep --steps 2 --format json"));
        let last = numbers(&swept["states"][2]["q"])[0];
        assert!((last - turn).abs() < 1e-9 * turn, "{name}: {last}");
    }
    let most = json("dial extremes x y --format json");
    for extremes in most["motions"][0]["extremes"].as_array().expect("a list") {
        let of = |end: &str| extremes[end]["value"].as_f64().expect("a number");
        assert!((of("least") + 40.0).abs() < 1e-9 && (of("greatest") - 40.0).abs() < 1e-9, "{extremes}");
    }
}

/// What has turned once is where it was; what is fed is not.
#[test]
fn a_search_for_a_limit_ends_after_the_turn_that_leads_back() {
    let said = |line: &str| kin(&format!("{line} sweep --to limit --steps 4")).err;
    assert_eq!(said("dial"), "note: no limit is met in a turn of the driven crank: the motion is one turn long\n");
    let fed = said("counter");
    assert_eq!(fed, "note: no limit is met in 100 turns of the driven crank: the motion is one turn long\n");
}
