//! Redundant rows: plans that do without them agree with Newton's iteration on a mechanism that has none, and see it when
//! the rows contradict.

mod support;

use kin_core::Mechanism;
use kin_core::check::check;
use kin_core::joints::{Distance, PointOnLine, RelativeAngle, Revolute};
use kin_core::mechanism::{Statement, Value};
use kin_core::plan::{SolutionPlan, TOLERANCE};
use kin_core::vocabulary::StepKind;
use std::ops::Range;
use support::chains::*;
use support::*;

/// A mechanism in two ways: with as many rows as coordinates, and with redundant rows that say the same.
struct Twice {
    draft: Draft,
    plain: Vec<Statement>,
    redundant: Vec<Statement>,
    /// Parameters that the redundant rows alone hold, and that they cannot do with another value of, group by group.
    essential: Vec<Range<usize>>,
}

impl Twice {
    fn new(seed: u64) -> Self {
        let draft = Draft::new(seed);
        Self { draft, plain: Vec::new(), redundant: Vec::new(), essential: Vec::new() }
    }

    /// What `add` adds, to the one and to the other.
    fn joints(&mut self, plain: bool, redundant: bool, add: impl FnOnce(&mut Draft)) {
        add(&mut self.draft);
        let new = std::mem::take(&mut self.draft.mechanism.joints);
        let name = |joint: Statement, k: usize| Statement { name: format!("J{k}"), ..joint };
        for joint in new {
            let count = self.plain.len() + self.redundant.len();
            if plain {
                self.plain.push(name(joint.clone(), count));
            }
            if redundant {
                self.redundant.push(name(joint, count));
            }
        }
    }

    fn both(&mut self, add: impl FnOnce(&mut Draft)) {
        self.joints(true, true, add);
    }

    fn essential(&mut self, from: usize) {
        // A place at the origin of its frame has no parameter.
        self.essential.extend(Some(from..self.draft.values.len()).filter(|range| !range.is_empty()));
    }

    fn mechanism(&self, joints: &[Statement]) -> Mechanism {
        let mechanism = Mechanism { joints: joints.to_vec(), ..self.draft.mechanism.clone() };
        assert_eq!(check(&mechanism), [], "{mechanism}");
        mechanism
    }

    /// A pin of `b` with `a`, whose place on `b` is essential to it.
    fn redundant_pin(&mut self, a: usize, b: usize, at: Vector) {
        let from = self.draft.values.len();
        let q = self.draft.place(b, at);
        self.essential(from);
        self.joints(false, true, |draft| {
            let p = draft.place(a, at);
            draft.add(Revolute { p, q }.into());
        });
    }

    /// The angle of `b` against `a`.
    fn angle(&mut self, plain: bool, redundant: bool, a: usize, b: usize) {
        let from = self.draft.values.len();
        self.joints(plain, redundant, |draft| {
            // Not 0, so that it is a parameter.
            let value = draft.poses[b][2] - draft.poses[a][2] + 1e-3;
            draft.values.push(value);
            draft.mechanism.parameters.push(kin_core::mechanism::Parameter {
                name: format!("p{}", draft.values.len()),
                len: None,
                unit: None,
                default: None,
                doc: String::new(),
                origin: AT,
            });
            let value = add(parameter(draft.values.len() - 1), number(-1e-3));
            let (a, b) = (draft.named(a), draft.named(b));
            draft.add(RelativeAngle { a, b, value }.into());
        });
        if !plain {
            self.essential(from);
        }
    }

    /// A parallelogram with a driven crank: the crank, the coupler and the rocker, and the vector of the cranks.
    fn parallelogram(&mut self, pins: &[Vector]) -> ([usize; 3], Vector) {
        let random = &mut self.draft.random;
        let crank = turned(random.between(0.5, 2.5), [random.between(0.4, 1.2), 0.0]);
        let ends: Vec<Vector> = pins.iter().map(|&pin| plus(pin, crank)).collect();
        let [a, b] = [0, 1].map(|k| self.draft.link(&[pins[k], ends[k]]));
        let coupler = self.draft.link(&ends);
        self.both(|draft| draft.pin(FIXED, a, pins[0]));
        self.both(|draft| draft.pin(FIXED, b, pins[1]));
        self.both(|draft| draft.pin(a, coupler, ends[0]));
        self.both(|draft| draft.pin(b, coupler, ends[1]));
        let omega = self.draft.random.between(0.6, 1.4);
        self.both(|draft| draft.drive(FIXED, a, omega));
        ([a, coupler, b], crank)
    }

    fn shuffle(&mut self) {
        for k in (1..self.redundant.len()).rev() {
            let other = self.draft.random.below(k + 1);
            self.redundant.swap(k, other);
        }
    }
}

