//! An independent test of the structural analysis: the numerical rank of Φ_q at assembled poses.
//!
//! For every mechanism of the corpus, each point of a body gets its own parameters; pose and parameters are drawn at
//! random and then changed until all rows except the driving ones are satisfied. Such a mechanism has no special
//! lengths, so that its floating-point rank is the generic rank. With the parameters as written the rank can only be
//! smaller.

use super::{Case, all, diagnosed};
use crate::oracle::evaluate;
use kin_core::KinematicSystem;
use kin_core::expr::{ExprId, Symbol};
use std::collections::BTreeMap;

/// A generator of pseudo-random numbers in (−1, 1) with a fixed seed.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The attributes with two new parameters for every distinct point of a body except its origin.
fn freed(case: &Case) -> (Vec<String>, String) {
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    let free = |attribute: &str, names: &mut BTreeMap<String, usize>| {
        let mut parts = attribute.split("@ (");
        let mut out = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let body = out.trim_end().rsplit([' ', '(']).next().unwrap_or_default();
            let body = body.split('[').next().unwrap_or_default().to_owned();
            let mut depth = 1;
            let end = part.find(|c| {
                depth += i32::from(c == '(') - i32::from(c == ')');
                depth == 0
            });
            let (point, rest) = part.split_at(end.unwrap_or(part.len()));
            if point == "0, 0" {
                out += &format!("@ (0, 0{rest}");
            } else {
                let count = names.len();
                let k = *names.entry(format!("{body} @ {point}")).or_insert(count);
                out += &format!("@ (free_x{k}, free_y{k}{rest}");
            }
        }
        out
    };
    let attributes = case.attributes().into_iter().map(|attribute| free(attribute, &mut names)).collect();
    let own = (0..names.len()).map(|k| format!(" free_x{k} free_y{k}")).collect::<String>();
    (attributes, case.parameters.to_owned() + &own)
}

/// The values of expressions, where `z` contains the coordinates followed by the parameters.
fn values(system: &KinematicSystem, roots: &[ExprId], z: &[f64]) -> Vec<f64> {
    let n = system.set.coordinates.len();
    evaluate(&system.set.graph, roots, &|symbol| match symbol {
        Symbol::Coordinate(k) => z[k as usize],
        Symbol::Parameter(k) => z[n + k as usize],
        _ => 0.3,
    })
}

/// Solves a square system by elimination with row pivoting; unknowns with a vanishing pivot are skipped.
fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap_or(k);
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            let row = a[k].clone();
            a[i].iter_mut().zip(row).skip(k).for_each(|(x, y)| *x -= factor * y);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let rest: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / a[k][k];
    }
    b
}

/// Moves z to a root of the rows: Gauss–Newton with steps of least norm and slight damping.
fn close(system: &KinematicSystem, rows: &[ExprId], z: &mut [f64]) -> bool {
    const STEP: f64 = 1e-6;
    for _ in 0..60 {
        let phi = values(system, rows, z);
        if phi.iter().all(|value| value.abs() < 1e-11) {
            return true;
        }
        let columns: Vec<Vec<f64>> = (0..z.len())
            .map(|k| {
                let mut side = |step: f64| {
                    z[k] += step;
                    let found = values(system, rows, z);
                    z[k] -= step;
                    found
                };
                let (above, below) = (side(STEP), side(-STEP));
                above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
            })
            .collect();
        let entry = |i: usize, j: usize| columns.iter().map(|column| column[i] * column[j]).sum::<f64>();
        let normal = (0..rows.len())
            .map(|i| (0..rows.len()).map(|j| entry(i, j) + if i == j { 1e-9 } else { 0.0 }).collect())
            .collect();
        let weights = solved(normal, phi);
        for (x, column) in z.iter_mut().zip(&columns) {
            *x -= column.iter().zip(&weights).map(|(a, w)| a * w).sum::<f64>().clamp(-0.5, 0.5);
        }
    }
    false
}

/// The rank by elimination with full pivoting, where rows are scaled to length 1.
fn rank(mut a: Vec<Vec<f64>>) -> usize {
    a.iter_mut().for_each(|row| {
        let norm = row.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
        row.iter_mut().for_each(|x| *x /= norm);
    });
    let columns = a.first().map_or(0, Vec::len);
    let mut rank = 0;
    while rank < a.len() {
        let places = (rank..a.len()).flat_map(|i| (0..columns).map(move |j| (i, j)));
        let Some((i, j)) = places.max_by(|p, q| a[p.0][p.1].abs().total_cmp(&a[q.0][q.1].abs())) else { break };
        if a[i][j].abs() < 1e-7 {
            break;
        }
        a.swap(rank, i);
        let pivot = a[rank].clone();
        for row in &mut a[rank + 1..] {
            let factor = row[j] / pivot[j];
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= factor * y);
            row[j] = 0.0;
        }
        rank += 1;
    }
    rank
}

/// The largest rank at assembled poses of several random draws, and the number of draws that could be assembled.
///
/// The iteration may end where links have shrunk to length zero, so that one pose only gives a lower bound of the rank.
/// While the rank is below `expected`, more draws are made.
fn largest_rank(system: &KinematicSystem, seed: u64, expected: usize) -> (usize, usize) {
    let set = &system.set;
    let passive = (0..set.rows.len()).filter(|&row| !system.classes[row].driving && system.classes[row].holonomic);
    let rows: Vec<ExprId> = passive.map(|row| set.rows[row].phi).collect();
    let (mut best, mut closed) = (0, 0);
    for draw in 0..16 {
        if draw >= 4 && (closed == 0 || best >= expected) {
            break;
        }
        let mut dice = Dice(seed + 1000 * draw);
        let count = set.coordinates.len() + set.parameters.len();
        let mut z: Vec<f64> = (0..count).map(|k| 0.4 + dice.next() + 0.01 * (k % 7) as f64).collect();
        if !close(system, &rows, &mut z) {
            continue;
        }
        closed += 1;
        let matrix = system.equations.iter().map(|equation| {
            let roots: Vec<ExprId> = equation.phi_q.iter().map(|(_, e)| *e).collect();
            let mut row = vec![0.0; set.coordinates.len()];
            let found = values(system, &roots, &z);
            equation.phi_q.iter().zip(found).for_each(|((k, _), value)| row[*k as usize] = value);
            row
        });
        best = best.max(rank(matrix.collect()));
    }
    (best, closed)
}

#[test]
fn free_lengths_have_the_generic_rank() {
    let mut closed_at_all = 0;
    for (seed, case) in (1..).zip(all()) {
        let (attributes, parameters) = freed(case);
        let own = Case { parameters: Box::leak(parameters.into_boxed_str()), ..*case };
        let attributes: Vec<&str> = attributes.iter().map(String::as_str).collect();
        let free = diagnosed(own.source(&attributes));
        assert_eq!(free.counts(), case.counts, "{} with free lengths", case.name);
        let (best, closed) = largest_rank(&free.system, seed, case.counts[2]);
        if closed > 0 {
            assert_eq!(best, case.counts[2], "{} with free lengths, closed {closed} times", case.name);
            closed_at_all += 1;
        } else {
            println!("does not close with free lengths: {}", case.name);
        }
        // The lengths as written may be special, so that the rank is smaller; it is never larger.
        let written = diagnosed(case.source(&case.attributes()));
        let (best, _) = largest_rank(&written.system, seed, 0);
        assert!(best <= case.counts[2], "{}: {best}", case.name);
    }
    assert!(closed_at_all + 5 > all().count(), "{closed_at_all} of {}", all().count());
}
