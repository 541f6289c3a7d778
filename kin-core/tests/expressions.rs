//! Laws of the expression engine, over random expressions of every kind of node.
//!
//! Every comparison is relative, 1e-10, plus what rounding may do to the formula at hand (see [`Bounded`]); where
//! that is unbounded (an operand at a jump or at the edge of a domain) nothing is compared.

mod support;

use kin_core::expr::{Depends, ExprId, Graph, Jet, Shown, Symbol, total_derivatives};
use kin_core::program::{Instruction, Program, Slot, lower};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::collections::HashSet;
use support::*;

/// Runs `law` on as many random expressions and values, always the same ones.
fn for_all<S: Strategy>(cases: u32, strategy: S, law: impl Fn(S::Value) -> Result<(), TestCaseError>) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 4096, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    if let Err(error) = TestRunner::new_with_rng(config, rng).run(&strategy, law) {
        panic!("{error}");
    }
}

fn agree(what: &str, expected: Bounded, found: f64) -> Result<(), TestCaseError> {
    prop_assert!(expected.agrees(found), "{what}: expected {expected:?}, found {found}");
    Ok(())
}

fn text(graph: &Graph, id: ExprId) -> String {
    Shown { graph, names: &(), id }.to_string()
}

fn built(tree: &Tree, simplify: bool, graph: &mut Graph) -> ExprId {
    if simplify { tree.build(graph) } else { tree.plain(graph) }
}

#[test]
fn simplified_equals_unsimplified() {
    for_all(1200, (trees(), values()), |(tree, values)| {
        let (mut plain, mut simplified) = (Graph::new(), Graph::new());
        let (a, b) = (tree.plain(&mut plain), tree.build(&mut simplified));
        let Some(expected) = bounded(&plain, a, values.plain()) else { return Ok(()) };
        let found = evaluate(&simplified, &[b], &values)[0];
        prop_assert!(found.is_finite(), "{} became {}", text(&plain, a), text(&simplified, b));
        agree(&text(&simplified, b), expected, found)
    });
}

#[test]
fn the_evaluator_follows_the_definitions_of_the_nodes() {
    for_all(400, (trees(), values()), |(tree, values)| {
        let mut graph = Graph::new();
        let id = tree.plain(&mut graph);
        match bounded(&graph, id, values.plain()) {
            Some(expected) => agree("value", expected, evaluate(&graph, &[id], &values)[0]),
            None => Ok(()),
        }
    });
}

/// The parts of a jet with their names.
fn parts(jet: &Jet) -> Vec<(String, ExprId)> {
    let gradient = jet.gradient.iter().map(|(k, e)| (format!("∂/∂q{k}"), *e));
    gradient.chain([("∂/∂t".into(), jet.partial_t), ("rate".into(), jet.rate), ("rest".into(), jet.rest)]).collect()
}

/// Derivatives of the simplified expression against dual numbers through the unsimplified expression.
fn derivatives_equal_dual_numbers((tree, values): (Tree, Values)) -> Result<(), TestCaseError> {
    let (mut plain, mut graph) = (Graph::new(), Graph::new());
    let (a, b) = (tree.plain(&mut plain), tree.build(&mut graph));
    if bounded(&plain, a, values.plain()).is_none() {
        return Ok(());
    }
    let jet = total_derivatives(&mut graph, &[b]).remove(0);
    prop_assert!(jet.gradient.windows(2).all(|pair| pair[0].0 < pair[1].0), "columns in order");
    prop_assert!(jet.gradient.iter().all(|(_, e)| !graph.is_zero(*e)), "no entry that is zero");
    for part in [jet.partial_t].into_iter().chain(jet.gradient.iter().map(|(_, e)| *e)) {
        prop_assert!(!graph.depends(part).on(Depends::RATE), "Φ_q and Φ_t hold no rates");
    }
    let zero = graph.zero();
    let everything = plain.reachable([a]);
    let motions = evaluate_over(&plain, &everything, values.motion());
    let motion = motions[everything.iter().position(|id| *id == a).expect("the root is reached")];
    // Dual numbers round too, in every part on the way.
    let largest = motions.iter().flat_map(|m| [m.re, m.v1, m.v2]).fold(0.0_f64, |most, part| most.max(part.abs()));
    let compare =
        |what: &str, id: ExprId, dual: f64| match bounded(&graph, id, values.plain()).filter(|_| dual.is_finite()) {
            Some(found) => {
                let expected = Bounded { error: found.error + f64::EPSILON * largest, ..found };
                agree(&format!("{what} of {}", text(&plain, a)), expected, dual)
            }
            None => Ok(()),
        };
    compare("rate", jet.rate, motion.v1)?;
    compare("rest", jet.rest, motion.v2)?;
    compare("∂/∂t", jet.partial_t, evaluate_over(&plain, &[a], values.along_time())[0].eps)?;
    for k in 0..COORDINATES {
        let entry = jet.gradient.iter().find(|(column, _)| *column == k).map_or(zero, |(_, e)| *e);
        compare(&format!("∂/∂q{k}"), entry, evaluate_over(&plain, &[a], values.along(k))[0].eps)?;
    }
    Ok(())
}

#[test]
fn derivatives_of_simplified_expressions_equal_dual_numbers() {
    for_all(1000, (trees(), values()), derivatives_equal_dual_numbers);
}

