//! Rolled programs: loops do what straight code does, to the last bit, and as much as straight code does.

mod support;

use kin_core::expr::{ExprId, Graph, Symbol};
use kin_core::joints::RelativeAngle;
use kin_core::mechanism::{Formula, Function, Mechanism};
use kin_core::plan::plan;
use kin_core::program::{Instruction, Piece, Program, Rolled, Slot, Worth, group_atan2, lower, roll};
use kin_core::{assemble, differentiate};
use support::*;

/// Thresholds that accept any repetition.
const ANYTHING: Worth = Worth { members: 2, saved: 1 };

/// Some number for every symbol, and some function for every number.
struct Numbers;

impl Environment for Numbers {
    fn symbol(&self, symbol: Symbol) -> f64 {
        let kind = format!("{:?}", symbol.at(0)).len();
        (f64::from(symbol.index()) * 0.37 + kind as f64).sin() + 1.5
    }
    fn supplied(&self, function: u32, order: u8, argument: f64) -> f64 {
        (argument + f64::from(function)).cos() + f64::from(order)
    }
}

fn bits(mut outputs: Vec<(Slot, f64)>) -> Vec<(Slot, u64)> {
    outputs.sort_by_key(|(slot, _)| *slot);
    outputs.into_iter().map(|(slot, value)| (slot, value.to_bits())).collect()
}

/// `rolled` does exactly what `program` does.
fn same(program: &Program, rolled: &Rolled, environment: &impl Environment) {
    assert_eq!(bits(interpret(program, environment)), bits(interpret_rolled(rolled, environment)), "{program}");
    assert_eq!(program.operations(), rolled.operations());
}

/// Steps as they are written: (in straight code, in loops).
fn written(rolled: &Rolled) -> (usize, usize) {
    rolled.pieces.iter().fold((0, 0), |(straight, looped), piece| match piece {
        Piece::Straight(steps) => (straight + steps.len(), looped),
        Piece::Loop { body, .. } => (straight, looped + body.len()),
    })
}

fn program(mechanism: &Mechanism) -> Program {
    combined(&differentiate(assemble(mechanism).expect("a sound mechanism")).expect("no third derivatives"))
}

/// The chain of four-bars with every member written out, one after the other.
fn chain_written_out(loops: usize) -> Mechanism {
    let len = Some(loops);
    let mut mechanism = Mechanism {
        name: "Chain".into(),
        parameters: parameters(&[("l1", len), ("l2", len), ("l3", len), ("d1", len), ("d2", len), ("omega", None)]),
        ..Mechanism::default()
    };
    for k in 0..loops {
        let one = |part: usize, negative: bool| {
            let length = half(element(part, 0, k as i64));
            on(body(3 * k + part), if negative { neg(length) } else { length }, Formula::ZERO)
        };
        let corner = on(GROUND, element(3, 0, k as i64), element(4, 0, k as i64));
        mechanism.bodies.extend(["crank", "coupler", "rocker"].map(|name| free(&format!("{name}{k}"), None)));
        let name = |joint: &str| format!("{joint}{k}");
        mechanism.joints.extend([
            joint(&name("C"), revolute(origin_of(GROUND), one(0, true))),
            joint(&name("A"), revolute(one(0, false), one(1, true))),
            joint(&name("B"), revolute(one(1, false), one(2, true))),
            joint(&name("D"), revolute(one(2, false), corner)),
            joint(
                &name("turn"),
                match k {
                    0 => driver(phi(body(0)), mul(parameter(5), Formula::Time)),
                    _ => RelativeAngle { a: body(3 * k - 1), b: body(3 * k), value: number(0.1) }.into(),
                },
            ),
        ]);
    }
    mechanism
}

#[test]
fn a_chain_is_as_long_to_write_whatever_its_length() {
    for chain in [chain, chain_written_out] {
        let sizes = [20, 40, 80].map(|loops| {
            let program = program(&chain(loops));
            let rolled = roll(&program, Worth::default()).expect("it repeats");
            same(&program, &rolled, &Numbers);
            assert!(rolled.tables.is_empty(), "{:?}", rolled.tables);
            written(&rolled)
        });
        assert!(sizes.iter().all(|size| *size == sizes[0]), "{sizes:?}");
        // One four-bar has 27 rows of Φ, Φ_t and γ, 29 entries, and 47 operations on 3 pairs.
        assert!(sizes[0].0 + sizes[0].1 < 3 * (27 + 29 + 47 + 3), "{sizes:?}");
    }
}

