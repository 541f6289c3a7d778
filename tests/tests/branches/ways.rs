//! All methods by which kin follows a motion; they must give the same branch.

use crate::alone::{alone, states};
use crate::case::{Answer, Expected, Group, Refusal, Sampled, expected, judge};
use crate::moving::{AnyGroup, Moving};
use crate::side_by_side::in_a_batch;
use crate::tally::Tally;
use kin_runtime::model::Model;
use kin_runtime::{Degeneracy, Instant, Kinematics, Options, PlanError, SolveError};
use kin_tests::compare::largest;
use std::fmt::Debug;

/// The names of the methods, in the order of their counts.
pub(crate) const WAYS: [&str; 6] = ["sweep", "without plan", "tracker", "planned", "batch", "states"];

fn refusal(error: &SolveError) -> Refusal {
    let t = match error {
        SolveError::Singular { t, .. }
        | SolveError::StepRefused { t, .. }
        // Branches cross where a curve has a double point.
        | SolveError::DegenerateContact { t, what: Degeneracy::Gradient { .. }, .. } => Some(*t),
        _ => None,
    };
    let typed = t.is_some() || matches!(error, SolveError::NotAssembled { .. });
    Refusal { t, typed, words: error.to_string() }
}

/// Follows the motions of a group by every method, and counts the verdicts.
pub(crate) fn follow<M: Kinematics + Sync + Debug>(tally: &mut Tally, group: &Group<M>) {
    follow_any(tally, &AnyGroup::new(group), M::model());
}

fn follow_any(tally: &mut Tally, group: &AnyGroup<'_>, model: &Model) {
    let AnyGroup { times, cases, .. } = group;
    let has_plan = model.plan.exists();
    let mut batch = if has_plan { in_a_batch(group) } else { Vec::new() };
    batch.reverse();
    for case in cases {
        let known = expected(&case.branch, &case.folds, times);
        let mechanism = &case.mechanism;
        let Some((jets, _)) = &known[0] else { panic!("{mechanism:?} does not close at the start") };
        closes(group, mechanism, &known);
        let start: Vec<f64> = jets.iter().map(|jet| jet.x).collect();
        let places = [case.folds.as_slice(), &case.crossings].concat();
        let mut count = |way: usize, times: &[f64], known: &[Expected], places: &[f64], answer: &Answer| {
            let (verdict, words) = judge(places, times, known, answer);
            tally.count(way, verdict, || {
                format!("{words}\n    {mechanism:?} {}\n    times {times:?}\n    from {start:?}", case.note)
            });
        };
        count(0, times, &known, &places, &swept(group, mechanism, &start, true));
        count(1, times, &known, &places, &swept(group, mechanism, &start, false));
        let (near, answer) = states(group, mechanism, &known, &places);
        let here: Vec<f64> = near.iter().map(|&k| times[k]).collect();
        let known_here: Vec<Expected> =
            near.iter().map(|&k| known[k].clone().map(|known| alone(known, times[k], &case.crossings))).collect();
        count(5, &here, &known_here, &places, &answer);
        let batch = batch.pop();
        let (known, places) = match &case.sampled {
            Sampled::AsWell => (known, places),
            Sampled::As { branch, places } => (expected(branch, &[], times), places.clone()),
            Sampled::Unknown => continue,
        };
        count(2, times, &known, &places, &tracked(group, mechanism, &start));
        if let Some(batch) = batch {
            let places = [places, case.plan_ends.clone()].concat();
            count(3, times, &known, &places, &planned(group, mechanism, &start));
            count(4, times, &known, &places, &batch);
        }
    }
}

/// Asserts that the expected states satisfy the equations of the mechanism: Φ = 0, and Φ_q q̇ + Φ_t = 0 where this can
/// be checked.
fn closes(group: &AnyGroup<'_>, mechanism: &dyn Moving, known: &[Expected]) {
    for (t, known) in group.times.iter().zip(known) {
        let Some((jets, allowed)) = known else { continue };
        let (inputs, q) = (group.told(mechanism.model(), *t), jets.iter().map(|jet| jet.x).collect::<Vec<_>>());
        let at = Instant { t: *t, inputs: &inputs };
        let Ok([phi, jacobian, mut rates]) = mechanism.equations(&at, &q) else {
            panic!("{mechanism:?}: so many coordinates has it not")
        };
        assert!(largest(&phi) < 1e-12, "{mechanism:?} does not close at t = {t:?}: {q:?}");
        for (&(row, column), entry) in mechanism.model().constraint_pattern.entries.iter().zip(&jacobian) {
            rates[row] += entry * jets[column].v;
        }
        let loose = allowed.iter().fold(1e-9, |most: f64, allowed| most.max(allowed[1]));
        assert!(largest(&rates) < loose, "{mechanism:?} does not move like this at t = {t:?}: {rates:?}");
    }
}

fn swept(group: &AnyGroup<'_>, mechanism: &dyn Moving, start: &[f64], use_plan: bool) -> Answer {
    let options = Options { use_plan, ..Options::default() };
    let (trajectory, refusal) = match mechanism.sweep_from(options, group.inputs, start, group.times) {
        Ok(trajectory) => (trajectory, None),
        Err(error) => (*error.trajectory, Some(refusal(&error.source))),
    };
    let states = trajectory.states.into_iter().map(|state| [state.q, state.q_dot, state.q_ddot]).collect();
    Answer { states, refusal }
}

fn tracked(group: &AnyGroup<'_>, mechanism: &dyn Moving, start: &[f64]) -> Answer {
    let model = mechanism.model();
    let mut answer = Answer { states: Vec::new(), refusal: None };
    let first = group.told(model, group.times[0]);
    let mut tracker = match mechanism.tracker_from(&Instant { t: group.times[0], inputs: &first }, start) {
        Ok(tracker) => tracker,
        Err(error) => return Answer { refusal: Some(refusal(&error)), ..answer },
    };
    for &t in group.times {
        match tracker.update(&Instant { t, inputs: &group.told(model, t) }) {
            Ok(state) => answer.states.push([&state.q, &state.q_dot, &state.q_ddot].map(Clone::clone)),
            Err(error) => {
                let found = refusal(&error);
                // Between instants the inputs follow the tracker's own course, so that the time of the limit cannot be
                // compared.
                let t = found.t.filter(|_| model.inputs.is_empty());
                return Answer { refusal: Some(Refusal { t, ..found }), ..answer };
            }
        }
    }
    answer
}

fn planned(group: &AnyGroup<'_>, mechanism: &dyn Moving, start: &[f64]) -> Answer {
    let model = mechanism.model();
    let mut answer = Answer { states: Vec::new(), refusal: None };
    let refusal = |error: PlanError| {
        let words = error.to_string();
        let typed = error.limit().is_some() || matches!(error, PlanError::Undecided { .. });
        // The error only says which instant cannot be reached.
        Some(Refusal { t: None, typed, words })
    };
    let first = group.told(model, group.times[0]);
    let mut planned = match mechanism.planned(&Instant { t: group.times[0], inputs: &first }, start) {
        Ok(planned) => planned,
        Err(error) => return Answer { refusal: refusal(error), ..answer },
    };
    for &t in group.times {
        match planned.at(&Instant { t, inputs: &group.told(model, t) }) {
            Ok(found) => answer.states.push(found),
            Err(error) => return Answer { refusal: refusal(error), ..answer },
        }
    }
    answer
}