/// Pins of a frame, none near the line through two others.
fn pins(random: &mut Random, count: usize) -> Vec<Vector> {
    let first = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
    let mut out = vec![first, plus(first, [random.between(1.2, 2.0), random.between(-0.2, 0.2)])];
    while out.len() < count {
        let k = out.len() as f64;
        out.push(plus(
            first,
            [random.between(0.1, 1.9), (0.6 + 0.3 * k) * if out.len().is_multiple_of(2) { 1.0 } else { -1.0 }],
        ));
    }
    out
}

/// A platform on three to five parallel cranks.
fn cranks(seed: u64) -> Twice {
    let mut twice = Twice::new(seed);
    let count = 3 + seed as usize % 3;
    let pins = pins(&mut twice.draft.random, count);
    let ([first, platform, _], crank) = twice.parallelogram(&pins);
    for &pin in &pins[2..] {
        let end = plus(pin, crank);
        let other = twice.draft.link(&[pin, end]);
        twice.both(|draft| draft.pin(FIXED, other, pin));
        twice.angle(true, false, first, other);
        twice.redundant_pin(platform, other, end);
    }
    twice
}

/// A parallelogram with one or two more parallel links that are distances.
fn rods(seed: u64) -> Twice {
    let mut twice = Twice::new(seed);
    let pins = pins(&mut twice.draft.random, 3 + seed as usize % 2);
    let ([_, coupler, _], crank) = twice.parallelogram(&pins);
    for &pin in &pins[2..] {
        let end = plus(pin, crank);
        let from = twice.draft.values.len();
        let size = twice.draft.value(length(crank));
        twice.essential(from);
        twice.joints(false, true, |draft| {
            let (p, q) = (draft.place(FIXED, pin), draft.place(coupler, end));
            draft.add(Distance { p, q, length: Value { value: size, origin: AT } }.into());
        });
    }
    twice
}

/// A parallelogram that is told that the coupler does not turn, or that both cranks turn alike, or both.
fn angles(seed: u64) -> Twice {
    let mut twice = Twice::new(seed);
    let pins = pins(&mut twice.draft.random, 2);
    let ([crank, coupler, rocker], _) = twice.parallelogram(&pins);
    if !seed.is_multiple_of(3) {
        twice.angle(false, true, FIXED, coupler);
    }
    if seed % 3 != 1 {
        twice.angle(false, true, crank, rocker);
    }
    twice
}

/// A slider-crank with a pin that is there twice, and a slider on two guides or three.
fn doubled(seed: u64) -> Twice {
    let mut twice = Twice::new(seed);
    let random = &mut twice.draft.random;
    let (psi, at) = (random.between(-1.0, 1.0), [random.between(1.6, 2.2), random.between(-0.3, 0.3)]);
    let end = turned(random.between(0.7, 2.2), [0.6, 0.0]);
    let crank = twice.draft.link(&[[0.0, 0.0], end]);
    let rod = twice.draft.link(&[end, at]);
    let slider = twice.draft.link(&[at]);
    twice.both(|draft| draft.pin(FIXED, crank, [0.0, 0.0]));
    twice.both(|draft| draft.pin(crank, rod, end));
    twice.both(|draft| draft.pin(rod, slider, at));
    twice.both(|draft| draft.slide(FIXED, slider, at, psi));
    twice.both(|draft| draft.drive(FIXED, crank, 0.9));
    if seed.is_multiple_of(2) {
        twice.redundant_pin(crank, rod, end);
    }
    for _ in 0..1 + seed % 2 {
        let psi_off = turned(psi, [0.3, 0.7]);
        let from = twice.draft.values.len();
        let offset = twice.draft.value(0.4);
        twice.essential(from);
        twice.joints(false, true, |draft| {
            let foot = plus(minus(plus(at, psi_off), turned(psi, [0.0, 0.4])), turned(psi, [0.2, 0.0]));
            let (p, q) = (draft.place(FIXED, foot), draft.place(slider, plus(at, psi_off)));
            let axis = draft.axis(FIXED, psi);
            draft.add(PointOnLine { p, q, axis, offset }.into());
        });
    }
    twice
}

/// A mechanism of a family, by its number.
type Family = fn(u64) -> Twice;

const FAMILIES: [(&str, Family); 4] =
    [("parallel cranks", cranks), ("parallel rods", rods), ("angles", angles), ("doubled joints", doubled)];

