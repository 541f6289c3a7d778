//! Terms of a sum that wait for a sine or a cosine come last, and the value stays the same.

mod support;

use kin_core::expr::{ExprId, Graph, Symbol};
use kin_core::program::{Slot, lower};
use support::*;

/// The operations of a program of one row.
fn operations(graph: &Graph, row: ExprId) -> Vec<String> {
    let program = lower(graph, &[(Slot::Phi(0), row)]).to_string();
    program.lines().filter(|line| [" + ", " - "].iter().any(|sign| line.contains(sign))).map(str::to_owned).collect()
}

#[test]
fn what_waits_for_a_function_comes_last() {
    let mut graph = Graph::new();
    let [x, y, z, phi] = [0, 1, 3, 2].map(|k| graph.symbol(Symbol::Coordinate(k)));
    let (cos, sin) = (graph.cos(phi), graph.sin(phi));
    // (x + cos φ) − (y − sin φ) + z.
    let (left, right) = (graph.add(x, cos), graph.sub(y, sin));
    let difference = graph.sub(left, right);
    let row = graph.add(difference, z);
    let found = operations(&graph, row);
    assert_eq!(found.len(), 4, "{found:?}");
    // The first two hold x, y and z alone, and so nothing that any later one makes.
    assert!(found[..2].iter().all(|line| !line.contains("sin") && !line.contains("cos")), "{found:?}");
    let value = interpreted(&graph, row);
    assert!((value - (0.5 + 0.3_f64.cos() - (0.25 - 0.3_f64.sin()) + 0.125)).abs() < 1e-15, "{value}");
}

#[test]
fn parts_that_are_used_twice_stay() {
    let mut graph = Graph::new();
    let [x, y, phi] = [0, 1, 2].map(|k| graph.symbol(Symbol::Coordinate(k)));
    let cos = graph.cos(phi);
    let part = graph.add(x, cos);
    let difference = graph.sub(part, y);
    let square = graph.mul(part, part);
    let row = graph.add(difference, square);
    let found = operations(&graph, row);
    assert_eq!(found.len(), 3, "{found:?}");
    let value = interpreted(&graph, row);
    let part = 0.5 + 0.3_f64.cos();
    assert!((value - (part - 0.25 + part * part)).abs() < 1e-15, "{value}");
}

/// At x = 0.5, y = 0.25, φ = 0.3, z = 0.125.
fn interpreted(graph: &Graph, row: ExprId) -> f64 {
    let places = [0.5, 0.25, 0.3, 0.125];
    let value = |symbol| if let Symbol::Coordinate(k) = symbol { places[k as usize] } else { f64::NAN };
    interpret(&lower(graph, &[(Slot::Phi(0), row)]), &value)[0].1
}
