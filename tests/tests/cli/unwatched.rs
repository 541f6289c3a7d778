//! Conditions that change too fast to be watched by a sweep.

use serde_json::Value;

use crate::kin;

/// Unwatched conditions are reported in a message and in the result; watched ones are not mentioned.
#[test]
fn a_condition_too_fast_to_be_watched_is_noted() {
    let line = "teeth sweep --to 20 --steps 1 --format json";
    let slow = kin(line);
    let record: Value = serde_json::from_str(&slow.out).expect("one JSON document");
    assert_eq!((slow.status, &record["unwatched"]), (Some(0), &serde_json::json!([])));
    assert!(!slow.err.contains("not watched"), "{}", slow.err);
    let fast = kin(&format!("{line} --set k=3e7"));
    let record: Value = serde_json::from_str(&fast.out).expect("one JSON document");
    let unwatched = &record["unwatched"];
    assert_eq!((fast.status, &unwatched[0]["name"]), (Some(0), &serde_json::json!("teeth")));
    assert!(unwatched[0]["from"].as_f64() < unwatched[0]["to"].as_f64());
    let note = "note: condition teeth was not watched from t = ";
    let said = fast.err.lines().filter(|line| line.starts_with(note)).count();
    assert!((1..=3).contains(&said), "{}", fast.err);
    assert!(fast.err.contains("try more instants (--steps)"), "{}", fast.err);
}
