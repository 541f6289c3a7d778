//! Where a mechanism does not close, and what counting says of it.

use super::{failed, good, kin};

/// A four-bar in which no link turns all the way round.
const ROCKING: &str = "--set l1=0.25,l2=0.2";

#[test]
fn what_does_not_close_is_told_what_is_proven() {
    let line = format!("fourbar solve {ROCKING} --at 0.8");
    let ran = failed(&line, 1, &["cannot close", "it is proven that it closes in no way at t = 0.8"]);
    assert!(!ran.err.contains("close at all"), "{}", ran.err);
}

#[test]
fn a_motion_between_two_limits_has_its_start_once() {
    let ran = kin(&format!("fourbar sweep {ROCKING} --from limit --to limit --steps 8 --format csv"));
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    let times: Vec<f64> =
        ran.out.lines().skip(1).map(|line| line.split(',').next().and_then(|t| t.parse().ok()).expect("t")).collect();
    assert!(times.len() >= 8 && times.contains(&0.0), "{times:?}");
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] > 1e-6), "{times:?}");
}

#[test]
fn info_counts_degrees_of_freedom_as_one_does_by_hand() {
    let text = good("fourbar info");
    assert!(text.contains("Grübler's count    1  9 coordinates − 8 rows of joints"), "{text}");
}
