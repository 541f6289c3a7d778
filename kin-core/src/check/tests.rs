use super::{MAX_MEMBERS, check, check_parts, is_reserved};
use crate::error::Origin;
use crate::joints::{Angle, Distance, Revolute, Rope, Translational};
use crate::mechanism::{
    Axis, Body, BodyOrigin, BodyRef, Component, Define, Formula, Guess, GuessTarget, Index, Mechanism, Member,
    Operands, Parameter, Place, Range, Scalar, Statement, Value,
};

const NOWHERE: Origin = Origin(0);

fn body(name: &str, origin: u32) -> Body {
    let origin_at = BodyOrigin::Free { x: None, y: None };
    Body { name: name.into(), len: None, origin_at, phi: None, origin: Origin(origin) }
}

fn at(family: usize, index: Index) -> BodyRef {
    BodyRef::Body { family, index, origin: Origin(100) }
}

fn single(family: usize) -> BodyRef {
    at(family, Index::default())
}

fn place(body: BodyRef) -> Place {
    Place { body, x: Formula::Number(1.0), y: Formula::ZERO, origin: Origin(101) }
}

fn ground() -> Place {
    place(BodyRef::Ground(NOWHERE))
}

fn joint(name: &str, operands: Operands) -> Statement {
    Statement { name: name.into(), range: None, operands, keyword: Origin(102), origin: Origin(103) }
}

fn pinned(k: usize) -> Statement {
    joint(&format!("J{k}"), Revolute { p: ground(), q: place(single(k)) }.into())
}

/// A crank on the ground.
fn crank() -> Mechanism {
    Mechanism { name: "M".into(), bodies: vec![body("crank", 1)], joints: vec![pinned(0)], ..Mechanism::default() }
}

fn said(mechanism: &Mechanism) -> Vec<String> {
    check(mechanism).into_iter().map(|error| error.message).collect()
}

#[track_caller]
fn one(mechanism: &Mechanism, part: &str) {
    let said = said(mechanism);
    assert!(said.len() == 1 && said[0].contains(part), "{said:?}");
}

#[test]
fn a_crank_is_fine() {
    assert_eq!(check(&crank()), []);
    assert!(is_reserved("pi") && !is_reserved("gamma"));
}

#[test]
fn names_are_checked_in_the_order_of_the_source() {
    let mut m = crank();
    let parameter = |name: &str, origin| Parameter {
        name: name.into(),
        len: None,
        unit: None,
        default: None,
        doc: String::new(),
        origin: Origin(origin),
    };
    m.parameters = vec![parameter("crank", 9), parameter("ln", 8)];
    m.joints.push(pinned(0));
    let errors = check(&m);
    let origins: Vec<u32> = errors.iter().map(|error| error.origin.0).collect();
    assert_eq!(origins, [8, 9, 103]);
    assert!(errors[1].message.contains("`crank` is a body already, and here a parameter"), "{errors:?}");
    assert!(errors[2].message.contains("`J0` is already used by a `revolute`"), "{errors:?}");
}

#[test]
fn families_and_ranges_have_members() {
    let mut m = crank();
    m.bodies[0].len = Some(0);
    assert!(said(&m)[0].contains("has no member"));
    m.bodies[0].len = Some(MAX_MEMBERS + 1);
    one(&m, "at most 10000");
    let mut m = crank();
    m.joints[0].range = Some(Range { start: 2, end: 2 });
    one(&m, "the range 2..2 of `J0` is empty");
    m.joints[0].range = Some(Range { start: 0, end: i64::MAX });
    one(&m, "leaves 0..10000");
}

#[test]
fn indices_exist_at_both_ends() {
    let mut m = crank();
    m.bodies[0].len = Some(3);
    m.joints[0].range = Some(Range { start: 0, end: 3 });
    let next = |scale, offset| Revolute { p: ground(), q: place(at(0, Index { scale, offset })) }.into();
    m.joints[0].operands = next(1, 0);
    assert_eq!(check(&m), []);
    m.joints[0].operands = next(1, 1);
    one(&m, "`crank[3]` does not exist (where the index variable is 2); there are `crank[0]` to `crank[2]`");
    m.joints[0].operands = next(i64::MAX, i64::MAX);
    one(&m, "does not exist");
    m.joints[0].operands = next(-1, 1);
    one(&m, "`crank[-1]`");
}

