//! Nothing blows up: long sums, long products, nested defines, long chains of bodies, numbers at the edge.

mod support;

use kin_core::expr::{Graph, Shown, Symbol, total_derivatives};
use kin_core::joints::Constraint;
use kin_core::mechanism::{BodyOrigin, Define, Formula, Function, Mechanism, Operand, Range, Value};
use kin_core::program::{Instruction, Slot, lower};
use kin_core::{assemble, differentiate};
use support::*;

const Q: Symbol = Symbol::Coordinate(0);

fn at(value: f64) -> impl Fn(Symbol) -> f64 {
    move |symbol| if symbol == Q { value } else { 1.0 }
}

#[test]
fn a_sum_of_ten_thousand_terms() {
    let mut formula = Formula::Time;
    for k in 0..10_000 {
        let term = mul(number(f64::from(k)), Formula::Call(Function::Sin, Box::new(phi(body(0)))));
        formula = if k % 2 == 0 { add(formula, term) } else { sub(formula, term) };
    }
    let mechanism = Mechanism {
        bodies: vec![free("b", None)],
        joints: vec![joint("N", Constraint { left: formula, right: Formula::ZERO }.into())],
        ..Mechanism::default()
    };
    let system = differentiate(assemble(&mechanism).expect("a sound mechanism")).expect("no third derivatives");
    assert_eq!(system.to_string().matches(" = ").count(), 4);
    let values = |symbol| if symbol == Symbol::Coordinate(2) { 0.5 } else { 1.0 };
    let found = interpret(&combined(&system), &values);
    let expected =
        1.0 + 0.5_f64.sin() * (0..10_000).map(|k| if k % 2 == 0 { f64::from(k) } else { -f64::from(k) }).sum::<f64>();
    assert!((found[0].1 - expected).abs() < 1e-8);
    // The formula itself is deep; dropping it must not be what fails.
    drop_flat(mechanism);
}

/// OperandType a long sum apart from its outside.
fn drop_flat(mechanism: Mechanism) {
    for operand in mechanism.joints.into_iter().flat_map(|joint| joint.operands.into_values()) {
        if let Operand::Value(Value { value: mut rest, .. }) = operand {
            while let Formula::Add(a, _) | Formula::Sub(a, _) = rest {
                rest = *a;
            }
        }
    }
}

#[test]
fn squares_of_squares() {
    let mut graph = Graph::new();
    let mut power = graph.symbol(Q);
    for _ in 0..60 {
        power = graph.square(power);
    }
    assert!(graph.len() < 200, "{} nodes", graph.len());
    let jet = total_derivatives(&mut graph, &[power]).remove(0);
    assert!(graph.len() < 2000, "{} nodes", graph.len());
    let outputs = [(Slot::Entry(0), power), (Slot::Entry(1), jet.rate), (Slot::Entry(2), jet.rest)];
    let program = lower(&graph, &outputs);
    assert!(program.instructions.len() < 1000);
    assert_eq!(interpret(&program, &at(1.0))[0].1, 1.0);
    assert_eq!(interpret(&program, &at(1.0))[1].1, 2.0_f64.powi(60));
    assert!(Shown { graph: &graph, names: &(), id: power }.to_string().len() < 1_000_000);
}

#[test]
fn sums_and_products_in_turn() {
    let mut graph = Graph::new();
    let (q, p) = (graph.symbol(Q), graph.symbol(Symbol::Parameter(0)));
    let mut e = q;
    for _ in 0..60 {
        let (left, right) = (graph.add(e, q), graph.add(e, p));
        e = graph.mul(left, right);
        let (left, right) = (graph.sub(e, q), graph.neg(e));
        e = graph.add(left, right);
        let square = graph.square(left);
        e = graph.add(e, square);
    }
    let jet = total_derivatives(&mut graph, &[e]).remove(0);
    let outputs = [(Slot::Entry(0), e), (Slot::Entry(1), jet.rest)];
    assert!(lower(&graph, &outputs).instructions.len() < 10_000);
    assert!(Shown { graph: &graph, names: &(), id: e }.to_string().ends_with('…'));
}

#[test]
fn a_product_of_a_thousand_factors() {
    let mut graph = Graph::new();
    let mut product = graph.number(1.0);
    for k in 0..1000 {
        let factor = graph.symbol(Symbol::Parameter(999 - k));
        product = graph.mul(product, factor);
    }
    assert!(graph.len() < 4000, "{} nodes", graph.len());
    assert_eq!(evaluate(&graph, &[product], &at(1.0)), [1.0]);
}

