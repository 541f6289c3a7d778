//! Tests of single states.

use crate::case::{Answer, Expected, Refusal};
use crate::jet::Jet;
use crate::moving::{AnyGroup, Moving};
use kin_runtime::{Instant, SolveError};

/// The expected states for single states. The direction of a motion at a crossing is not known for a single state, so
/// that the allowed errors grow near a crossing.
pub(crate) fn alone(
    (jets, mut allowed): (Vec<Jet>, Vec<[f64; 3]>),
    t: f64,
    crossings: &[f64],
) -> (Vec<Jet>, Vec<[f64; 3]>) {
    let distance = crossings.iter().map(|place| (place - t).abs()).fold(1.0, f64::min);
    for allowed in &mut allowed {
        (0..3).for_each(|order| allowed[order] += 1e-14 / distance.powi(order as i32 + 1));
    }
    (jets, allowed)
}

/// Solves single states from the expected ones: at the start, and at the instants nearest to a fold or a crossing.
pub(crate) fn states(
    group: &AnyGroup<'_>,
    mechanism: &dyn Moving,
    known: &[Expected],
    places: &[f64],
) -> (Vec<usize>, Answer) {
    let distance = |k: usize| places.iter().map(|place| (place - group.times[k]).abs()).fold(f64::INFINITY, f64::min);
    let mut near: Vec<usize> = (1..group.times.len()).filter(|k| known[*k].is_some()).collect();
    near.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    near.truncate(if known.len() < 12 { 9 } else { 2 });
    // The nearest instant comes last, because the solver may refuse it.
    near.push(0);
    near.reverse();
    let mut answer = Answer { states: Vec::new(), refusal: None };
    for &k in &near {
        let Some((jets, _)) = &known[k] else { continue };
        let (t, start) = (group.times[k], jets.iter().map(|jet| jet.x).collect::<Vec<_>>());
        let inputs = group.told(mechanism.model(), t);
        match mechanism.state_from(&Instant { t, inputs: &inputs }, &start) {
            Ok(state) => answer.states.push([state.q, state.q_dot, state.q_ddot]),
            Err(error) => {
                let words = error.to_string();
                answer.refusal =
                    Some(Refusal { t: Some(t), typed: !matches!(error, SolveError::NonFinite { .. }), words });
                break;
            }
        }
    }
    (near, answer)
}