#[test]
fn the_rest_is_minus_gamma_by_its_definition() {
    for_all(300, (trees(), values()), |(tree, values)| {
        let mut graph = Graph::new();
        let id = tree.build(&mut graph);
        let jet = total_derivatives(&mut graph, &[id]).remove(0);
        let gamma = gamma(&mut graph, id, COORDINATES, INPUTS);
        let rest = graph.neg(jet.rest);
        let phi_t = partial_t(&mut graph, id, INPUTS);
        let mut pairs = vec![("γ", gamma, rest), ("Φ_t", phi_t, jet.partial_t)];
        for (k, entry) in &jet.gradient {
            pairs.push(("Φ_q", partial(&mut graph, id, Symbol::Coordinate(*k)), *entry));
        }
        for (what, expected, found) in pairs {
            let value = |id: ExprId| bounded(&graph, id, values.plain());
            if let (Some(expected), Some(found)) = (value(expected), value(found)) {
                let error = expected.error + found.error;
                agree(&format!("{what} of {}", text(&graph, id)), Bounded { error, ..expected }, found.value)?;
            }
        }
        Ok(())
    });
}

/// What every program must be, whatever it computes.
fn is_well_formed(program: &Program) -> Result<(), TestCaseError> {
    let mut seen = HashSet::new();
    let mut used = vec![false; program.instructions.len()];
    for (place, instruction) in program.instructions.iter().enumerate() {
        prop_assert!(seen.insert(*instruction), "v{place} is computed twice:\n{program}");
        let mut operands = Vec::new();
        instruction.for_each_operand(|operand| operands.push(operand.index()));
        for operand in operands {
            prop_assert!(operand < place, "v{place} comes before its operand:\n{program}");
            used[operand] = true;
            let is_pair = matches!(program.instructions[operand], Instruction::SinCos(_));
            let takes_pair = matches!(instruction, Instruction::SinOf(_) | Instruction::CosOf(_));
            prop_assert_eq!(is_pair, takes_pair);
            let is_triple = matches!(program.instructions[operand], Instruction::Supplied(..));
            let takes_triple = matches!(instruction, Instruction::SuppliedOf(..));
            prop_assert_eq!(is_triple, takes_triple);
        }
        match instruction {
            Instruction::SinCos(angle) => {
                let opposite = match program.instructions[angle.index()] {
                    Instruction::Neg(a) => Some(a),
                    _ => None,
                };
                let twice = |a| program.instructions.contains(&Instruction::SinCos(a));
                prop_assert!(!opposite.is_some_and(twice), "sin and cos of an angle and its opposite:\n{program}");
            }
            Instruction::Number(value) => prop_assert!(value.value().is_finite()),
            _ => {}
        }
    }
    program.outputs.iter().for_each(|(_, value)| used[value.index()] = true);
    prop_assert!(used.iter().all(|used| *used), "something is computed for nothing:\n{program}");
    // The sines and cosines that can be taken together stand together.
    let mut depth = vec![0; program.instructions.len()];
    for (place, instruction) in program.instructions.iter().enumerate() {
        instruction.for_each_operand(|operand| {
            let is_pair = matches!(program.instructions[operand.index()], Instruction::SinCos(_));
            depth[place] = depth[place].max(depth[operand.index()] + usize::from(is_pair));
        });
    }
    let of_pairs = || (program.instructions.iter().enumerate()).filter(|(_, i)| matches!(i, Instruction::SinCos(_)));
    for ((a, _), (b, _)) in of_pairs().zip(of_pairs().skip(1)) {
        prop_assert!(depth[a] < depth[b] || b == a + 1, "sines and cosines stand together:\n{program}");
    }
    Ok(())
}

#[test]
fn programs_equal_the_evaluator() {
    let case = (proptest::collection::vec(trees(), 1..4), values(), any::<bool>());
    for_all(400, case, |(trees, values, simplify)| {
        let mut graph = Graph::new();
        let mut roots: Vec<ExprId> = trees.iter().map(|tree| built(tree, simplify, &mut graph)).collect();
        for (_, part) in total_derivatives(&mut graph, &roots).iter().flat_map(parts) {
            roots.push(part);
        }
        let again = roots[0];
        roots.push(again);
        let outputs: Vec<(Slot, ExprId)> =
            roots.iter().enumerate().map(|(k, id)| (Slot::Entry(roots.len() - k), *id)).collect();
        let program = lower(&graph, &outputs);
        is_well_formed(&program)?;
        let found = interpret(&program, &values);
        prop_assert_eq!(found.len(), outputs.len());
        for ((slot, id), (found_slot, found)) in outputs.iter().zip(found) {
            prop_assert_eq!(*slot, found_slot, "outputs keep their order");
            if let Some(expected) = bounded(&graph, *id, values.plain()) {
                agree(&text(&graph, *id), expected, found)?;
            }
        }
        Ok(())
    });
}

/// The value of a printed name.
fn named(name: &str, values: &Values) -> f64 {
    if name == "t" {
        return values.t;
    }
    let (stem, order) = match name.strip_suffix("_ddot") {
        Some(stem) => (stem, 2),
        None => name.strip_suffix("_dot").map_or((name, 0), |stem| (stem, 1)),
    };
    let k: usize = stem[1..].parse().expect("a numbered name");
    match (&stem[..1], order) {
        ("p", 0) => values.parameters[k],
        ("u", order) => values.inputs[k][order],
        ("q", 0) => values.q[k],
        ("q", 1) => values.q_dot[k],
        _ => panic!("no name `{name}`"),
    }
}

#[test]
fn printed_expressions_mean_what_they_say() {
    for_all(800, (trees(), values(), any::<bool>(), any::<bool>()), |(tree, values, simplify, derive)| {
        let mut graph = Graph::new();
        let mut id = built(&tree, simplify, &mut graph);
        if derive {
            id = total_derivatives(&mut graph, &[id])[0].rate;
        }
        let Some(expected) = bounded(&graph, id, values.plain()) else { return Ok(()) };
        let shown = text(&graph, id);
        let read = read(&shown, &|name| Bounded::real(named(name, &values)));
        agree(&shown, expected, read.value)
    });
}
