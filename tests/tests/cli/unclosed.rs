//! Messages about mechanisms that do not close, motions between limits, and the count of degrees of freedom.

use super::{failed, good, kin};

/// A four-bar in which no link turns all the way round.
const ROCKING: &str = "--set l1=0.25,l2=0.2";

#[test]
fn what_does_not_close_is_told_what_is_proven() {
    let line = format!("fourbar solve {ROCKING} --at 0.8");
    let ran = failed(&line, 1, &["cannot close", "it is proven that it cannot be assembled at t = 0.8"]);
    assert!(!ran.err.contains("close at all"), "{}", ran.err);
}

/// Dimensions that do not close at t = 0, with the crank at 45°, but a quarter of a turn later.
#[test]
fn an_angle_says_when_although_nothing_closes_at_the_beginning() {
    let line = |at: &str| format!("fourbar solve --set l1=0.35,l2=0.55 --at {at} --format json");
    assert_eq!(Some(1), kin(&line("0")).status);
    let ran = kin(&line("90deg"));
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    let solved: serde_json::Value = serde_json::from_str(&ran.out).expect("json");
    let t = solved["t"].as_f64().expect("a time");
    assert!((t - std::f64::consts::FRAC_PI_2 / 2.3).abs() < 1e-15, "{t}");
    // The default of a range is a turn.
    let ranges = good("fourbar limits --set l1=0.35,l2=0.55");
    assert!(ranges.starts_with("FourbarLectureMid from t = 0 to t = 2.73182\n"), "{ranges}");
}

/// Cranks that are as fast at t = 0 as if their speed were constant.
#[test]
fn an_angle_says_when_only_if_the_speed_is_constant() {
    for line in ["lever solve lever.phi --at 60deg", "faster solve crank.phi --at 1turn", "faster sweep --to 90deg"] {
        failed(line, 2, &["an angle says when only if a crank is driven at constant speed"]);
    }
    // Without a turn the default range is one unit of time.
    assert!(good("lever sweep --steps 1 --format csv").lines().last().is_some_and(|last| last.starts_with("1,")));
    // A length does not turn.
    failed("carriage solve --at 60deg", 2, &["an angle says when only if a crank is driven at constant speed"]);
    assert!(good("carriage sweep --steps 1 --format csv").lines().last().is_some_and(|last| last.starts_with("1,")));
}

/// The same dimensions: a motion up to a limit says what is proven at t = 0, and one between limits is that which exists.
#[test]
fn limits_are_those_of_a_motion_that_closes() {
    let line = |rest: &str| format!("fourbar sweep crank.phi --set l1=0.35,l2=0.55 {rest} --steps 4 --format csv");
    let ran = failed(&line("--to limit"), 1, &["it is proven that it cannot be assembled at t = 0"]);
    assert!(!ran.err.contains("close at all"), "{}", ran.err);
    for rest in ["--from limit --to limit", "--from limit --to 90deg"] {
        let ran = kin(&line(rest));
        assert_eq!(Some(0), ran.status, "{}", ran.err);
        assert!(ran.err.contains("note: it does not close at t = 0: the motion is that through t = "), "{}", ran.err);
        let times: Vec<f64> =
            ran.out.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect();
        assert!(times[0] > 0.0 && times.windows(2).all(|pair| pair[1] > pair[0]), "{times:?}");
    }
    assert!(!kin(&format!("fourbar sweep crank.phi {ROCKING} --from limit --to limit")).err.contains("does not close"));
}

#[test]
fn a_motion_between_two_limits_has_its_start_once() {
    let ran = kin(&format!("fourbar sweep {ROCKING} --from limit --to limit --steps 8 --format csv"));
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    let times: Vec<f64> =
        ran.out.lines().skip(1).map(|line| line.split(',').next().and_then(|t| t.parse().ok()).expect("t")).collect();
    assert!(times.len() == 9 && times.contains(&0.0), "{times:?}");
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] > 1e-6), "{times:?}");
}

#[test]
fn info_counts_degrees_of_freedom_as_one_does_by_hand() {
    let text = good("fourbar info");
    assert!(text.contains("Grübler's count    1  9 coordinates − 8 rows of joints"), "{text}");
}

#[test]
fn a_guess_that_changes_its_mode_on_the_way_is_told() {
    const BETWEEN: &str = "limits solve --guess slider.x=0,rod.phi=1.5707963267948966";
    let ran = kin(&format!("{BETWEEN} --at 3"));
    let note = "another assembly mode at t = 3 than at t = 0; a motion from t = 0 stays in --mode A-B-guide=-";
    assert!(ran.status == Some(0) && ran.err.contains(note), "{}", ran.err);
    assert_eq!("", kin(&format!("{BETWEEN} --at 1")).err);
    assert_eq!("", kin(&format!("{BETWEEN} --at 3 --mode A-B-guide=-")).err);
}

/// Where the law of a driver ends, the motion does; full Newton and the plan say the same.
#[test]
fn a_motion_goes_as_far_as_its_rows_are_defined() {
    let said = "at t = 2 a row is not defined beyond it (joint `push`, row `push`)";
    let ran = kin("press sweep ram.y --to limit --steps 8 --format csv");
    assert!(
        ran.status == Some(0)
            && ran.err.contains(&format!("note: it ends at t = 2: the branch ends after t = 2: {said}")),
        "{}",
        ran.err
    );
    assert_eq!(9, ran.out.lines().count(), "{}", ran.out);
    failed("press sweep ram.y --to 3 --steps 4", 1, &[said]);
}

/// The drivers determine the motion, but not at this configuration.
#[test]
fn a_special_configuration_is_not_called_under_driven_alone() {
    let said =
        ["under-driven at t = 0: 1 degree of freedom is left open", "this one is special; --guess leads to others"];
    failed("kite solve", 1, &said);
    let open = kin("underdriven solve");
    assert!(open.err.contains("under-driven") && !open.err.contains("special"), "{}", open.err);
}
