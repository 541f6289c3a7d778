//! The emitted code compared with the same mechanism built in kin-core: its interpreted program and its evaluated
//! expressions.

#[path = "../../kin-core/tests/oracle/mod.rs"]
mod oracle;

use kin_core::expr::Symbol;
use kin_core::joints::{Constraint, Distance, Driver, Translational};
use kin_core::mechanism::{
    Axis, Body, BodyOrigin, BodyRef, Component, Formula, Function, Index, Mechanism as Model, Member, Operands,
    Parameter, Place, Statement, Value,
};
use kin_core::program::{Slot, lower};
use kin_core::{KinematicSystem, Origin, assemble, differentiate};
use kin_runtime::{Instant, Mechanism, Subset, mechanism};
use kin_tests::random::Random;
use oracle::{evaluate, interpret};

/// A slider on a turning arm, a rod to a disc whose origin is held, a strut, and a free equation.
#[mechanism]
#[body(arm, x = 0, y = h)]
#[bodies(slider)]
#[body(disc, origin = slider @ (-l/3, 0.1))]
#[coordinates(s)]
#[translational(guide: arm @ (l, 0.2), slider @ (0.1, -l/2), axis = (l, 0.3), angle = 0.25)]
#[distance(strut: ground @ (1, -0.4), disc @ (0.2, h), length = 0.9 + 0.1*sin(t))]
#[constraint(free: s*cos(disc.phi - arm.phi) + s.powi(3)/l = atan2(slider.y, 2 + slider.x))]
#[driver(turn: arm.phi = h + t*t)]
struct Mixed {
    #[param(0.7)]
    l: f64,
    #[param(0.3)]
    h: f64,
}

const AT: Origin = Origin(0);
const COORDINATES: usize = 6;

fn n(value: f64) -> Formula {
    Formula::Number(value)
}

fn parameter(family: usize) -> Formula {
    Formula::Parameter(Member { family, index: Index::constant(0), origin: AT })
}

fn body(family: usize) -> BodyRef {
    BodyRef::Body { family, index: Index::constant(0), origin: AT }
}

fn at(body: BodyRef, x: Formula, y: Formula) -> Place {
    Place { body, x, y, origin: AT }
}

fn binary(make: fn(Box<Formula>, Box<Formula>) -> Formula, a: Formula, b: Formula) -> Formula {
    make(Box::new(a), Box::new(b))
}

fn over(a: Formula, b: Formula) -> Formula {
    Formula::Div(Box::new(a), Box::new(b), AT)
}

fn call(f: Function, a: Formula) -> Formula {
    Formula::Call(f, Box::new(a))
}

/// The model of `Mixed`, built by hand.
fn mixed() -> Model {
    let (l, h) = (|| parameter(0), || parameter(1));
    let neg = |a: Formula| Formula::Neg(Box::new(a));
    let (add, sub, mul) =
        (|a, b| binary(Formula::Add, a, b), |a, b| binary(Formula::Sub, a, b), |a, b| binary(Formula::Mul, a, b));
    let free = |x, y| BodyOrigin::Free { x, y };
    let bodies = [
        ("arm", free(Some(n(0.0)), Some(h()))),
        ("slider", free(None, None)),
        ("disc", BodyOrigin::Carried(at(body(1), over(neg(l()), n(3.0)), n(0.1)))),
    ];
    let pose = |k, component| Formula::Pose(body(k), component);
    let s = || Formula::Scalar(Member { family: 0, index: Index::constant(0), origin: AT });
    let turned = sub(pose(2, Component::Phi), pose(0, Component::Phi));
    let cubed = over(Formula::Pow(Box::new(s()), 3.0), l());
    let joints: [(&str, Operands); 4] = [
        (
            "guide",
            Translational {
                p: at(body(0), l(), n(0.2)),
                q: at(body(1), n(0.1), over(neg(l()), n(2.0))),
                axis: Axis { x: l(), y: n(0.3), origin: AT },
                angle: n(0.25),
            }
            .into(),
        ),
        (
            "strut",
            Distance {
                p: at(BodyRef::Ground(AT), n(1.0), n(-0.4)),
                q: at(body(2), n(0.2), h()),
                length: Value { value: add(n(0.9), mul(n(0.1), call(Function::Sin, Formula::Time))), origin: AT },
            }
            .into(),
        ),
        (
            "free",
            Constraint {
                left: add(mul(s(), call(Function::Cos, turned)), cubed),
                right: binary(Formula::Atan2, pose(1, Component::Y), add(n(2.0), pose(1, Component::X))),
            }
            .into(),
        ),
        (
            "turn",
            Driver {
                left: pose(0, Component::Phi),
                right: Value { value: add(h(), mul(Formula::Time, Formula::Time)), origin: AT },
            }
            .into(),
        ),
    ];
    let parameters = ["l", "h"].map(|name| Parameter {
        name: name.into(),
        len: None,
        unit: None,
        default: None,
        doc: String::new(),
        origin: AT,
    });
    Model {
        name: "Mixed".into(),
        parameters: parameters.to_vec(),
        bodies: bodies
            .map(|(name, origin_at)| Body { name: name.into(), len: None, origin_at, phi: None, origin: AT })
            .to_vec(),
        scalars: vec![kin_core::mechanism::Scalar { name: "s".into(), len: None, origin: AT, unit: None }],
        joints: joints
            .map(|(name, operands)| Statement { name: name.into(), range: None, operands, keyword: AT, origin: AT })
            .to_vec(),
        ..Model::default()
    }
}

