//! Forces on the command line for joints whose forces are not determined.

use serde_json::Value;

use super::{good, kin};

#[test]
fn what_is_not_determined_is_an_empty_cell_and_no_number() {
    let table = good("loaded sweep --from 0 --to 0.2 --steps 2 --points --format csv");
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|column| *column == name).unwrap();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[column("A.force_x")], "", "{line}");
        assert!(cells[column("drive.effort")].parse::<f64>().unwrap().is_finite(), "{line}");
        assert!(!line.contains("NaN"), "{line}");
    }
    let plot = kin("loaded plot A.force_x --to 0.2 --steps 2");
    assert!(
        plot.status == Some(1) && plot.err.contains("`A.force_x` has no value in all of the motion"),
        "{}",
        plot.err
    );
    let ran = kin("loaded forces --at 0.2 --format json");
    assert!(ran.status == Some(0) && ran.err.contains("redundant rows share the load"), "{}", ran.err);
    let answer: Value = serde_json::from_str(&ran.out).unwrap();
    assert!(answer["reactions"]["A"]["force"].is_null(), "{answer}");
}

/// Forces of least norm where they are asked for, by every command; otherwise a note says why there is no number, and
/// multipliers do not reveal one.
#[test]
fn forces_of_least_norm_are_columns_and_arrows_where_asked_for() {
    let command = "loaded sweep A.force_x drive.effort --to 0.2 --steps 2 --format csv";
    let ran = kin(command);
    let why = "note: `A.force_x` has no value at t = 0: redundant rows share the load";
    assert!(ran.status == Some(0) && ran.err.contains(why), "{}", ran.err);
    let shared = kin(&format!("{command} --least-norm"));
    assert!(shared.status == Some(0) && !shared.err.contains("no value"), "{}", shared.err);
    let of_sweep: Vec<f64> = shared.out.lines().nth(1).unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    let forces = |options: &str| -> Value {
        serde_json::from_str(&kin(&format!("loaded forces --format json {options}")).out).unwrap()
    };
    let varied = kin("loaded sensitivities A.force_x --to 0.2 --steps 2 --format csv --least-norm").out;
    let first = varied.lines().nth(1).and_then(|line| line.split(',').nth(1)).map(str::parse);
    assert_eq!(first, Some(Ok(of_sweep[1])), "{varied}");
    let (shown, hidden) = (forces("--least-norm"), forces(""));
    assert!((shown["reactions"]["A"]["force"][0].as_f64().unwrap() - of_sweep[1]).abs() < 1e-9, "{shown}");
    assert!(shown["multipliers"]["A.x"].is_number() && hidden["multipliers"]["A.x"].is_null(), "{hidden}");
    assert!(hidden["multipliers"]["drive"].is_number(), "{hidden}");
    let arrows = |options: &str| kin(&format!("loaded animate --forces --format svg --to 0.2 --steps 2 {options}"));
    let (without, with) = (arrows(""), arrows("--least-norm"));
    assert!(without.err.contains("has no value at t = 0") && with.err.is_empty(), "{}{}", without.err, with.err);
    assert!(with.out.len() > without.out.len());
    assert!(!kin("loaded animate --format svg --to 0.2 --steps 2").err.contains("no value"));
}

