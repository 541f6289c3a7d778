//! Mechanisms written as a builder of descriptions would.

use kin_core::Origin;
use kin_core::joints::{Driver, RelativeAngle, Revolute};
use kin_core::mechanism::{
    Axis, Body, BodyOrigin, BodyRef, Component, Formula, Index, Mechanism, Member, Operands, Parameter, Place, Range,
    Statement, Value,
};
use kin_core::program::{Program, Slot, lower};
use kin_core::system::KinematicSystem;

pub const AT: Origin = Origin(0);

pub fn number(value: f64) -> Formula {
    Formula::Number(value)
}

pub fn index(scale: i64, offset: i64) -> Index {
    Index { scale, offset }
}

pub fn member(family: usize, index: Index) -> Member {
    Member { family, index, origin: AT }
}

pub fn parameter(k: usize) -> Formula {
    Formula::Parameter(member(k, index(0, 0)))
}

pub fn element(k: usize, scale: i64, offset: i64) -> Formula {
    Formula::Parameter(member(k, index(scale, offset)))
}

pub fn body(k: usize) -> BodyRef {
    body_of(k, 0, 0)
}

pub fn body_of(family: usize, scale: i64, offset: i64) -> BodyRef {
    BodyRef::Body { family, index: index(scale, offset), origin: AT }
}

pub const GROUND: BodyRef = BodyRef::Ground(AT);

pub fn phi(body: BodyRef) -> Formula {
    Formula::Pose(body, Component::Phi)
}

pub fn neg(a: Formula) -> Formula {
    Formula::Neg(Box::new(a))
}

pub fn add(a: Formula, b: Formula) -> Formula {
    Formula::Add(Box::new(a), Box::new(b))
}

pub fn sub(a: Formula, b: Formula) -> Formula {
    Formula::Sub(Box::new(a), Box::new(b))
}

pub fn mul(a: Formula, b: Formula) -> Formula {
    Formula::Mul(Box::new(a), Box::new(b))
}

pub fn div(a: Formula, b: Formula) -> Formula {
    Formula::Div(Box::new(a), Box::new(b), AT)
}

pub fn half(a: Formula) -> Formula {
    div(a, number(2.0))
}

pub fn on(body: BodyRef, x: Formula, y: Formula) -> Place {
    Place { body, x, y, origin: AT }
}

pub fn origin_of(body: BodyRef) -> Place {
    on(body, Formula::ZERO, Formula::ZERO)
}

pub fn axis(x: Formula, y: Formula) -> Axis {
    Axis { x, y, origin: AT }
}

pub fn parameters(names: &[(&str, Option<usize>)]) -> Vec<Parameter> {
    let one = |(name, len): &(&str, Option<usize>)| Parameter {
        name: (*name).into(),
        len: *len,
        unit: None,
        default: None,
        doc: String::new(),
        origin: AT,
    };
    names.iter().map(one).collect()
}

pub fn free(name: &str, len: Option<usize>) -> Body {
    Body { name: name.into(), len, origin_at: BodyOrigin::Free { x: None, y: None }, phi: None, origin: AT }
}

pub fn joint(name: &str, operands: Operands) -> Statement {
    Statement { name: name.into(), range: None, operands, keyword: AT, origin: AT }
}

pub fn over(name: &str, start: i64, end: i64, operands: Operands) -> Statement {
    Statement { range: Some(Range { start, end }), ..joint(name, operands) }
}

pub fn revolute(p: Place, q: Place) -> Operands {
    Revolute { p, q }.into()
}

pub fn driver(left: Formula, right: Formula) -> Operands {
    Driver { left, right: Value { value: right, origin: AT } }.into()
}

/// Φ, Φ_q, Φ_t and γ in one program.
pub fn combined(system: &KinematicSystem) -> Program {
    let mut outputs = Vec::new();
    let mut entry = 0;
    for (row, equation) in system.equations.iter().enumerate() {
        outputs.push((Slot::Phi(row), equation.phi));
        for (_, e) in &equation.phi_q {
            outputs.push((Slot::PhiQ(entry), *e));
            entry += 1;
        }
        outputs.push((Slot::PhiT(row), equation.phi_t));
        outputs.push((Slot::Gamma(row), equation.gamma));
    }
    lower(&system.set.graph, &outputs)
}

/// Four-bars one after the other, each crank turning with the rocker before it; bodies and joints are families.
pub fn chain(loops: usize) -> Mechanism {
    let len = Some(loops);
    let end = loops as i64;
    let one = |family: usize, negative: bool| {
        let length = half(element(family, 1, 0));
        on(body_of(family, 1, 0), if negative { neg(length) } else { length }, Formula::ZERO)
    };
    let corner = on(GROUND, element(3, 1, 0), element(4, 1, 0));
    let gear: Operands = RelativeAngle { a: body_of(2, 1, -1), b: body_of(0, 1, 0), value: parameter(5) }.into();
    let turning = add(parameter(5), mul(parameter(6), Formula::Time));
    Mechanism {
        name: "Chain".into(),
        parameters: parameters(&[
            ("l1", len),
            ("l2", len),
            ("l3", len),
            ("d1", len),
            ("d2", len),
            ("phi0", None),
            ("omega", None),
        ]),
        bodies: ["crank", "coupler", "rocker"].map(|name| free(name, len)).to_vec(),
        joints: vec![
            over("C", 0, end, revolute(origin_of(GROUND), one(0, true))),
            over("A", 0, end, revolute(one(0, false), one(1, true))),
            over("B", 0, end, revolute(one(1, false), one(2, true))),
            over("D", 0, end, revolute(one(2, false), corner)),
            over("turn", 1, end, gear),
            joint("drive", driver(phi(body_of(0, 0, 0)), turning)),
        ],
        ..Mechanism::default()
    }
}