/// Angles of vectors are brought together in straight code alone: here that would make one loop of three members.
#[test]
fn so_is_the_plan_of_a_chain() {
    for chain in [chain, chain_written_out] {
        let sizes = [20, 40, 80].map(|loops| {
            let system = differentiate(assemble(&chain(loops)).expect("a sound mechanism")).expect("it is smooth");
            let plan = plan(&system);
            let sections = plan.sections.iter().map(|(section, _)| section.program());
            let rolled = sections.map(|program| {
                let rolled = roll(program, Worth::default()).expect("it repeats");
                same(program, &rolled, &Numbers);
                let (straight, looped) = written(&rolled);
                straight + looped
            });
            rolled.sum::<usize>()
        });
        assert!(sizes.iter().all(|size| *size == sizes[0]), "{sizes:?}");
        let one = plan(&differentiate(assemble(&chain(1)).expect("sound")).expect("smooth"));
        let steps = one.sections.iter().map(|(section, _)| section.program());
        let steps: usize = steps.map(|program| program.instructions.len() + program.outputs.len()).sum();
        assert!(sizes[0] < 5 * steps, "{sizes:?} for {steps}");
    }
}

/// Straight code takes the two angles of a dyad at once, and does what it did.
#[test]
fn angles_of_vectors_stand_together_in_straight_code() {
    let system = differentiate(assemble(&chain(1)).expect("a sound mechanism")).expect("it is smooth");
    let plan = plan(&system);
    let program = plan.sections[0].0.program();
    let grouped = group_atan2(program);
    assert_eq!(bits(interpret(program, &Numbers)), bits(interpret(&grouped, &Numbers)));
    assert_eq!(program.operations(), grouped.operations());
    let runs = |program: &Program| {
        let angles: Vec<bool> = program.instructions.iter().map(|i| matches!(i, Instruction::Atan2(..))).collect();
        angles.chunk_by(|a, b| a == b).filter(|run| run[0]).map(<[bool]>::len).collect::<Vec<_>>()
    };
    assert_eq!((runs(program), runs(&grouped)), (vec![1, 1], vec![2]));
}

#[test]
fn all_angles_are_taken_in_one_loop() {
    for chain in [chain, chain_written_out] {
        let program = program(&chain(40));
        let rolled = roll(&program, Worth::default()).expect("it repeats");
        let pairs = |piece: &&Piece| matches!(piece, Piece::Loop { count: 120, body } if body.len() == 1);
        assert_eq!(rolled.pieces.iter().filter(pairs).count(), 1, "{:?}", rolled.pieces);
    }
}

#[test]
fn a_few_members_stay_straight() {
    assert_eq!(roll(&program(&chain(1)), Worth::default()), None);
    assert_eq!(roll(&program(&chain_written_out(3)), Worth::default()), None);
}

#[test]
fn random_mechanisms_with_families() {
    let mut rolled_ones = 0;
    for seed in 0..150 {
        let mechanism = mechanism(seed);
        let Ok(system) = assemble(&mechanism).and_then(differentiate) else { continue };
        let program = combined(&system);
        if let Some(rolled) = roll(&program, ANYTHING) {
            rolled_ones += 1;
            same(&program, &rolled, &Numbers);
        }
    }
    assert!(rolled_ones > 100, "{rolled_ones}");
}

/// Outputs Entry(0), Entry(1), ….
fn entries(graph: &Graph, outputs: Vec<ExprId>) -> Program {
    let outputs: Vec<_> = outputs.into_iter().enumerate().map(|(k, id)| (Slot::Entry(k), id)).collect();
    lower(graph, &outputs)
}

#[test]
fn what_a_member_hands_to_the_next_is_carried() {
    let mut graph = Graph::new();
    let (mut x, mut y) = (graph.symbol(Symbol::Time), graph.symbol(Symbol::Parameter(50)));
    let mut outputs = Vec::new();
    for k in 0..50 {
        // An angle that needs the sine of the one before: nothing can be grouped.
        let length = graph.symbol(Symbol::Parameter(k));
        let angle = graph.add(x, y);
        let [dx, dy] = graph.rotate(angle, [length, y]);
        (x, y) = (graph.add(x, dx), graph.call(Function::Atan, dy));
        outputs.extend([x, y]);
    }
    let program = entries(&graph, outputs);
    let rolled = roll(&program, Worth::default()).expect("it repeats");
    same(&program, &rolled, &Numbers);
    let (straight, looped) = written(&rolled);
    assert!(straight < 30 && looped < 15, "{straight} {looped}");
}

