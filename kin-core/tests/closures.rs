//! Closures of single equations and of pairs, written freely: all digits of a root that stays where it is, and margins
//! that see what the roots are divided by.

mod support;

use kin_core::joints::Constraint;
use kin_core::mechanism::{Formula, Mechanism};
use kin_core::vocabulary::StepKind;
use std::f64::consts::TAU;
use support::chains::*;
use support::*;

fn planned(mechanism: &Mechanism, values: &[f64]) -> (Oracle, Planned) {
    let oracle = Oracle::new(mechanism, values);
    let planned = Planned::new(&oracle);
    assert_eq!(planned.newton(), [], "{}", planned.0);
    (oracle, planned)
}

/// p0 x² + p1 x + p2 = 0.
fn polynomial() -> Mechanism {
    let x = || scalar(0);
    let rows = vec![sum([mul(parameter(0), square(x())), mul(parameter(1), x()), parameter(2)])];
    equations(1, 3, rows)
}

#[test]
fn both_roots_of_a_quadratic_have_all_digits() {
    for exponent in 0..=15 {
        for [small, sign] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let roots = [0.25 * small * 2_f64.powi(-2 * exponent), 1.25 * sign * 2_f64.powi(2 * exponent)];
            for a in [1.0, -1.0, 0.125, roots[1].recip() / 4.0] {
                let values = [a, -a * (roots[0] + roots[1]), a * roots[0] * roots[1]];
                let (oracle, planned) = planned(&polynomial(), &values);
                let mut found: Vec<f64> = Vec::new();
                for mode in [1.0, -1.0] {
                    let solution = planned.run(&oracle, 0.0, &[mode], &[0.0]);
                    assert!(solution.margins[0] > 0.1, "{:?} of {values:?}", solution.margins);
                    let closure = planned.closures(&oracle, 0.0, &solution.q)[0];
                    assert!(closure * mode > 0.1, "{closure} of {:?}, {values:?}", solution.q);
                    found.push(solution.q[0]);
                }
                found.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
                for (root, found) in roots.into_iter().zip(found) {
                    let off = (found / root - 1.0).abs();
                    assert!(off <= 1e-15, "{found:e} for {root:e}, off by {off:e} of it: {values:?}");
                }
            }
        }
    }
}

/// (p0 cos q0 − p1) q1² + p2 q1 + p3 = 0, and q0 = t.
fn vanishing() -> Mechanism {
    let (angle, x) = (|| scalar(0), || scalar(1));
    let leading = sub(mul(parameter(0), cos(angle())), parameter(1));
    let row = sum([mul(leading, square(x())), mul(parameter(2), x()), parameter(3)]);
    equations(2, 4, vec![sub(angle(), Formula::Time), row])
}

#[test]
fn the_root_that_runs_away_is_at_a_limit_and_the_other_is_not() {
    for h in [1.0, -1.0] {
        let values = [2.0, 1.0, 2.0 * h, 0.75];
        let (oracle, planned) = planned(&vanishing(), &values);
        // cos 60° is ½ to the last bit or two, so that the coefficient is 0 or all but.
        let limit = 0.5_f64.acos();
        let mut last = 1.0;
        for exponent in 1..=16 {
            let (t, start) = (limit - 10_f64.powi(-exponent), [0.0; 2]);
            let stays = planned.run(&oracle, t, &[h], &start);
            let expected = oracle.solve(t, &stays.q).expect("a regular root");
            let off = difference(&expected.q, &stays.q);
            assert!(stays.margins[0] > 0.4 && off < 1e-15, "{:?} off by {off:e}", stays.margins);
            assert!((stays.q[1] * h + 0.375).abs() < 0.1, "{:?}", stays.q);
            let away = planned.run(&oracle, t, &[-h], &start);
            let margin = away.margins[0];
            assert!(margin >= 0.0 && (margin < last || exponent < 4), "{margin:e} at {exponent}, {last:e} before");
            last = margin;
        }
        assert!(last < 1e-12, "{last:e}");
    }
}

#[test]
fn a_leading_coefficient_of_zero_is_a_limit_of_one_root_only() {
    for (b, c) in [(2.0, 0.75), (-2.0, 0.75), (2.0, -0.75), (2.0, 0.0), (0.0, 0.0)] {
        let (oracle, planned) = planned(&polynomial(), &[0.0, b, c]);
        let [stays, away] = [1.0, -1.0].map(|sign: f64| {
            let mode = if b < 0.0 { -sign } else { sign };
            planned.run(&oracle, 0.0, &[mode], &[0.0])
        });
        assert_eq!(away.margins, [0.0], "{b} x + {c} = 0");
        if b == 0.0 {
            assert_eq!(stays.margins, [0.0]);
        } else {
            assert_eq!((stays.q, stays.margins), (vec![-c / b], vec![1.0]), "{b} x + {c} = 0");
        }
    }
}

