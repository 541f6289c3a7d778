//! Motions that begin and end at limits: their events, contacts and rows.

use super::kin;
use serde_json::Value;

fn swept(line: &str) -> (Value, String) {
    let ran = kin(&format!("{line} --format json"));
    assert_eq!(ran.status, Some(0), "{line}: {}", ran.err);
    (serde_json::from_str(&ran.out).expect("one JSON document"), ran.err)
}

/// The events of a motion as pairs of name and sense, with their times.
fn events(swept: &Value) -> (Vec<(&str, &str)>, Vec<f64>) {
    let list = swept["events"].as_array().expect("a list");
    let words =
        list.iter().map(|event| (event["name"].as_str().expect("a name"), event["crossing"].as_str().expect("a word")));
    (words.collect(), list.iter().map(|event| event["t"].as_f64().expect("a time")).collect())
}

fn times(swept: &Value) -> Vec<f64> {
    let states = swept["states"].as_array().expect("a list");
    states.iter().map(|state| state["t"].as_f64().expect("a time")).collect()
}

fn assert_near(found: &[f64], expected: &[f64]) {
    let are_near = found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(are_near, "{found:?} {expected:?}");
}

const BETWEEN: &str = "pushed sweep --from limit --to limit --steps 8";

/// A motion between limits is followed from an instant between them, and is still one motion in the direction of time.
#[test]
fn events_have_the_sense_of_the_motion() {
    let (whole, said) = swept(BETWEEN);
    assert_eq!(whole["violated_at_start"], serde_json::json!(["low"]));
    let (words, at) = events(&whole);
    assert_eq!(words, [("low", "restored"), ("high", "violated")]);
    assert_near(&at, &[-2.0, 0.5]);
    assert!(said.contains("note: violated at the first instant: low\n"), "{said}");
    assert!(said.contains("event: t = -2: low satisfied again (slider.x > least)\n"), "{said}");
    // The same motion from a time beside the limit.
    let (other, _) = swept("pushed sweep --from -2.99 --to 0.99 --steps 8");
    assert_eq!((&events(&other).0, &other["violated_at_start"]), (&words, &whole["violated_at_start"]));
    // A condition that is at its limit where the motion is followed from.
    let (at_start, _) = swept(&format!("{BETWEEN} --set least=0.8"));
    let (words, at) = events(&at_start);
    assert_eq!(words, [("low", "restored"), ("high", "violated")]);
    assert_near(&at, &[0.0, 0.5]);
    assert_eq!(at_start["violated_at_start"], serde_json::json!(["low"]));
}

/// A motion that stops at an event has no rows after it.
#[test]
fn a_motion_stops_at_its_first_event() {
    let (stopped, said) = swept("pushed sweep --to limit --steps 4 --stop-at-events");
    assert_near(&times(&stopped)[1..], &[0.4375, 0.5]);
    assert!(said.ends_with("note: the sweep stopped there; the last row is the event\n"), "{said}");
    assert!(!said.contains("it ends at"), "{said}");
    for (least, end) in [("0.6", -2.0), ("0.8", 0.0), ("0.4", 0.5)] {
        let (stopped, said) = swept(&format!("{BETWEEN} --stop-at-events --set least={least}"));
        let times = times(&stopped);
        assert_near(&[times[0], times[times.len() - 1]], &[-3.0, end]);
        assert!(times.is_sorted(), "{times:?}");
        assert_near(&events(&stopped).1, &[end]);
        assert_eq!((&stopped["stopped"], &stopped["complete"]), (&true.into(), &false.into()));
        assert!(said.contains("it begins at t = -3") && !said.contains("it ends at"), "{said}");
    }
}

/// Conditions are watched up to the limit itself, however few rows there are.
#[test]
fn events_beside_a_limit_are_found() {
    for steps in [1, 2, 4, 5] {
        let (whole, said) = swept(&format!("pushed sweep --from limit --to limit --steps {steps} --set least=0.502"));
        let (words, at) = events(&whole);
        assert_eq!(words, [("low", "restored"), ("high", "violated")], "{said}");
        assert_near(&at, &[-2.98, 0.5]);
    }
    let (stopped, _) = swept("pushed sweep --to limit --steps 1 --stop-at-events --set start=0.84");
    assert_near(&times(&stopped), &[0.0, 0.1]);
}

/// There is one row more than steps, also if the start is near a limit.
#[test]
fn rows_are_counted_as_steps_are() {
    for (start, steps) in [("0.8", 4), ("0.8", 5), ("0.8999", 4), ("0.5001", 4), ("0.5001", 9), ("0.7", 4)] {
        let (whole, _) = swept(&format!("pushed sweep --from limit --to limit --steps {steps} --set start={start}"));
        let times = times(&whole);
        assert_eq!(times.len(), steps + 1, "{start}: {times:?}");
        assert!(times.windows(2).all(|pair| pair[1] > pair[0]) && times.contains(&0.0), "{start}: {times:?}");
    }
}

/// Limits have the same names wherever they are listed.
#[test]
fn limits_are_called_as_they_are_printed() {
    let (whole, said) = swept("pushed sweep --to limit --steps 3");
    let kind = &whole["fallbacks"][0]["limit"]["located"]["kind"];
    assert!(kind == "dead centre" && said.contains("(dead centre)"), "{kind} {said}");
    // At either end of a motion full Newton takes over from the plan, which is worth no note.
    for ends in ["--from limit --to limit", "--from limit --to 0.5", "--to limit"] {
        assert!(!swept(&format!("pushed sweep {ends} --steps 3")).1.contains("full Newton"), "{ends}");
    }
}

/// The start halfway between the limits is one instant, not two that differ by rounding.
#[test]
fn an_instant_at_the_start_is_the_start() {
    let (whole, _) = swept("swinging sweep --from limit --to limit --steps 2");
    let times = times(&whole);
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] > 0.5) && times.contains(&0.0), "{times:?}");
}

/// The contact is the same, whether the motion is followed from one end or from between.
#[test]
fn contacts_have_the_sense_of_the_motion() {
    let (between, _) = swept("swinging sweep --from limit --to 1.9 --steps 400");
    let (onwards, _) = swept("swinging sweep --from -1.9 --to 1.9 --steps 400");
    let changes = |swept: &Value| {
        let list = swept["contacts"].as_array().expect("a list").clone();
        let inner = list.into_iter().map(|change| (change["t"].as_f64().expect("a time"), change["lifts_off"].clone()));
        inner.filter(|(t, _)| *t > -1.89).collect::<Vec<_>>()
    };
    let (found, expected) = (changes(&between), changes(&onwards));
    assert!(found.len() > 10 && found.len() == expected.len(), "{found:?} {expected:?}");
    for (a, b) in found.iter().zip(&expected) {
        assert!((a.0 - b.0).abs() < 1e-9 && a.1 == b.1, "{a:?} {b:?}");
    }
    assert_eq!(events(&between).0, events(&onwards).0);
}
