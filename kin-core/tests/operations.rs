//! Operation counts, which are exact: Φ, Φ_q, Φ_t and γ in one program, everything shared.

mod support;

use kin_core::joints::{Angle, Distance, RelativeAngle, Translational, X, Y};
use kin_core::mechanism::{Formula, Mechanism, Operands, Value};
use kin_core::program::lower;
use kin_core::vocabulary::OperationCount;
use kin_core::{assemble, differentiate};
use support::*;

fn count(mechanism: &Mechanism) -> OperationCount {
    let system = differentiate(assemble(mechanism).expect("a sound mechanism")).expect("no third derivatives");
    let program = combined(&system);
    println!("{system}\n{program}\n{:?}", program.operations());
    program.operations()
}

/// phi0 + omega t, from two parameters.
fn turning(phi0: usize, omega: usize) -> Formula {
    add(parameter(phi0), mul(parameter(omega), Formula::Time))
}

/// The lecture's four-bar, frames at the midpoints.
fn four_bar() -> Mechanism {
    let zero = || Formula::ZERO;
    let left = |k: usize| on(body(k), neg(half(parameter(k))), zero());
    let right = |k: usize| on(body(k), half(parameter(k)), zero());
    let drive = driver(phi(body(0)), turning(5, 6));
    Mechanism {
        name: "FourBar".into(),
        parameters: parameters(&["l1", "l2", "l3", "d1", "d2", "phi0", "omega"].map(|name| (name, None))),
        bodies: ["crank", "coupler", "rocker"].map(|name| free(name, None)).to_vec(),
        joints: vec![
            joint("C", revolute(origin_of(GROUND), left(0))),
            joint("A", revolute(right(0), left(1))),
            joint("B", revolute(right(1), left(2))),
            joint("D", revolute(right(2), on(GROUND, parameter(3), parameter(4)))),
            joint("drive", drive),
        ],
        ..Mechanism::default()
    }
}

#[test]
fn the_lecture_four_bar_costs_what_the_hand_formula_costs() {
    let count = count(&four_bar());
    assert_eq!((count.flops(), count.sincos), (47, 3), "{count:?}");
}

/// A crank-shaper: a block on the crank's pin slides in the offset slot of a rocker, which drives a ram by a rod.
fn quick_return() -> Mechanism {
    let [a, x1, r, l, b, h, e, w] = std::array::from_fn(parameter);
    let slot = || add(number(0.01), e.clone());
    let sliding = |p, q, c| Translational { p, q, axis: axis(number(1.0), Formula::ZERO), angle: number(c) }.into();
    let along = number(0.01);
    let ram = || on(body(4), number(0.05), number(0.02));
    let angle =
        add(add(number(0.4), mul(w, Formula::Time)), mul(number(0.08), Formula::Pow(Box::new(Formula::Time), 2.0)));
    Mechanism {
        name: "QuickReturn".into(),
        parameters: parameters(&["a", "x1", "r", "l", "b", "h", "e", "w"].map(|name| (name, None))),
        bodies: ["crank", "block", "rocker", "rod", "ram"].map(|name| free(name, None)).to_vec(),
        joints: vec![
            joint("O2", revolute(on(GROUND, x1, a), origin_of(body(0)))),
            joint("C", revolute(on(body(0), r, Formula::ZERO), origin_of(body(1)))),
            joint("slot", sliding(on(body(2), Formula::ZERO, slot()), origin_of(body(1)), 0.15)),
            joint("O4", revolute(origin_of(GROUND), on(body(2), neg(half(l.clone())), along.clone()))),
            joint("B", revolute(on(body(2), half(l), along), on(body(3), neg(b), Formula::ZERO))),
            joint("R", revolute(origin_of(body(3)), ram())),
            joint("guide", sliding(on(GROUND, Formula::ZERO, h), ram(), 0.0)),
            joint("drive", driver(phi(body(0)), angle)),
        ],
        ..Mechanism::default()
    }
}

#[test]
fn the_quick_return_with_its_moving_guide() {
    let count = count(&quick_return());
    assert_eq!((count.flops(), count.sincos), (93, 4), "{count:?}");
}