/// Circles around (0, 0) with radius p0 and around (p1, p2) with radius p3.
fn circles() -> Mechanism {
    let (x, y) = (|| scalar(0), || scalar(1));
    let rows = vec![
        sub(add(square(x()), square(y())), square(parameter(0))),
        sub(add(square(sub(x(), parameter(1))), square(sub(y(), parameter(2)))), square(parameter(3))),
    ];
    equations(2, 4, rows)
}

#[test]
fn circles_around_almost_one_centre_have_no_margin() {
    let mut last = 2.0;
    for apart in [1e-2, 1e-3, 1e-4, 1e-7, 1e-10, 1e-13, 0.0] {
        let centre = [0.6 * apart, 0.8 * apart];
        // Both go through a point square to the line of the centres, or almost.
        let (oracle, planned) = planned(&circles(), &[2.0, centre[0], centre[1], 2.0]);
        assert_eq!(planned.0.steps[0].kind, StepKind::Closure);
        for mode in [1.0, -1.0] {
            let found = planned.run(&oracle, 0.0, &[mode], &[0.0; 2]);
            let margin = found.margins[0];
            assert!(!margin.is_nan() && margin <= last, "{margin:e} after {last:e}, {apart:e} apart");
            if margin > 1e-12 {
                let residual = oracle.residual(0.0, &found.q);
                assert!(residual < 4e-15 / margin.sqrt(), "{residual:e}, {apart:e} apart, margin {margin:e}");
            }
            if mode < 0.0 {
                last = margin;
            }
        }
    }
    assert!(last <= 0.0, "{last:e}");
}

/// Links of lengths p0 and p3 from (0, 0) and (p1, p2), by their angles.
fn links() -> Mechanism {
    let [a, b] = [0, 1].map(|k| move || scalar(k));
    let rows = vec![
        sum([mul(parameter(0), cos(a())), neg(mul(parameter(3), cos(b()))), neg(parameter(1))]),
        sum([mul(parameter(0), sin(a())), neg(mul(parameter(3), sin(b()))), neg(parameter(2))]),
    ];
    equations(2, 4, rows)
}

#[test]
fn links_around_almost_one_pin_have_no_margin() {
    let mut last = 2.0;
    for apart in [1e-2, 1e-3, 1e-4, 1e-7, 1e-10, 1e-13, 0.0] {
        let (oracle, planned) = planned(&links(), &[2.0, 0.6 * apart, 0.8 * apart, 2.0]);
        // Without the squared sine of the angle between the link and the line of the pins.
        let margin = planned.run(&oracle, 0.0, &[1.0], &[0.0; 2]).margins[0] / (1.0 - (apart / 4.0_f64).powi(2));
        assert!(!margin.is_nan() && margin <= last, "{margin:e} after {last:e}, {apart:e} apart");
        last = margin;
    }
    assert!(last <= 0.0, "{last:e}");
}

/// A link from (0, 0) whose end is on a line through (p1, p2), at the stroke q1; the line turns with the link, or with
/// time.
fn stroke(with_link: bool) -> Mechanism {
    let [link, stroke] = [0, 1].map(|k| move || scalar(k));
    let line = || if with_link { link() } else { Formula::Time };
    let rows = vec![
        sum([mul(stroke(), cos(line())), mul(parameter(0), sin(link())), neg(parameter(1))]),
        sum([mul(stroke(), sin(line())), neg(mul(parameter(0), cos(link()))), neg(parameter(2))]),
    ];
    equations(2, 3, rows)
}

/// A circle of radius p0 around (p1, p2), and a line.
fn circle_and_line() -> Mechanism {
    let (x, y) = (|| scalar(0), || scalar(1));
    let rows = vec![
        sub(add(square(sub(x(), parameter(1))), square(sub(y(), parameter(2)))), square(parameter(0))),
        sum([mul(sin(Formula::Time), x()), mul(cos(Formula::Time), y()), neg(parameter(1))]),
    ];
    equations(2, 3, rows)
}

