//! The examples that search for dimensions have the results that their descriptions state.

#![allow(dead_code, unreachable_pub, missing_docs, reason = "programs of their own")]

#[path = "../../../examples/design/camber.rs"]
mod camber;
#[path = "../../../examples/design/function_generator.rs"]
mod function_generator;
#[path = "../../../examples/design/straight_line.rs"]
mod straight_line;
#[path = "../../../examples/design/walking_leg.rs"]
mod walking_leg;

use kin_runtime::Kinematics;

#[test]
fn a_line_is_found_that_is_straighter_than_the_textbooks() {
    let found = straight_line::found().unwrap();
    let [height, length] = straight_line::extent(&found.mechanism);
    assert!(length > 3.9 && height / length < 1.0 / 1042.0, "{height} of {length}: {found}");
    assert!(found.slacks.iter().all(|slack| slack.slack >= 0.0), "{found}");
}

#[test]
fn the_rocker_turns_by_the_logarithm() {
    let found = function_generator::found().unwrap();
    assert!((found.error / 61.0).sqrt().to_degrees() < 0.1, "{found}");
}

#[test]
fn the_leg_steps_farther_and_as_flat() {
    let found = walking_leg::found().unwrap();
    let [[_, rise, step], [_, own_rise, own_step]] =
        [&found.mechanism, &walking_leg::Klann::default()].map(walking_leg::stance);
    assert!(
        step > 1.3 * own_step && rise < 1.5 * own_rise,
        "{step} and {rise}, not {own_step} and {own_rise}: {found}"
    );
}

#[test]
fn the_wheel_leans_as_it_should() {
    let found = camber::found().unwrap();
    // Seventeen instants: no more than a twentieth of a degree each.
    assert!(found.error < 17.0 * 0.05 * 0.05, "{found}");
    assert!(found.mechanism.solver().sweep(&[-1.5, 1.5]).is_ok());
}