fn one_joint(operands: Operands) -> Mechanism {
    Mechanism {
        parameters: parameters(&["p0", "p1", "p2", "p3", "e"].map(|name| (name, None))),
        bodies: ["i", "j"].map(|name| free(name, None)).to_vec(),
        joints: vec![joint("N", operands)],
        ..Mechanism::default()
    }
}

#[test]
fn a_distance_between_two_bodies() {
    let [a, b, c, d, e] = std::array::from_fn(parameter);
    let p = || on(body(0), a.clone(), b.clone());
    let length = || e.clone();
    let row = |q| Distance { p: p(), q, length: Value { value: length(), origin: AT } }.into();
    let moving = count(&one_joint(row(on(body(1), c, d))));
    assert_eq!((moving.flops(), moving.sincos), (59, 2), "{moving:?}");
    let grounded = count(&one_joint(row(origin_of(GROUND))));
    assert_eq!((grounded.flops(), grounded.sincos), (33, 1), "{grounded:?}");
}

#[test]
fn a_component_that_is_literally_zero_costs_nothing() {
    let pin = |x: Formula, y: Formula| count(&one_joint(revolute(origin_of(GROUND), on(body(0), x, y))));
    let both = pin(parameter(0), parameter(1));
    // ρ takes four products and two sums, Φ two sums, γ = ρ φ̇² three products, −ρ_y in Φ_q a negation.
    assert_eq!((both.flops(), both.sincos), (12, 1), "{both:?}");
    let along_x = pin(parameter(0), Formula::ZERO);
    assert_eq!((along_x.flops(), along_x.sincos), (8, 1), "{along_x:?}");
    // Of Φ_q = (−ρ_y, ρ_x) and γ = (ρ_x, ρ_y) φ̇² three are negative for (0, y), or one with −y.
    let along_y = pin(Formula::ZERO, parameter(0));
    assert_eq!((along_y.flops(), along_y.sincos), (9, 1), "{along_y:?}");
    // At the body's origin there is nothing to turn.
    assert_eq!(pin(Formula::ZERO, Formula::ZERO), OperationCount::default());
    // And a literal one is no factor.
    let unit = pin(number(1.0), Formula::ZERO);
    assert_eq!((unit.flops(), unit.sincos), (6, 1), "{unit:?}");
}

#[test]
fn rows_without_geometry_cost_their_formula() {
    let p = || origin_of(body(0));
    for kind in [
        X { p: p(), value: parameter(4) }.into(),
        Y { p: p(), value: parameter(4) }.into(),
        Angle { body: body(0), value: parameter(4) }.into(),
        RelativeAngle { a: body(0), b: body(1), value: Formula::ZERO }.into(),
    ] {
        assert_eq!(count(&one_joint(kind)).flops(), 1);
    }
}

#[test]
fn a_negative_double_is_one_product() {
    let square = Formula::Pow(Box::new(Formula::Time), 2.0);
    let count = count(&one_joint(Angle { body: body(0), value: square }.into()));
    // φ − t², Φ_t = −2t, γ = 2.
    assert_eq!((count.add, count.mul, count.neg), (1, 2, 0), "{count:?}");
}

#[test]
fn programs_grow_with_the_number_of_loops() {
    let sizes = [10_usize, 20, 40].map(|loops| {
        let system = differentiate(assemble(&chain(loops)).expect("a sound mechanism")).expect("no third derivatives");
        assert_eq!(system.equations.len(), 9 * loops);
        let program = combined(&system);
        (program.instructions.len(), program.operations().flops(), system.set.graph.len())
    });
    let step = |a: usize, b: usize| b - a;
    assert_eq!(2 * step(sizes[0].0, sizes[1].0), step(sizes[1].0, sizes[2].0));
    assert_eq!(2 * step(sizes[0].1, sizes[1].1), step(sizes[1].1, sizes[2].1));
    assert_eq!(2 * step(sizes[0].2, sizes[1].2), step(sizes[1].2, sizes[2].2));
    assert_eq!(lower(&kin_core::expr::Graph::new(), &[]).instructions.len(), 0);
}
