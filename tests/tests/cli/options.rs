//! Options take effect or are refused.

use super::{failed, good, json, numbers};

/// Derivatives of angles in degrees, at one instant as along a motion.
#[test]
fn sensitivities_at_an_instant_are_in_degrees() {
    let derivatives = |options: &str| {
        let text = good(&format!("fourbar sensitivities --at 0.3 --format csv {options}"));
        let row = text.lines().find(|line| line.starts_with("coupler.phi,")).expect("a row").to_owned();
        let place = text.lines().find(|line| line.starts_with("coupler.x,")).expect("a row").to_owned();
        let of = |row: String| row.split(',').skip(1).map(|x| x.parse().expect("a number")).collect::<Vec<f64>>();
        (of(row), of(place))
    };
    let ((radians, place), (degrees, same_place)) = (derivatives(""), derivatives("--degrees"));
    assert_eq!(place, same_place);
    assert!(radians.iter().any(|x| x.abs() > 0.1));
    for (a, b) in radians.iter().zip(&degrees) {
        assert!((a.to_degrees() - b).abs() <= 1e-14 * b.abs(), "{a} {b}");
    }
    let [plain, turned] = ["", "--degrees"].map(|options| {
        let found = json(&format!("fourbar sensitivities --at 0.3 --tolerance l2=0.001 --format json {options}"));
        found["tolerances"]["coupler.phi"]["worst"].as_f64().expect("a number")
    });
    assert!((plain.to_degrees() - turned).abs() <= 1e-14 * turned, "{plain} {turned}");
    assert!(
        good("fourbar sensitivities --degrees").starts_with("FourbarLectureMid, sensitivities at t = 0, angles in")
    );
}

/// What a command cannot do at the same time is refused, with both options in the message.
#[test]
fn options_that_exclude_one_another_are_refused() {
    for motion in ["--steps 4", "--times 0,1", "--from 0", "--to 1"] {
        let option = motion.split(' ').next().expect("an option");
        failed(&format!("fourbar sensitivities coupler.phi --at 0.3 {motion}"), 2, &["--at", option]);
    }
    good("fourbar sensitivities coupler.phi --steps 4");
    failed("limits sweep --along-arc --stop-at-events --steps 4", 2, &["--along-arc", "--stop-at-events"]);
    for command in ["modes", "limits"] {
        let said = format!("--mode: `{command}` lists all modes; leave `A-B-D=+` out");
        failed(&format!("fourbar {command} --mode A-B-D=+"), 2, &[&said]);
        assert!(!good(&format!("fourbar {command} --help")).contains("--mode NAME"));
    }
}

/// The bounds of a certificate enclose the numbers beside them.
#[test]
fn a_certificate_has_columns() {
    let text = good("fourbar solve --at 0.3 --certify --format csv");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((rows.len(), rows[0].len()), (2, 1 + 9 * 3 * 3));
    let value = |name: &str| {
        let place = rows[0].iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name}"));
        rows[1][place].parse::<f64>().expect("a number")
    };
    for name in ["crank.x", "coupler.phi", "rocker.phi_dot", "coupler.y_ddot"] {
        let [least, most] = ["lower", "upper"].map(|end| value(&format!("{name}_{end}")));
        assert!(least < most && most - least < 1e-9 && (value(name) - least).abs() < 1e-9, "{name}: {least} {most}");
    }
    let proven = json("fourbar solve --at 0.3 --certify --format json");
    let first = numbers(&proven["q"])[5];
    assert!(value("coupler.phi_lower") <= first + 1e-12 && first - 1e-12 <= value("coupler.phi_upper"));
}