/// The least margin of redundant rows.
fn least_of_redundant_rows(plan: &SolutionPlan, margins: &[f64]) -> f64 {
    let redundant = plan.steps.iter().filter(|step| step.kind == StepKind::RedundantRows);
    let of = redundant.flat_map(|step| step.margins.clone()).map(|place| margins[place]);
    of.fold(f64::INFINITY, f64::min)
}

/// Every family from twenty seeds, calm where it starts, its joints in the order of declaration or shuffled.
fn drawn() -> impl Iterator<Item = (String, Twice, Oracle, Instant)> {
    FAMILIES.iter().flat_map(|&(name, family)| {
        (0..24).filter_map(move |seed| {
            let mut twice = family(seed);
            if seed % 4 > 0 {
                twice.shuffle();
            }
            let plain = Oracle::new(&twice.mechanism(&twice.plain), &twice.draft.values);
            let start = plain.solve(0.0, &twice.draft.q())?;
            let name = format!("{name}, seed {seed}: {}", twice.mechanism(&twice.redundant));
            start.is_calm().then_some((name, twice, plain, start))
        })
    })
}

#[test]
fn plans_without_redundant_rows_agree_with_newton() {
    let (mut compared, mut worst) = (0, [0.0_f64; 3]);
    for (name, twice, plain, start) in drawn() {
        let oracle = Oracle::new(&twice.mechanism(&twice.redundant), &twice.draft.values);
        let planned = Planned::new(&oracle);
        let plan = &planned.0;
        let more = oracle.system.set.rows.len() - oracle.system.set.coordinates.len();
        let redundant: usize =
            plan.steps.iter().filter(|s| s.kind == StepKind::RedundantRows).map(|s| s.rows.len()).sum();
        assert!(more > 0 && redundant == more, "{redundant} of {more}: {plan}{name}");
        assert_eq!(planned.newton(), [], "{plan}{name}");
        let modes: Vec<f64> = planned.closures(&oracle, 0.0, &start.q).iter().map(|w| w.signum()).collect();
        for t in [-0.2, -0.1, 0.0, 0.1, 0.2] {
            let Some(expected) = plain.follow(&start, t, 0.025) else { continue };
            let found = planned.run(&oracle, t, &modes, &start.q);
            let least = found.margins.iter().copied().fold(1.0, f64::min);
            // The rows that are kept pass limits of their own, where others take over: the other branch is not one.
            let closures = planned.closures(&oracle, t, &expected.q);
            if closures.iter().zip(&modes).any(|(w, mode)| w * mode < 0.3) {
                let good = least > 0.0 && closures.iter().zip(&modes).all(|(w, mode)| w * mode > 0.0);
                assert!(good || least <= 0.0, "t = {t}: {:?} {plan}{name}", found.margins);
                continue;
            }
            assert!(least > 0.0, "t = {t}: {:?} {plan}{name}", found.margins);
            let pairs = [(&expected.q, &found.q), (&expected.q_dot, &found.q_dot), (&expected.q_ddot, &found.q_ddot)];
            for (worst, (expected, found)) in worst.iter_mut().zip(pairs) {
                let off = difference(expected, found);
                // The rows that are kept are not as well conditioned as all of them.
                assert!(off <= AGREEMENT / least, "t = {t}: off by {off:e}, {:?}\n{plan}{name}", found);
                *worst = worst.max(off * least);
            }
            compared += 1;
        }
    }
    println!("{compared} compared: {worst:?}");
    assert!(compared > 300, "{compared}");
}

#[test]
fn rows_that_contradict_are_seen() {
    let (mut seen, mut least) = (0, f64::INFINITY);
    for (name, twice, _, start) in drawn() {
        let mechanism = twice.mechanism(&twice.redundant);
        for essential in &twice.essential {
            for error in [1e-3, 1e-6, 1e-9] {
                let mut values = twice.draft.values.clone();
                for k in essential.clone() {
                    values[k] += error * values[k].signum() * values[k].abs().max(0.3);
                }
                let oracle = Oracle::new(&mechanism, &values);
                let planned = Planned::new(&oracle);
                let modes: Vec<f64> = planned.closures(&oracle, 0.0, &start.q).iter().map(|w| w.signum()).collect();
                let found = planned.run(&oracle, 0.0, &modes, &start.q);
                let margin = least_of_redundant_rows(&planned.0, &found.margins);
                assert!(!margin.is_nan(), "{:?} {name}", found.margins);
                let missed = TOLERANCE * (1.0 - margin).sqrt();
                assert!(margin < 0.0, "error {error:e} of {essential:?}: {missed:e}\n{}{name}", planned.0);
                least = least.min(missed / error);
                seen += 1;
            }
        }
    }
    println!("{seen} seen, at least by {least:e} of the error");
    assert!(seen > 200, "{seen}");
}