/// What holds an arm is a column over given motions, and `check` compares its power, too.
#[test]
fn the_effort_of_a_given_coordinate_is_a_quantity() {
    let given = "--given upper.phi=0:1 --given fore.phi=0";
    let out = good(&format!("arm sweep upper.phi.effort fore.phi.effort {given} --to 0.5 --steps 1 --format csv"));
    let last: Vec<f64> = out.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    // Weights of 20 at 0.15 and of 10 at 0.3 along the upper arm, and that of the forearm at 0.1; the forearm's centripetal
    // and other accelerations of the elbow act on it along and across.
    let (s, c) = 0.5_f64.sin_cos();
    let elbow = [-0.3 * c, -0.3 * s];
    let expected = [10.0 * (2.0 * 0.15 + 0.3) * c + 0.3 * (c * elbow[1] - s * elbow[0]), 0.1 * (10.0 + elbow[1])];
    assert!((last[1] - expected[0]).abs() < 1e-9 && (last[2] - expected[1]).abs() < 1e-9, "{out}: {expected:?}");
    let ran = kin(&format!("arm sweep E.angle upper.phi.effort {given} --to 0.5 --steps 1 --format svg"));
    assert_ne!(Some(0), ran.status, "{}", ran.out);
    let ran = kin("arm sweep upper.phi.effort --least-norm --to 0.1 --steps 1");
    assert!(ran.err.contains("`upper.phi.effort` has no value at t = 0: at t = 0 loads act along"), "{}", ran.err);
    let ran = kin("fourbar sweep crank.phi.effort");
    assert!(ran.status == Some(2) && ran.err.contains("no quantity named `crank.phi.effort`"), "{}", ran.err);

    let check = good(&format!("arm check --configurations 2 {given}"));
    assert!(check.contains("power balance"), "{check}");
    // Powers that add up to 0 leave nothing but rounding, which is no failure.
    for t in ["0", "0.1", "1"] {
        assert!(good(&format!("balanced check --configurations 2 --at {t}")).contains("power balance"));
    }
    let open = kin("arm check --configurations 2");
    assert!(
        open.status == Some(0) && open.err.contains("note: forces are not checked: at t = 0 loads act along"),
        "{}",
        open.err
    );
    let ran = kin(&format!("arm check --configurations 2 --set a=-1 {given}"));
    assert!(ran.status == Some(1) && ran.err.contains("loads[2] (T) is not a finite number"), "{}", ran.err);
    assert!(ran.out.contains("FAILED"), "{}", ran.out);
}

/// Where velocities fail already, `forces` says what that means for forces.
#[test]
fn a_dead_centre_names_what_bears_forces_without_bounds() {
    let ran = kin("dead_centre forces --input place=0.9");
    assert_eq!(Some(1), ran.status);
    let grows = "near it forces grow without bounds in ";
    let joints = ran.err.split(grows).nth(1).unwrap_or_else(|| panic!("{}", ran.err));
    assert!(["A", "B", "push"].iter().all(|joint| joints.contains(joint)), "{}", ran.err);
    assert!(good("dead_centre forces --input place=0.8").contains("push"));
}

/// A contact that would have to pull is told at the instant that is asked for, by `forces` and by `check`.
#[test]
fn a_contact_that_would_pull_is_told() {
    for command in ["forces", "check --configurations 2"] {
        let ran = kin(&format!("eccentric {command} --at 0.04"));
        assert_eq!(Some(0), ran.status, "{}", ran.err);
        assert!(ran.err.contains("note: `contact` would have to pull at t = 0.04: normal force -12"), "{}", ran.err);
        let ran = kin(&format!("eccentric {command} --at 0"));
        assert!(!ran.err.contains("pull"), "{}", ran.err);
    }
    let check: Value =
        serde_json::from_str(&kin("eccentric check --at 0.04 --configurations 2 --format json").out).unwrap();
    assert!(check["pulling"][0].as_str().unwrap().contains("`contact`"), "{check}");
}

/// At the angle φ the rope from the tip of a boom to a point beside its foot has the length 2 cos ½φ and the tension
/// m g cos φ / sin ½φ.
#[test]
fn a_rope_that_would_push_is_told() {
    for command in ["forces", "check --configurations 2"] {
        let ran = kin(&format!("boom {command} --input l=1"));
        let tension = -9.81 / f64::sin(60_f64.to_radians());
        let note = format!("note: `stay` would have to push at t = 0: tension {tension:.6} N; a rope is slack there");
        assert!(ran.status == Some(0) && ran.err.contains(&note), "{}", ran.err);
        assert!(!kin(&format!("boom {command} --input l=1.7")).err.contains("push"));
    }
}

/// Arrows are asked for by name, and a mechanism without masses has none.
#[test]
fn arrows_need_masses() {
    let ran = kin("fourbar animate --forces --format html");
    assert!(ran.status == Some(1) && ran.err.contains("masses"), "{}", ran.err);
}