#[test]
fn free_equations_have_the_letters_of_what_closes_in_them() {
    let values = [2.0, 1.5, 0.5, 1.0];
    let cases = [
        ("RRR", circles(), 4),
        ("RRP", circle_and_line(), 3),
        ("RRR", links(), 4),
        ("RPR", stroke(true), 3),
        ("RRP", stroke(false), 3),
    ];
    for (letters, mechanism, parameters) in cases {
        let (_, planned) = planned(&mechanism, &values[..parameters]);
        assert_eq!(planned.groups(), [letters], "{}", planned.0);
        assert_eq!(planned.0.modes[0].name, "N0-N1", "{}", planned.0);
    }
    // One angle, or one length, is no dyad.
    assert!(planned(&polynomial(), &values[..3]).1.groups().is_empty());
}

/// Links that turn twice and three times as far as q0 and q1, and a drift, so that they move.
fn multiples() -> Mechanism {
    let double = || mul(number(2.0), scalar(0));
    let triple = || sub(mul(number(-3.0), scalar(1)), Formula::Time);
    let rows = vec![
        sum([mul(parameter(0), cos(double())), neg(mul(parameter(3), cos(triple()))), neg(parameter(1))]),
        sum([
            mul(parameter(0), sin(double())),
            neg(mul(parameter(3), sin(triple()))),
            neg(parameter(2)),
            Formula::Time,
        ]),
    ];
    equations(2, 4, rows)
}

#[test]
fn a_multiple_of_an_angle_closes_and_gives_the_angle_nearest_the_start() {
    let values = [1.0, 0.7, 0.4, 1.3];
    let (oracle, planned) = planned(&multiples(), &values);
    assert_eq!(planned.closed(), 1, "{}", planned.0);
    for mode in [1.0, -1.0] {
        let first = planned.run(&oracle, 0.1, &[mode], &[0.0; 2]).q;
        for turns in -5..=5 {
            // Whole turns of twice q0 are half turns of it; of three times q1, thirds.
            let expected = [first[0] + 0.5 * TAU * f64::from(turns), first[1] - TAU / 3.0 * f64::from(turns)];
            let start = [expected[0] + 0.49 * TAU / 2.0, expected[1] - 0.49 * TAU / 3.0];
            let found = planned.run(&oracle, 0.1, &[mode], &start);
            assert!(difference(&expected, &found.q) < 1e-14, "{expected:?} {found:?}");
            assert!(planned.closures(&oracle, 0.1, &found.q)[0] * mode > 0.0);
            let truth = oracle.solve(0.1, &found.q).expect("regular");
            for (truth, found) in [(truth.q, found.q), (truth.q_dot, found.q_dot), (truth.q_ddot, found.q_ddot)] {
                assert!(difference(&truth, &found) < 1e-13, "{truth:?} {found:?}");
            }
        }
    }
}

/// Two coordinates by N0 and N1, and q2 = t.
fn with_time(mut rows: Vec<Formula>, parameters: usize) -> Mechanism {
    rows.push(sub(scalar(2), Formula::Time));
    equations(3, parameters, rows)
}

/// Margins fall with `small` and reach 0 with it; nothing of them is ever not a number.
fn falls(name: &str, margin: impl Fn(f64) -> f64) {
    let mut last = 2.0;
    for small in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0] {
        let margin = margin(small);
        assert!((0.0..last).contains(&margin), "{name}: {margin:e} at {small:e}, {last:e} before");
        last = margin;
    }
    assert!(last <= 0.0, "{name}: {last:e}");
}

/// The smallest margin at t.
fn smallest(mechanism: &Mechanism, values: &[f64], t: f64, start: &[f64]) -> f64 {
    let oracle = Oracle::new(mechanism, values);
    let planned = Planned::new(&oracle);
    let found = planned.run(&oracle, t, &vec![1.0; planned.0.modes.len()], start);
    // The margin of an iteration may be NaN where another one says that a step divides by 0.
    let known = found.margins.iter().all(|margin| !margin.is_nan());
    assert!(known || found.margins.iter().any(|margin| *margin <= 0.0), "{:?} of {}", found.margins, planned.0);
    found.margins.into_iter().fold(1.0, f64::min)
}

