//! The designs that papers print for the published problems: the error of each of them, and the message about those
//! that do not assemble.

use crate::published::{FourBar, mode, rows};
use kin_runtime::{Kinematics, Sign, SolveError};
use std::f64::consts::PI;

/// A row of the table: the problem, who printed it, its mode, the sum of squares, poses that do not assemble, variables.
struct Printed {
    problem: usize,
    label: String,
    sign: Sign,
    error: Option<f64>,
    unassembled: usize,
    variables: Vec<f64>,
}

fn all() -> Vec<Printed> {
    let path = format!("{}/data/synthesis/published.csv", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        Printed {
            problem: cells[0].parse().unwrap(),
            label: cells[1].to_owned(),
            // The papers' mode + has the pin of coupler and rocker to the right of the line that the plan names.
            sign: if cells[2] == "+" { Sign::Minus } else { Sign::Plus },
            error: cells[3].parse().ok(),
            unassembled: cells[5].parse().unwrap(),
            variables: cells[9..].iter().filter(|cell| !cell.is_empty()).map(|cell| cell.parse().unwrap()).collect(),
        }
    };
    text.lines().skip(1).map(row).collect()
}

/// The instants and places of the targets of a printed design.
fn targets(printed: &Printed) -> Vec<(f64, [f64; 2])> {
    let given = rows(printed.problem);
    let v = &printed.variables;
    let instant = |k: usize| match printed.problem {
        1 | 5 => v[9 + k],
        3 => v[9] + k as f64 * PI / 9.0,
        _ => given[k][2],
    };
    (0..given.len()).map(|k| (instant(k), [given[k][0], given[k][1]])).collect()
}

#[test]
fn printed_designs_are_worth_what_they_are() {
    let (mut assembled, mut ghosts) = (0, 0);
    for printed in all() {
        let v = |k: usize| printed.variables.get(k).copied().unwrap_or(0.0);
        let four_bar = FourBar {
            r1: v(0),
            r2: v(1),
            r3: v(2),
            r4: v(3),
            rcx: v(4),
            rcy: v(5),
            x0: v(6),
            y0: v(7),
            theta0: v(8),
            start: 0.0,
        };
        let solver = four_bar.solver().with_mode(mode::<FourBar>(), printed.sign);
        let (mut error, mut unassembled) = (0.0, 0);
        for (t, [x, y]) in targets(&printed) {
            match solver.state(&t.into()) {
                Ok(state) => {
                    let [px, py] = state[FourBar::P].r;
                    error += (px - x).powi(2) + (py - y).powi(2);
                }
                Err(SolveError::ModeNotAssembled { .. }) => unassembled += 1,
                Err(other) => panic!("{} of problem {}: {other}", printed.label, printed.problem),
            }
        }
        let name = format!("{} of problem {}", printed.label, printed.problem);
        assert_eq!(printed.unassembled, unassembled, "{name}");
        if let Some(exact) = printed.error {
            // Variables have twelve digits in the table, those of several tens an error of some 1e-10.
            let rounding = 1e-6 * exact + 1e-9 * exact.sqrt();
            assert!((error - exact).abs() <= rounding, "{name}: {error:e} instead of {exact:e}");
            assembled += 1;
        } else {
            ghosts += 1;
        }
    }
    assert_eq!((47, 2), (assembled, ghosts));
}
