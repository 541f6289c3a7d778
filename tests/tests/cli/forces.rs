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
