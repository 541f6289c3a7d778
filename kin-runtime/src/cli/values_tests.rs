use super::*;
use crate::cli::fixture::{CrossHead, DRIVEN};
use crate::mechanism::Mechanism;

fn model() -> &'static Model {
    CrossHead::<DRIVEN>::model()
}

fn number(option: &str, text: &str) -> Result<f64, Failure> {
    super::number(option, text, Measured::default())
}

fn inputs(option: &str, texts: &[String]) -> Result<Vec<(String, Signal)>, Failure> {
    super::inputs(option, texts, model())
}

fn times(option: &str, text: &str) -> Result<Vec<TimeOrAngle>, Failure> {
    super::times(option, text, model())
}

fn texts(list: &[&str]) -> Vec<String> {
    list.iter().map(|t| (*t).to_owned()).collect()
}

fn message<T: std::fmt::Debug>(result: Result<T, Failure>) -> String {
    result.map_or_else(|e| e.to_string(), |v| format!("{v:?}"))
}

#[test]
fn numbers_are_finite_decimals() {
    assert_eq!(number("--at", "-0.5"), Ok(-0.5));
    assert_eq!(number("--at", " 1e-3 "), Ok(1e-3));
    for text in ["", "NaN", "nan", "inf", "-inf", "infinity", "1e999", "1,5", "one", "--format", "0x10"] {
        assert!(number("--at", text).is_err_and(|e| e.to_string().starts_with("--at: ")), "{text}");
    }
    let decimal = "--at: `1,5` is not a number (decimals have a point: 1.5)";
    assert_eq!(message(number("--at", "1,5")), decimal);
    assert_eq!(message(number("--at", "1e999")), "--at: `1e999` is too large for a number");
}

#[test]
fn assignments_may_be_split_over_options() {
    let pairs = assignments("--set", "l1=0.1", &texts(&["l1=0.12, l[3]=-0.4", "d2=-0.1"]));
    let expected = [("l1", "0.12"), ("l[3]", "-0.4"), ("d2", "-0.1")].map(|(a, b)| (a.to_owned(), b.to_owned()));
    assert_eq!(pairs, Ok(expected.to_vec()));
}

#[test]
fn bad_assignments_say_what_would_be_right() {
    let bad = |text: &str| message(assignments("--set", "l1=0.1", &texts(&[text])));
    assert_eq!(bad("l1"), "--set: `l1` is no assignment; write --set l1=0.1");
    assert_eq!(bad(""), "--set: an assignment is missing; write --set l1=0.1");
    assert_eq!(bad("l1=1,"), "--set: an assignment is missing; write --set l1=0.1");
    assert_eq!(bad("=1"), "--set: `=1` has no name; write --set l1=0.1");
    assert_eq!(bad("l1="), "--set: `l1` has no value; write --set l1=0.1");
    let members = "--set: an array is set member by member; write --set l[0]=…,l[1]=…";
    assert_eq!((bad("l=[1,2]"), bad("l = [1]")), (members.to_owned(), members.to_owned()));
    assert_eq!(bad("l1=1,l1=2"), "--set: `l1` is set twice");
    let given =
        "--given: `0.5` has no name (a rate and an acceleration follow colons, NAME=0.3:0.5); write --given l1=0.1";
    assert_eq!(message(assignments("--given", "l1=0.1", &texts(&["phi=0.3,0.5"]))), given);
    let decimal = "--set: `5` has no name (arrays are set member by member, decimals have a point); write --set l1=0.1";
    assert_eq!(bad("l1=0,5"), decimal);
    // All errors are reported at once.
    assert_eq!(bad("l1,l2=,l3=1").lines().count(), 2);
}

#[test]
fn signals_have_up_to_three_numbers() {
    let full = Signal { value: 1.0, rate: -2.0, acceleration: 3.0 };
    assert_eq!(inputs("--input", &texts(&["u=1,-2,3"])), Ok(vec![("u".into(), full)]));
    // As in the values of --given.
    assert_eq!(inputs("--input", &texts(&["u=1:-2:3"])), Ok(vec![("u".into(), full)]));
    let two = inputs("--input", &texts(&["u=1,-2,3,v=4", "w=0,1"]));
    assert_eq!(
        two.map(|s| s.iter().map(|(n, s)| (n.clone(), s.value, s.rate)).collect::<Vec<_>>()),
        Ok(vec![("u".into(), 1.0, -2.0), ("v".into(), 4.0, 0.0), ("w".into(), 0.0, 1.0)])
    );
    let bad = |text: &str| message(inputs("--input", &texts(&[text])));
    assert_eq!(bad("1,2"), "--input: `1` names no input; write --input u=value,rate,acceleration");
    assert_eq!(bad("u=1,2,3,4"), "--input: `u` has 4 numbers; at most value, rate and acceleration");
    assert_eq!(bad("u=1,u=2"), "--input: `u` is given twice");
    assert_eq!(bad("u="), "--input: a number is missing");
}

#[test]
fn a_grid_has_one_instant_more_than_steps() {
    assert_eq!(grid(-1.0, 1.0, 4), Ok(vec![-1.0, -0.5, 0.0, 0.5, 1.0]));
    assert_eq!(grid(1.0, 0.0, 2), Ok(vec![1.0, 0.5, 0.0]));
    assert_eq!(grid(0.0, 0.3, 3).map(|g| g.last().copied()), Ok(Some(0.3)));
    assert!(grid(0.0, 1.0, 0).is_err());
    assert!(grid(1.0, 1.0, 5).is_err());
    assert!(grid(0.0, 1.0, usize::MAX).is_err());
    assert!(grid(1e16, 1e16 + 2.0, 1000).is_err());
    assert!(grid(-1e308, 1e308, 10).is_err());
    assert!(configurations("1e3").is_err() && configurations("-1").is_err());
    assert_eq!(configurations("0"), Ok(0));
    assert!(steps("-1").is_err() && steps("1.5").is_err() && steps("").is_err());
}

#[test]
fn times_are_a_list() {
    assert_eq!(times("--times", "-1,0, 1"), Ok([-1.0, 0.0, 1.0].map(TimeOrAngle::At).to_vec()));
    assert_eq!(times("--times", "0,1,0"), Ok([0.0, 1.0, 0.0].map(TimeOrAngle::At).to_vec()));
    assert_eq!(
        times("--times", "0, 90deg,0.5turn, pi/2"),
        Ok(vec![
            TimeOrAngle::At(0.0),
            TimeOrAngle::Turned(std::f64::consts::FRAC_PI_2),
            TimeOrAngle::Turned(std::f64::consts::PI),
            TimeOrAngle::At(std::f64::consts::FRAC_PI_2),
        ])
    );
    assert_eq!(times("--times", "20 ms"), Ok(vec![TimeOrAngle::At(0.02)]));
    assert_eq!(message(times("--times", "2mm")), "--times: `2mm`: `t` is in s, and this is mm");
    assert!(times("--times", "0,,1").is_err());
    assert!(times("--times", "").is_err());
    assert!(times("--times", "0,0").is_err());
}