#[test]
fn literals_that_differ_stand_in_tables() {
    let mut graph = Graph::new();
    let outputs = (0..30_u32).map(|k| {
        let (a, b) = (graph.symbol(Symbol::Coordinate(3 * k + 1)), graph.symbol(Symbol::Rate(2 * k)));
        let (own, shared) = (graph.number(2.0 + f64::from(k * k)), graph.number(0.7));
        let (a, b) = (graph.mul(own, a), graph.mul(shared, b));
        graph.add(a, b)
    });
    let outputs = outputs.collect();
    let program = entries(&graph, outputs);
    let rolled = roll(&program, Worth::default()).expect("it repeats");
    same(&program, &rolled, &Numbers);
    assert_eq!((written(&rolled), rolled.tables.len(), rolled.tables[0].len()), ((0, 4), 1, 30));
}

#[test]
fn neighbours_are_read_where_they_stand() {
    let sizes = [42, 84].map(|members| {
        let mut graph = Graph::new();
        // Second differences of sines: member k reads k − 1, k and k + 1.
        let mut sine = |k: u32| {
            let angle = graph.symbol(Symbol::Coordinate(members - 1 - k));
            graph.sin(angle)
        };
        let sines: Vec<ExprId> = (0..members).map(&mut sine).collect();
        let outputs = sines.windows(3).map(|three| {
            let sum = graph.add(three[0], three[2]);
            let twice = graph.double(three[1]);
            graph.sub(sum, twice)
        });
        let outputs = outputs.collect();
        let program = entries(&graph, outputs);
        let rolled = roll(&program, Worth::default()).expect("it repeats");
        same(&program, &rolled, &Numbers);
        written(&rolled)
    });
    assert_eq!(sizes[0], sizes[1]);
    assert_eq!(sizes[0].1, 5, "a pair, three operations and an output");
}

#[test]
fn what_repeats_without_order_stays_straight() {
    let mut graph = Graph::new();
    let outputs = (0..60_u32).map(|k| {
        let a = graph.symbol(Symbol::Coordinate(k * k * 7919 % 61));
        let b = graph.symbol(Symbol::Rate(k * k * k * 31 % 67));
        let square = graph.square(a);
        graph.add(square, b)
    });
    let outputs = outputs.collect();
    assert_eq!(roll(&entries(&graph, outputs), Worth::default()), None);
}

/// Members of a random shape, with members between that are of another, and indices that jump.
#[test]
fn random_members_and_exceptions() {
    let mut rolled_ones = 0;
    for seed in 0..400 {
        let mut random = Random(seed);
        let mut graph = Graph::new();
        let members = 2 + random.below(20);
        let shape = random.next();
        let mut last = vec![graph.symbol(Symbol::Time), graph.number(0.5)];
        let shared = graph.symbol(Symbol::Parameter(0));
        let mut outputs = Vec::new();
        for k in 0..members as u32 {
            let mut own = Random(if random.chance(10) { random.next() } else { shape });
            let jump = if random.chance(5) { 3 } else { 0 };
            let mut values = vec![
                graph.symbol(Symbol::Coordinate(3 * k + jump)),
                graph.symbol(Symbol::Parameter(100 - 2 * k)),
                graph.number(f64::from(k) + 0.25),
                shared,
            ];
            values.extend(last.iter().rev().take(4));
            for _ in 0..3 + own.below(12) {
                let (a, b) = (values[own.below(values.len())], values[own.below(values.len())]);
                values.push(match own.below(8) {
                    0 | 1 => graph.add(a, b),
                    2 => graph.sub(a, b),
                    3 | 4 => graph.mul(a, b),
                    5 => graph.sin(a),
                    6 => graph.rotate(a, [b, shared])[0],
                    _ => graph.supplied(1, own.below(3) as u8, a),
                });
            }
            for _ in 0..1 + own.below(3) {
                outputs.push(values[values.len() - 1 - own.below(3)]);
            }
            last = values;
        }
        let program = entries(&graph, outputs);
        for worth in [ANYTHING, Worth::default()] {
            if let Some(rolled) = roll(&program, worth) {
                rolled_ones += 1;
                same(&program, &rolled, &Numbers);
            }
        }
    }
    assert!(rolled_ones > 300, "{rolled_ones}");
}
