//! Every stage as text: what a person reads when something is unclear.

mod support;

use kin_core::joints::{Driver, Revolute, Translational};
use kin_core::mechanism::{
    Axis, Body, BodyOrigin, BodyRef, Component, Formula, Index, Mechanism, Member, Parameter, Place, Range, Statement,
    Value,
};
use kin_core::program::{Slot, lower};
use kin_core::{Origin, assemble, differentiate};

const AT: Origin = Origin(0);

/// A pendulum on a slider that moves along an inclined guide.
fn pendulum_on_a_slider() -> Mechanism {
    let body = |family| BodyRef::Body { family, index: Index::constant(0), origin: AT };
    let length = Formula::Parameter(Member { family: 0, index: Index::constant(0), origin: AT });
    let at = |body, x| Place { body, x, y: Formula::ZERO, origin: AT };
    let free = |name: &str| Body {
        name: name.into(),
        len: None,
        origin_at: BodyOrigin::Free { x: None, y: None },
        phi: None,
        origin: AT,
    };
    let joint =
        |name: &str, kind| Statement { name: name.into(), range: None, operands: kind, keyword: AT, origin: AT };
    let guide = Translational {
        p: at(BodyRef::Ground(AT), Formula::ZERO),
        q: at(body(0), Formula::ZERO),
        axis: Axis { x: Formula::Number(3.0), y: Formula::Number(4.0), origin: AT },
        angle: Formula::ZERO,
    }
    .into();
    let pin = Revolute { p: at(body(0), Formula::ZERO), q: at(body(1), length.clone()) }.into();
    let swing =
        Driver { left: Formula::Pose(body(1), Component::Phi), right: Value { value: Formula::Time, origin: AT } }
            .into();
    Mechanism {
        name: "Pendulum".into(),
        parameters: vec![Parameter {
            name: "l".into(),
            len: None,
            unit: None,
            default: None,
            doc: String::new(),
            origin: AT,
        }],
        bodies: vec![free("slider"), free("bob")],
        joints: vec![
            joint("guide", guide),
            Statement { range: Some(Range { start: 0, end: 1 }), ..joint("pin", pin) },
            joint("swing", swing),
        ],
        ..Mechanism::default()
    }
}

#[test]
fn a_mechanism_reads_like_its_description() {
    let text = pendulum_on_a_slider().to_string();
    for line in [
        "Pendulum",
        "  parameter l",
        "  body slider",
        "  translational guide: ground @ (0, 0), slider @ (0, 0), axis = (3, 4), angle = 0",
        "  revolute pin[i in 0..1]: slider @ (0, 0), bob @ (l, 0)",
        "  driver swing: bob.phi = t",
    ] {
        assert!(text.lines().any(|found| found == line), "{line:?} is not in\n{text}");
    }
}

#[test]
fn constraints_and_their_derivatives_read_as_equations() {
    let set = assemble(&pendulum_on_a_slider()).unwrap();
    let text = set.to_string();
    assert!(text.contains("Pendulum: 6 coordinates, 5 rows"), "{text}");
    assert!(text.contains("swing: bob.phi - t = 0"), "{text}");
    let text = differentiate(set).expect("no third derivatives").to_string();
    for part in
        ["pin[0].x", "∂Φ/∂bob.phi = -(l*sin(bob.phi))", "Φ_t = -1", "γ   = l*cos(bob.phi)*(bob.phi_dot*bob.phi_dot)"]
    {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
}

#[test]
fn a_program_reads_line_by_line() {
    let system = differentiate(assemble(&pendulum_on_a_slider()).unwrap()).expect("no third derivatives");
    let outputs: Vec<_> = system.equations.iter().enumerate().map(|(k, e)| (Slot::Phi(k), e.phi)).collect();
    let text = lower(&system.set.graph, &outputs).to_string();
    assert!(text.contains("= sin_cos(q5)"), "{text}");
    assert!(text.contains("Φ[4] = v"), "{text}");
    assert!(!text.contains("Bits") && !text.contains("Value"), "{text}");
}