#[test]
fn circles_of_origins_and_defines_are_named() {
    let mut m = crank();
    m.bodies.push(body("arm", 2));
    m.bodies[0].origin_at = BodyOrigin::Carried(place(single(1)));
    m.bodies[1].origin_at = BodyOrigin::Carried(place(single(0)));
    one(&m, "`crank` is carried by `arm`, `arm` is carried by `crank`");
    let mut m = crank();
    let itself = Formula::Define(Member { family: 0, index: Index::default(), origin: NOWHERE });
    m.defines.push(Define { name: "s".into(), range: None, formula: itself, origin: Origin(3), unit: None });
    one(&m, "`s` uses itself");
}

#[test]
fn geometry_is_not_degenerate() {
    let mut m = crank();
    m.joints.push(joint("K", Revolute { p: place(single(0)), q: place(single(0)) }.into()));
    one(&m, "revolute `K` joins `crank` with itself");
    let axis = Axis { x: Formula::ZERO, y: Formula::Neg(Box::new(Formula::ZERO)), origin: Origin(4) };
    m.joints[1].operands = Translational { p: ground(), q: place(single(0)), axis, angle: Formula::Number(0.0) }.into();
    one(&m, "no direction");
    let distance = |length| -> Operands {
        Distance { p: ground(), q: place(single(0)), length: Value { value: length, origin: Origin(5) } }.into()
    };
    m.joints[1].operands = distance(Formula::ZERO);
    one(&m, "a length of 0");
    m.joints[1].operands = distance(Formula::Neg(Box::new(Formula::Number(2.0))));
    one(&m, "this one is -2");
    m.joints[1].operands = distance(Formula::Div(Box::new(Formula::Pi), Box::new(Formula::ZERO), Origin(6)));
    one(&m, "divides by 0");
}

#[test]
fn guesses_are_for_coordinates_once() {
    let guess = |body, component| Guess {
        target: GuessTarget::Pose(body, component),
        value: Formula::ZERO,
        range: None,
        origin: Origin(7),
    };
    let mut m = crank();
    m.guesses = vec![guess(single(0), Component::X), guess(single(0), Component::X)];
    one(&m, "`crank.x` is guessed twice");
    m.guesses.truncate(1);
    m.bodies[0].origin_at = BodyOrigin::Free { x: Some(Formula::ZERO), y: None };
    one(&m, "`crank.x` is held");
    m.guesses = vec![guess(BodyRef::Ground(NOWHERE), Component::X)];
    one(&m, "the ground does not move");
}

#[test]
fn everything_that_can_move_is_mentioned() {
    one(&Mechanism { name: "M".into(), ..Mechanism::default() }, "`M` has no coordinates");
    let mut m = crank();
    m.bodies.push(body("wheel", 2));
    m.scalars.push(Scalar { name: "u".into(), len: Some(2), origin: Origin(8), unit: None });
    let said = said(&m);
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(
        said[0].contains("no joint or equation contains a coordinate of `wheel`")
            && said[1].contains("any of the 2 members of `u`"),
        "{said:?}"
    );
    assert_eq!(check_parts(&m), []);
    // The wheel has a held angle and a carried origin, so no coordinate is left.
    m.scalars.clear();
    m.bodies[1].origin_at = BodyOrigin::Carried(place(single(0)));
    m.bodies[1].phi = Some(Formula::ZERO);
    assert_eq!(check(&m), []);
    m.joints.push(joint("K", Angle { body: single(1), value: Formula::ZERO }.into()));
    one(&m, "angle `K` contains no free coordinate");
}

/// A mechanism that is built by a program may contain what the user's language cannot express.
#[test]
fn a_rope_of_fewer_than_two_points_is_an_error_and_no_panic() {
    for count in [0, 1] {
        let mut m = crank();
        let length = Value { value: Formula::Number(1.0), origin: Origin(5) };
        let points = vec![place(single(0)); count];
        m.joints.push(joint("N", Rope { points, length }.into()));
        // A rope without points also violates the rule that a row contains a coordinate.
        let said = said(&m);
        assert!(said.len() == 2 - count && said.iter().any(|text| text.contains("two points or more")), "{said:?}");
        assert!(crate::assemble(&m).is_ok());
    }
}