#[test]
fn defines_of_defines() {
    let used = |k: usize| Formula::Define(member(k, index(0, 0)));
    let square = |k: usize| add(mul(used(k), used(k)), neg(used(k)));
    let define =
        |(k, formula): (usize, Formula)| Define { name: format!("s{k}"), range: None, formula, origin: AT, unit: None };
    let formulas = std::iter::once(phi(body(0))).chain((0..50).map(square));
    let mechanism = Mechanism {
        bodies: vec![free("b", None)],
        defines: formulas.enumerate().map(define).collect(),
        ..Mechanism::default()
    };
    let set = assemble(&mechanism).expect("a sound mechanism");
    assert!(set.graph.len() < 400, "{} nodes", set.graph.len());
}

#[test]
fn defines_in_reverse_order() {
    // Each uses the next one, and a held coordinate uses the first; the last is an angle.
    let used = |k: usize| Formula::Define(member(k, index(0, 0)));
    let define =
        |(k, formula): (usize, Formula)| Define { name: format!("s{k}"), range: None, formula, origin: AT, unit: None };
    let formulas = (1..3000).map(|k| add(used(k), number(1.0))).chain([phi(body(0))]);
    let mechanism = Mechanism {
        bodies: vec![free("b", None), kin_core::mechanism::Body { phi: Some(used(0)), ..free("c", None) }],
        defines: formulas.enumerate().map(define).collect(),
        joints: vec![joint("A", revolute(origin_of(body(0)), origin_of(body(1))))],
        ..Mechanism::default()
    };
    // With as little room as a worker thread of a compiler may have left.
    let work = move || {
        assert_eq!(kin_core::check::check(&mechanism), []);
        assert_eq!(kin_core::units::check(&mechanism), []);
        let set = assemble(&mechanism).expect("no circle");
        assert_eq!(evaluate(&set.graph, &[set.bodies[1].pose[2]], &|_| 0.5), [2999.5]);
    };
    let small = std::thread::Builder::new().stack_size(1 << 19).spawn(work).expect("a thread");
    small.join().expect("no overflow, no failure");
}

#[test]
fn a_define_of_itself_is_an_error() {
    let used = |k: usize| Formula::Define(member(k, index(0, 0)));
    let define = |name: &str, formula| Define { name: name.into(), range: None, formula, origin: AT, unit: None };
    let defines = vec![define("a", used(1)), define("b", add(used(0), used(0)))];
    let errors = assemble(&Mechanism { defines, ..Mechanism::default() }).expect_err("a circle");
    assert!(errors.iter().all(|e| e.message.contains("defined by itself")), "{errors:?}");
}

#[test]
fn a_define_out_of_range_is_an_error() {
    let range = Some(Range { start: 0, end: 3 });
    let define = |range, formula| Define { name: "s".into(), range, formula, origin: AT, unit: None };
    let defines = vec![define(range, number(1.0)), define(None, Formula::Define(member(0, index(0, 3))))];
    let errors = assemble(&Mechanism { defines, ..Mechanism::default() }).expect_err("out of range");
    assert_eq!(errors.len(), 1, "{errors:?}");
}

#[test]
fn origins_carried_backwards() {
    // Each body is carried by the next one.
    let mut bodies: Vec<_> = (0..3000)
        .map(|k| {
            let carrier = on(body(k + 1), parameter(0), Formula::ZERO);
            kin_core::mechanism::Body { origin_at: BodyOrigin::Carried(carrier), ..free("b", None) }
        })
        .collect();
    bodies.push(free("b", None));
    let mechanism = Mechanism { parameters: parameters(&[("l", None)]), bodies, ..Mechanism::default() };
    let set = assemble(&mechanism).expect("no circle");
    let x = evaluate(&set.graph, &[set.bodies[0].pose[0]], &|symbol| match symbol {
        Symbol::Parameter(_) => 1.0,
        _ => 0.0,
    });
    assert_eq!(x, [3000.0]);
}

#[test]
fn origins_that_carry_themselves_are_an_error() {
    let carried = |by: usize| kin_core::mechanism::Body {
        origin_at: BodyOrigin::Carried(origin_of(body(by))),
        ..free("b", None)
    };
    for bodies in [vec![carried(0)], vec![carried(1), carried(0)], vec![carried(1), carried(2), carried(1)]] {
        let errors = assemble(&Mechanism { bodies, ..Mechanism::default() }).expect_err("a circle");
        assert_eq!(errors.len(), 1, "{errors:?}");
        assert!(errors[0].message.contains("carried by itself"));
    }
    // And an angle held at itself.
    let held = kin_core::mechanism::Body { phi: Some(phi(body(0))), ..free("b", None) };
    assert!(assemble(&Mechanism { bodies: vec![held], ..Mechanism::default() }).is_err());
}