#[test]
fn what_a_pair_divides_by_has_a_margin() {
    // A stroke q1 along (cos q2 − p0, sin q2), which vanishes at t = 0, to the end of the link q0.
    let along = || sub(cos(scalar(2)), parameter(0));
    let stroke = with_time(
        vec![
            sum([mul(scalar(1), along()), mul(parameter(1), cos(scalar(0)))]),
            sum([mul(scalar(1), sin(scalar(2))), mul(parameter(1), sin(scalar(0))), neg(parameter(2))]),
        ],
        3,
    );
    falls("stroke", |small| smallest(&stroke, &[1.0, 0.5, 0.3], small, &[0.0; 3]));
    // A length q1 that is the same share of two rows, which come to one as they become parallel.
    let vector = |a: Formula, b: Formula| add(mul(a, cos(scalar(1))), mul(b, sin(scalar(1))));
    let vectors = with_time(
        vec![
            sub(add(vector(parameter(0), parameter(1)), mul(number(0.1), cos(scalar(0)))), number(0.3)),
            sub(add(vector(parameter(2), parameter(3)), mul(number(0.2), sin(scalar(0)))), number(0.3)),
        ],
        4,
    );
    falls("vectors", |small| smallest(&vectors, &[1.0, 0.0, 1.0, small], 0.0, &[0.1, 0.2, 0.0]));
}

#[test]
fn a_coefficient_that_vanishes_has_a_margin() {
    let coefficient = sub(cos(scalar(1)), parameter(0));
    let rows = vec![sub(mul(coefficient, scalar(0)), parameter(1)), sub(scalar(1), Formula::Time)];
    let mechanism = equations(2, 2, rows);
    falls("coefficient", |small| smallest(&mechanism, &[1.0, 0.5], small.sqrt(), &[0.0; 2]));
}

/// `n` linear equations with coefficients that turn with qₙ = t; the last is the first at t = 0.
fn linear(n: usize) -> Mechanism {
    let mut random = Random(n as u64);
    let mut first = Vec::new();
    let mut rows = Vec::new();
    for row in 0..n {
        let mut left = neg(number(random.between(0.5, 1.0)));
        for column in 0..n {
            let [mut c, s] = [0; 2].map(|_| random.between(0.5, 2.0) * if random.chance(50) { 1.0 } else { -1.0 });
            match row {
                0 => first.push(c),
                _ if row == n - 1 => c = first[column],
                _ => {}
            }
            let coefficient = add(mul(number(c), cos(scalar(n))), mul(number(s), sin(scalar(n))));
            left = add(left, mul(coefficient, scalar(column)));
        }
        rows.push(left);
    }
    rows.push(sub(scalar(n), Formula::Time));
    equations(n + 1, 0, rows)
}

#[test]
fn linear_systems_agree_and_have_margins() {
    for n in 2..=6 {
        let mechanism = linear(n);
        let (oracle, planned) = planned(&mechanism, &[]);
        assert!(planned.0.steps.iter().any(|step| step.kind == StepKind::Linear(n)), "{}", planned.0);
        let start = vec![0.0; n + 1];
        let truth = oracle.solve(0.7, &planned.run(&oracle, 0.7, &[], &start).q).expect("regular");
        let found = planned.run(&oracle, 0.7, &[], &start);
        for (truth, found) in [(&truth.q, &found.q), (&truth.q_dot, &found.q_dot), (&truth.q_ddot, &found.q_ddot)] {
            assert!(difference(truth, found) < 1e-11, "{n}: {truth:?} {found:?}");
        }
        let margin = |small: f64| planned.run(&oracle, small, &[], &start).margins[0];
        let [far, near, on] = [1e-2, 1e-7, 0.0].map(margin);
        assert!(0.0 < near && near < 2e-5 * far && on <= 1e-12, "{n}: {far:e} {near:e} {on:e}");
    }
}

/// Two wheels on fixed pins, the second made to turn by the first: p0 φ + p1 ψ = 0.
fn wheels() -> Mechanism {
    let turn = |k: usize| phi(body(k));
    let pin = |k: usize| joint(&format!("O{k}"), revolute(origin_of(GROUND), origin_of(body(k))));
    let couple =
        Constraint { left: add(mul(parameter(0), turn(0)), mul(parameter(1), turn(1))), right: Formula::ZERO }.into();
    Mechanism {
        name: "Wheels".into(),
        parameters: parameters(&[("p0", None), ("p1", None)]),
        bodies: vec![free("a", None), free("b", None)],
        joints: vec![pin(0), pin(1), joint("drive", driver(turn(0), Formula::Time)), joint("couple", couple)],
        ..Mechanism::default()
    }
}

#[test]
fn a_coordinate_that_a_parameter_gives_has_a_margin() {
    falls("wheels", |small| smallest(&wheels(), &[1.0, small], 1.0, &[0.0; 6]));
    // Both in other units: the same; a gearbox is far from trouble.
    let [small, large] = [1e-6, 1e6].map(|unit| smallest(&wheels(), &[50.0 * unit, unit], 1.0, &[0.0; 6]));
    assert!((small - large).abs() < 1e-15 && small > 0.99 && small < 1.0, "{small} {large}");
}
