//! Sweeps along the arc, through dead centres.

use super::{failed, kin, numbers};
use serde_json::Value;

/// A four-bar in which no link turns all the way round.
const ROCKING: &str = "--set l1=0.25,l2=0.2";

#[test]
fn the_whole_motion_is_one_run() {
    let ran = kin(&format!("fourbar sweep --along-arc {ROCKING} --steps 12 --format json"));
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    let found: Value = serde_json::from_str(&ran.out).expect("one JSON document");
    let states = found["states"].as_array().expect("states");
    assert_eq!((states.len(), &found["complete"]), (13, &Value::Bool(true)));
    let [first, last] = [&states[0], &states[12]].map(|state| numbers(&state["q"]));
    assert!(first.iter().zip(&last).all(|(a, b)| (a - b).abs() < 1e-9), "{first:?} {last:?}");
    assert_eq!(found["arc"]["ends"], serde_json::json!(["closed", "closed"]));
    let places = found["arc"]["places"].as_array().expect("places");
    assert_eq!(places.len(), 2);
    for place in places {
        assert_eq!(place["kind"], "dead centre");
        let t = place["t"].as_f64().expect("a time");
        assert!(ran.err.contains("note: dead centre of A, B, D at t = "), "{t}: {}", ran.err);
    }
    assert!(ran.err.contains("drive turns back") && ran.err.contains("the curve is closed"), "{}", ran.err);
    // The same rows as a table for another program.
    let csv = kin(&format!("fourbar sweep --along-arc {ROCKING} --steps 12 --format csv"));
    assert_eq!((csv.status, csv.out.lines().count()), (Some(0), 14), "{}", csv.err);
    let text = kin(&format!("fourbar sweep B.x B.y --along-arc {ROCKING} --steps 12"));
    assert_eq!(text.status, Some(0), "{}", text.err);
}

#[test]
fn an_arc_has_instants_of_its_own() {
    failed("fourbar sweep --along-arc --times 0,1", 2, &["--along-arc: has instants of its own"]);
    failed("fourbar sweep --along-arc --to limit", 2, &["--along-arc: goes on through limits"]);
    failed("fourbar sweep --along-arc --steps 0", 2, &["--steps: at least 1 is needed"]);
    let window = kin(&format!("fourbar sweep --along-arc {ROCKING} --to 0.3 --steps 5 --format csv"));
    assert_eq!(window.status, Some(0), "{}", window.err);
    assert!(window.out.lines().last().is_some_and(|row| row.starts_with("0.3,")), "{}", window.out);
}
