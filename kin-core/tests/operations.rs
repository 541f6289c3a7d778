//! Operation counts, which are exact.

use kin_core::mechanism::{
    Body, BodyOrigin, BodyRef, Component, Formula, Index, Joint, JointKind, Mechanism, Member, Parameter, Place,
};
use kin_core::program::{Slot, lower};
use kin_core::{Origin, assemble, differentiate};

const AT: Origin = Origin(0);

fn parameter(k: usize) -> Formula {
    Formula::Parameter(Member { family: k, index: Index::constant(0), origin: AT })
}

fn body(k: usize) -> BodyRef {
    BodyRef::Body { family: k, index: Index::constant(0), origin: AT }
}

fn half(k: usize, negative: bool) -> Formula {
    let half = Formula::Div(Box::new(parameter(k)), Box::new(Formula::Number(2.0)), AT);
    if negative { Formula::Neg(Box::new(half)) } else { half }
}

fn on(body: BodyRef, x: Formula, y: Formula) -> Place {
    Place { body, x, y, origin: AT }
}

fn revolute(name: &str, p: Place, q: Place) -> Joint {
    Joint { name: name.into(), range: None, kind: JointKind::Revolute { p, q }, keyword: AT, origin: AT }
}

/// The lecture's four-bar, frames at the midpoints; parameters l1 l2 l3 d1 d2 phi0 omega.
fn four_bar() -> Mechanism {
    let zero = || Formula::ZERO;
    let end = |k: usize, negative| on(body(k), half(k, negative), Formula::ZERO);
    let drive = JointKind::Driver {
        left: Formula::Pose(body(0), Component::Phi),
        right: Formula::Add(
            Box::new(parameter(5)),
            Box::new(Formula::Mul(Box::new(parameter(6)), Box::new(Formula::Time))),
        ),
    };
    Mechanism {
        name: "FourBar".into(),
        parameters: ["l1", "l2", "l3", "d1", "d2", "phi0", "omega"]
            .map(|name| Parameter {
                name: name.into(),
                len: None,
                unit: None,
                default: None,
                doc: String::new(),
                origin: AT,
            })
            .to_vec(),
        bodies: ["crank", "coupler", "rocker"]
            .map(|name| Body {
                name: name.into(),
                len: None,
                origin_at: BodyOrigin::Free { x: None, y: None },
                phi: None,
                origin: AT,
            })
            .to_vec(),
        joints: vec![
            revolute("C", on(BodyRef::Ground(AT), zero(), zero()), end(0, true)),
            revolute("A", end(0, false), end(1, true)),
            revolute("B", end(1, false), end(2, true)),
            revolute("D", end(2, false), on(BodyRef::Ground(AT), parameter(3), parameter(4))),
            Joint { name: "drive".into(), range: None, kind: drive, keyword: AT, origin: AT },
        ],
        ..Mechanism::default()
    }
}

#[test]
fn the_lecture_four_bar_costs_what_the_hand_formula_costs() {
    let system = differentiate(assemble(&four_bar()).expect("a sound mechanism"));
    let mut outputs = Vec::new();
    let mut place = 0;
    for (row, equation) in system.equations.iter().enumerate() {
        outputs.push((Slot::Phi(row), equation.phi));
        for (_, e) in &equation.phi_q {
            outputs.push((Slot::PhiQ(place), *e));
            place += 1;
        }
        outputs.push((Slot::PhiT(row), equation.phi_t));
        outputs.push((Slot::Gamma(row), equation.gamma));
    }
    let program = lower(&system.set.graph, &outputs);
    let count = program.operations();
    println!("{system}\n{program}\n{count:?}");
    assert!(count.flops() <= 47, "{count:?}");
    assert_eq!(count.sincos, 3);
}