#[test]
fn an_index_out_of_range_is_reported_once() {
    let row = revolute(origin_of(GROUND), origin_of(body_of(0, 0, 2)));
    let mechanism =
        Mechanism { bodies: vec![free("b", Some(2))], joints: vec![joint("A", row)], ..Mechanism::default() };
    assert_eq!(assemble(&mechanism).expect_err("out of range").len(), 1);
}

#[test]
fn numbers_at_the_edge_stay_numbers() {
    let mut graph = Graph::new();
    let (q, big, small) = (graph.symbol(Q), graph.number(1e200), graph.number(1e-200));
    let a = graph.mul(big, q);
    let much = graph.mul_all([a, a, q, q]);
    assert_eq!(evaluate(&graph, &[much], &at(1e-110)), [1e200 * 1e-110 * 1e200 * 1e-110 * 1e-110 * 1e-110]);
    let b = graph.mul(small, q);
    let little = graph.mul(b, b);
    assert!((evaluate(&graph, &[little], &at(1e150))[0] - 1e-100).abs() < 1e-110);
    let max = graph.number(f64::MAX);
    let sum = graph.add(max, max);
    assert_eq!(evaluate(&graph, &[sum], &at(0.0)), [f64::INFINITY]);
    let zero = graph.zero();
    let pole = graph.div(q, zero);
    assert!(evaluate(&graph, &[pole], &at(1.0))[0].is_infinite());
    let none = graph.div(zero, zero);
    assert!(evaluate(&graph, &[none], &at(1.0))[0].is_nan());
    let cancelled = graph.sub(pole, pole);
    assert!(graph.is_zero(cancelled));
}

#[test]
fn literals_stay_finite() {
    let mut graph = Graph::new();
    let (q, max) = (graph.symbol(Q), graph.number(f64::MAX));
    let (power, double, square) = (graph.powf(q, 1e200), graph.double(max), graph.square(max));
    let product = graph.mul(max, q);
    let much = graph.square(product);
    let cube = graph.powi(max, 3);
    let roots = [power, double, square, much, cube];
    let jets = total_derivatives(&mut graph, &roots);
    let outputs = roots.into_iter().chain(jets.iter().flat_map(|jet| [jet.rate, jet.rest]));
    let outputs: Vec<_> = outputs.enumerate().map(|(k, id)| (Slot::Entry(k), id)).collect();
    for instruction in lower(&graph, &outputs).instructions {
        if let Instruction::Number(number) = instruction {
            assert!(number.value().is_finite());
        }
    }
}

#[test]
fn real_powers_of_negative_numbers() {
    let mut graph = Graph::new();
    let q = graph.symbol(Q);
    for (n, expected) in [(3.0, -8.0), (2.0, 4.0), (-1.0, -0.5), (2001.0, f64::NEG_INFINITY), (0.0, 1.0)] {
        let power = graph.powf(q, n);
        let program = lower(&graph, &[(Slot::Entry(0), power)]);
        assert_eq!(evaluate(&graph, &[power], &at(-2.0)), [expected]);
        assert_eq!(interpret(&program, &at(-2.0))[0].1, expected);
    }
    for n in [0.5, 1.5, -0.5] {
        let power = graph.powf(q, n);
        assert!(evaluate(&graph, &[power], &at(-2.0))[0].is_nan());
    }
}

#[test]
fn vectors_that_do_not_turn_cost_nothing() {
    let mut graph = Graph::new();
    let (q, zero, one, half) = (graph.symbol(Q), graph.zero(), graph.number(1.0), graph.number(0.5));
    assert_eq!(graph.rotate(q, [zero, zero]), [zero, zero]);
    assert_eq!(graph.rotate(zero, [one, q]), [one, q]);
    let turned = graph.rotate(half, [q, zero]);
    let found = evaluate(&graph, &turned, &at(2.0));
    assert_eq!(found, [2.0 * 0.5_f64.cos(), 2.0 * 0.5_f64.sin()]);
    let opposite = graph.neg(q);
    for k in -8..=8_i32 {
        let angle = graph.number(f64::from(k) * core::f64::consts::FRAC_PI_2);
        let turned = graph.rotate(angle, [q, one]);
        let (sin, cos) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][k.rem_euclid(4) as usize];
        assert_eq!(evaluate(&graph, &turned, &at(2.0)), [2.0 * cos - sin, 2.0 * sin + cos]);
        assert_eq!(lower(&graph, &[(Slot::Entry(0), turned[0])]).operations().sincos, 0);
    }
    for s in [[q, zero], [zero, q], [q, half], [q, opposite]] {
        let turned = graph.rotate(half, s);
        let minus_s = s.map(|s| graph.neg(s));
        let minus_turned = graph.rotate(half, minus_s);
        assert_eq!(minus_turned.map(|e| graph.neg(e)), turned, "one atom with a sign");
    }
}
