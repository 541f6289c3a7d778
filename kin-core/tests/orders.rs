//! Derivatives that nobody supplies are refused where they would be needed, and nowhere else.

use kin_core::constraint::ConstraintSet;
use kin_core::expr::Symbol;
use kin_core::joints::Driver;
use kin_core::mechanism::{Formula, Index, Input, Mechanism, Member, Scalar, Statement, Value};
use kin_core::{Origin, assemble, differentiate};

const KEYWORD: Origin = Origin(7);

/// One scalar coordinate with the row c − u = 0.
fn follower() -> ConstraintSet {
    let member = Member { family: 0, index: Index::default(), origin: Origin(2) };
    let follow = Statement {
        name: "follow".into(),
        range: None,
        operands: Driver {
            left: Formula::Scalar(member),
            right: Value { value: Formula::Input(member), origin: Origin(2) },
        }
        .into(),
        keyword: KEYWORD,
        origin: Origin(3),
    };
    let mechanism = Mechanism {
        inputs: vec![Input { name: "u".into(), len: None, origin: Origin(0), unit: None, default: None }],
        scalars: vec![Scalar { name: "c".into(), len: None, origin: Origin(1), unit: None }],
        joints: vec![follow],
        ..Mechanism::default()
    };
    assemble(&mechanism).expect("a sound mechanism")
}

#[test]
fn two_derivatives_of_an_input_are_enough_for_a_position_row() {
    let system = differentiate(follower()).expect("value, rate and acceleration");
    assert!(system.classes[0].rheonomic && system.classes[0].driving);
    let set = &system.set;
    assert_eq!(set.show(system.equations[0].phi_t), "-u_dot");
    assert_eq!(set.show(system.equations[0].gamma), "u_ddot");
}

#[test]
fn a_row_that_needs_a_third_derivative_is_refused_on_its_keyword() {
    let mut set = follower();
    let rate = set.graph.symbol(Symbol::Input(0, 1));
    set.rows[0].phi = set.graph.add(set.rows[0].phi, rate);
    let errors = differentiate(set).expect_err("the acceleration equation needs a third derivative");
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert_eq!(errors[0].origin, KEYWORD);
    assert!(errors[0].message.contains("third derivative of `u`"), "{errors:?}");
}
