//! Rates beside a singular configuration that the motion passes: where rounding errors dominate q̇ and q̈, they follow from
//! those at instants farther away.
//!
//! At a distance of δ radians from a crossing of branches, rounding errors are magnified by about 1/δ² in q̇ and 1/δ³ in q̈,
//! but each branch is a smooth curve q(t) through the crossing. So the rates are those of the polynomial through the rates at
//! instants on both sides:
//!
//! ```text
//! f(t) ≈ Σₖ f(t + hₖ) Πⱼ≠ₖ hⱼ/(hⱼ − hₖ)
//! ```

use crate::analysis::acceleration::acceleration;
use crate::analysis::position::position;
use crate::analysis::velocity::velocity;
use crate::equations::Equations;
use crate::error::SolveError;
use crate::signal::{Instant, Signal};

/// Distances of the nearest instants, in radians of the fastest body, which are tried in turn.
const WIDTHS: [f64; 3] = [0.05, 0.02, 0.1];

/// Number of instants on either side.
const PER_SIDE: usize = 4;

/// Largest change of a rate that leaving out the farthest instants may cause, relative to the size of all.
const AGREEMENT: f64 = 1e-8;

/// Largest distance of the polynomial from q itself, relative to the angle at which another branch may be.
const SAME_BRANCH: f64 = 0.01;

/// q, q̇ and q̈ at one instant.
type Motion = [Vec<f64>; 3];

/// q̇ and q̈ of the smooth motion through q at the current instant; `None` where there is none on both sides. `condition` is
/// the condition number of Φ_q.
pub(crate) fn smooth_rates(
    equations: &mut Equations<'_>,
    [q, q_dot]: [&[f64]; 2],
    condition: f64,
) -> Option<[Vec<f64>; 2]> {
    let (t, inputs, scale) = (equations.t, equations.inputs.clone(), equations.scale.clone());
    let rate = scale.turn(q_dot);
    let found = WIDTHS.into_iter().find_map(|width| {
        let h = width / rate;
        let mut samples = Vec::with_capacity(2 * PER_SIDE);
        for side in [h, -h] {
            let (mut from, mut at) = ([q.to_vec(), q_dot.to_vec(), vec![0.0; q.len()]], 0.0);
            for k in 1..=PER_SIDE {
                let next = side * k as f64;
                from = motion_after(equations, (t, &inputs), &from, [at, next]).ok()?;
                at = next;
                samples.push((next, from.clone()));
            }
        }
        equations.scale = scale.clone();
        across(equations, &samples, q, SAME_BRANCH / condition)
    });
    equations.scale = scale;
    equations.set_checked_instant(&Instant { t, inputs: &inputs });
    found
}

/// The motion at the distance `next` from the instant (t, inputs), predicted from that at the distance `at`.
fn motion_after(
    equations: &mut Equations<'_>,
    (t, inputs): (f64, &[Signal]),
    [q, q_dot, q_ddot]: &Motion,
    [at, next]: [f64; 2],
) -> Result<Motion, SolveError> {
    let inputs: Vec<Signal> = inputs.iter().map(|input| input.after(next)).collect();
    equations.set_instant(&Instant { t: t + next, inputs: &inputs })?;
    let h = next - at;
    let rates = q_dot.iter().zip(q_ddot);
    let predicted: Vec<f64> = q.iter().zip(rates).map(|(q, (v, a))| q + h * (v + 0.5 * h * a)).collect();
    let q = position(equations, &predicted)?.q;
    let (q_dot, factor) = velocity(equations, &q, None)?;
    let q_ddot = acceleration(equations, &q, &q_dot, &factor)?;
    Ok([q, q_dot, q_ddot])
}

/// q̇ and q̈ in the middle of motions at several distances, if they are certain and on the branch of q.
fn across(equations: &Equations<'_>, samples: &[(f64, Motion)], q: &[f64], same: f64) -> Option<[Vec<f64>; 2]> {
    // The last instant of either side is left out in the comparison.
    let inner: Vec<&(f64, Motion)> =
        samples.iter().enumerate().filter(|(k, _)| (k + 1) % PER_SIDE != 0).map(|(_, sample)| sample).collect();
    let all: Vec<&(f64, Motion)> = samples.iter().collect();
    let off = |a: &[f64], b: &[f64]| {
        let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
        equations.scale.size(&difference)
    };
    // The comparison is written so that NaN is another branch.
    let is_same = off(&in_the_middle(&all, 0), q) <= same;
    if !is_same {
        return None;
    }
    let [first, second] = [1, 2].map(|order| {
        let found = in_the_middle(&all, order);
        let largest = samples.iter().fold(0.0, |most: f64, (_, motion)| most.max(equations.scale.size(&motion[order])));
        let size = largest.max(equations.scale.size(&samples[0].1[1]).powi(order as i32));
        (off(&found, &in_the_middle(&inner, order)) <= AGREEMENT * size).then_some(found)
    });
    Some([first?, second?])
}

/// The polynomial through q (order 0) or a derivative at several distances, in the middle.
fn in_the_middle(samples: &[&(f64, Motion)], order: usize) -> Vec<f64> {
    let weight = |k: usize| {
        let at = |j: usize| samples[j].0;
        (0..samples.len()).filter(|&j| j != k).map(|j| at(j) / (at(j) - at(k))).product::<f64>()
    };
    let mut sum = vec![0.0; samples[0].1[order].len()];
    for (k, sample) in samples.iter().enumerate() {
        let weight = weight(k);
        sum.iter_mut().zip(&sample.1[order]).for_each(|(sum, value)| *sum += weight * value);
    }
    sum
}