/// M and Q stand at the end of the equations, in all forms.
#[test]
fn equations_have_m_and_q() {
    let text = good("eccentric equations");
    assert!(text.contains("\nForces\n    M q̈ + Φ_qᵀ λ = Q\n"), "{text}");
    assert!(text.contains("M[y_follower, y_follower]") && text.contains("Q[y_follower]"), "{text}");
    let latex = good("eccentric equations --format latex");
    assert!(latex.contains(r"M \ddot q + \Phi_q^{\mathsf T} \lambda &= Q"), "{latex}");
    assert!(!good("eccentric equations contact").contains("Forces"));
}

/// Efforts of inputs are told where they are not those of drivers; tables of one instant have the forces that were asked for.
#[test]
fn inputs_have_efforts() {
    let json: Value = serde_json::from_str(&good("dead_centre forces --input place=0.8 --format json")).unwrap();
    let effort = json["efforts"]["push"]["effort"].as_f64().unwrap();
    assert!((json["inputs"]["place"]["effort"].as_f64().unwrap() - effort).abs() < 1e-12, "{json}");
    assert!(!good("dead_centre forces --input place=0.8").contains("Inputs"));
    let row = |command: &str| good(command).lines().nth(1).unwrap().to_owned();
    assert_eq!(row("dead_centre solve place.effort --input place=0.8 --format csv"), format!("0,{effort}"));
    let table = good("dead_centre solve --forces --input place=0.8 --format csv");
    let column = table.lines().next().unwrap().split(',').position(|name| name == "push.effort").unwrap();
    assert_eq!(table.lines().nth(1).unwrap().split(',').nth(column), Some(effort.to_string().as_str()));
    let ran = kin("loaded solve A.force_x");
    assert!(ran.err.contains("note: `A.force_x` has no value at t = 0: redundant rows share the load"), "{}", ran.err);
}

/// The table of one instant has all efforts that the other forms have.
#[test]
fn tables_have_the_efforts_of_given_coordinates_and_of_inputs() {
    let cell = |command: &str, name: &str| -> f64 {
        let table = good(&format!("{command} --format csv"));
        let mut lines = table.lines().map(|line| line.split(','));
        let (names, mut row) = (lines.next().unwrap(), lines.next().unwrap());
        let found: Vec<usize> = names.enumerate().filter(|(_, other)| *other == name).map(|(k, _)| k).collect();
        let [column] = found[..] else { panic!("{name}: {found:?}") };
        row.nth(column).unwrap().parse().unwrap()
    };
    for (command, name, object) in [
        ("arm forces --given upper.phi=0.3 --given fore.phi=0", "upper.phi", "efforts"),
        ("dead_centre forces --input place=0.8", "place", "inputs"),
    ] {
        let json: Value = serde_json::from_str(&good(&format!("{command} --format json"))).unwrap();
        let effort = json[object][name]["effort"].as_f64().unwrap();
        assert_eq!(effort, cell(command, &format!("{name}.effort")));
        assert_eq!(effort, cell(&command.replace("forces", "solve --forces"), &format!("{name}.effort")));
    }
}

/// Torsion springs and the rates of drivers are in degrees where angles are; efforts and powers stay those along radians.
#[test]
fn angles_and_rates_among_forces_are_in_degrees() {
    let [radians, degrees] = ["", "--degrees"].map(|options| {
        let run =
            |form: &str| kin(&format!("loaded solve --at 0.2 --forces --least-norm --format {form} {options}")).out;
        let text = run("text");
        let drivers = text.split("Drivers: what they supply").nth(1).expect("a table");
        let row = drivers.lines().find(|line| line.trim_start().starts_with("drive ")).expect("a row");
        let power: f64 = row.split_whitespace().last().expect("a power").parse().expect("a number");
        let forces = serde_json::from_str::<Value>(&run("json")).expect("JSON")["forces"].clone();
        let number = |group: &str, name: &str, key: &str| forces[group][name][key].as_f64().expect("a number");
        let turned =
            [number("springs", "coil", "angle"), number("springs", "coil", "rate"), number("efforts", "drive", "rate")];
        (turned, [number("springs", "coil", "torque"), number("efforts", "drive", "effort"), power])
    });
    assert_eq!(radians.1, degrees.1);
    for (radians, degrees) in radians.0.iter().zip(degrees.0) {
        assert!(*radians > 0.9 && (radians.to_degrees() - degrees).abs() < 1e-12, "{radians} {degrees}");
    }
}