/// All outputs in the order of expansion: row by row Φ, the entries of Φ_q that are not literals, Φ_t and γ.
fn outputs(system: &KinematicSystem) -> Vec<(Slot, kin_core::expr::ExprId)> {
    let graph = &system.set.graph;
    let (mut outputs, mut place) = (Vec::new(), 0);
    for (row, equation) in system.equations.iter().enumerate() {
        outputs.push((Slot::Phi(row), equation.phi));
        for (_, entry) in &equation.phi_q {
            if graph.literal(*entry).is_none() {
                outputs.push((Slot::PhiQ(place), *entry));
            }
            place += 1;
        }
        outputs.extend([(Slot::PhiT(row), equation.phi_t), (Slot::Gamma(row), equation.gamma)]);
    }
    outputs
}

#[test]
fn emitted_code_equals_interpreter_and_evaluator() {
    let system = differentiate(assemble(&mixed()).expect("a sound mechanism")).expect("no third derivatives");
    let outputs = outputs(&system);
    let program = lower(&system.set.graph, &outputs);
    let ids: Vec<_> = outputs.iter().map(|(_, id)| *id).collect();
    let entries: Vec<(usize, usize)> = (system.equations.iter().enumerate())
        .flat_map(|(row, e)| e.phi_q.iter().map(move |(column, _)| (row, *column as usize)))
        .collect();
    assert_eq!(Mixed::model().constraint_pattern.entries, entries);
    assert_eq!(Mixed::COORDINATES, COORDINATES);

    let mut random = Random::new(0x00e3_177e);
    for _ in 0..200 {
        let mixed = Mixed { l: 0.5 + random.between(0.0, 1.0), h: random.between(0.0, 1.0) };
        let t = random.between(-1.0, 1.0);
        let q: [f64; COORDINATES] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let w: [f64; COORDINATES] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let environment = |symbol: Symbol| match symbol {
            Symbol::Parameter(0) => mixed.l,
            Symbol::Parameter(_) => mixed.h,
            Symbol::Time => t,
            Symbol::Input(..) => f64::NAN,
            Symbol::Coordinate(k) => q[k as usize],
            Symbol::Rate(k) => w[k as usize],
            _ => f64::NAN,
        };
        let mut workspace = Mixed::workspace::<f64>();
        mixed.evaluate(Subset::ALL, &Instant::at(t), &q, &w, &mut workspace).unwrap();
        let evaluated = evaluate(&system.set.graph, &ids, &environment);
        for ((slot, interpreted), evaluated) in interpret(&program, &environment).into_iter().zip(evaluated) {
            let emitted = match slot {
                Slot::Phi(k) => workspace.phi()[k],
                Slot::PhiQ(k) => workspace.phi_q()[k],
                Slot::PhiT(k) => workspace.phi_t()[k],
                Slot::Gamma(k) => workspace.gamma()[k],
                _ => f64::NAN,
            };
            assert!((emitted - interpreted).abs() <= 1e-14 * (1.0 + emitted.abs()), "{slot}: {emitted} {interpreted}");
            assert!((emitted - evaluated).abs() <= 1e-12 * (1.0 + emitted.abs()), "{slot}: {emitted} {evaluated}");
        }
    }
}

/// Each subset gives the same numbers as the evaluation of all parts.
#[test]
fn subsets_agree_with_the_whole() {
    let mixed = Mixed::default();
    let (q, w) = ([0.1, 0.4, -0.3, 0.2, 0.7, 0.5], [1.0, -0.4, 0.3, 0.2, -0.8, 0.6]);
    let at = Instant::at(0.3);
    let mut whole = Mixed::workspace::<f64>();
    mixed.evaluate(Subset::ALL, &at, &q, &w, &mut whole).unwrap();
    for bits in 0..16_u8 {
        let on = |bit: u8| bits & bit != 0;
        let subset = Subset { phi: on(1), phi_q: on(2), phi_t: on(4), gamma: on(8) };
        let mut part = Mixed::workspace::<f64>();
        mixed.evaluate(subset, &at, &q, &w, &mut part).unwrap();
        let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-14);
        assert!(!subset.phi || close(part.phi(), whole.phi()), "{subset:?}");
        assert!(!subset.phi_q || close(part.phi_q(), whole.phi_q()), "{subset:?}");
        assert!(!subset.phi_t || close(part.phi_t(), whole.phi_t()), "{subset:?}");
        assert!(!subset.gamma || close(part.gamma(), whole.gamma()), "{subset:?}");
    }
}

/// With the feature `equations`, the tables contain the derivation.
#[test]
fn equations_are_in_the_tables() {
    let equations = Mixed::model().equations;
    assert_eq!(equations.len(), Mixed::ROWS);
    let turn = equations.last().unwrap();
    assert_eq!((turn.row, turn.phi, turn.phi_t), ("turn", "arm.phi - (h + t*t)", "-(2*t)"));
    assert_eq!(turn.phi_q, [("arm.phi", "1")]);
}
