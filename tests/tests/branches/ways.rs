//! All methods by which kin follows a motion; they must give the same branch.

use crate::alone::{alone, states};
use crate::case::{Answer, Expected, Group, Refusal, Sampled, expected, judge};
use crate::side_by_side::in_a_batch;
use crate::tally::Tally;
use kin_runtime::{Degeneracy, Instant, Kinematics, Options, PlanError, Planned, Signal, SolveError};
use kin_tests::compare::largest;
use std::fmt::Debug;

/// The names of the methods, in the order of their counts.
pub(crate) const WAYS: [&str; 6] = ["sweep", "without plan", "tracker", "planned", "batch", "states"];

/// The inputs at an instant.
pub(crate) fn told<M: Kinematics>(group: &Group<M>, t: f64) -> Vec<Signal> {
    let mut inputs = vec![Signal::default(); M::INPUTS];
    (group.inputs)(t, &mut inputs);
    inputs
}

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
    let Group { times, cases, .. } = group;
    let has_plan = M::model().plan.exists();
    let mut batch = if has_plan { in_a_batch(group) } else { Vec::new() };
    batch.reverse();
    for case in cases {
        let known = expected(&case.branch, &case.folds, times);
        let Some((jets, _)) = &known[0] else { panic!("{:?} does not close at the start", case.mechanism) };
        closes(group, &case.mechanism, &known);
        let start: Vec<f64> = jets.iter().map(|jet| jet.x).collect();
        let places = [case.folds.as_slice(), &case.crossings].concat();
        let mut count = |way: usize, times: &[f64], known: &[Expected], places: &[f64], answer: &Answer| {
            let (verdict, words) = judge(places, times, known, answer);
            tally.count(way, verdict, || {
                format!("{words}\n    {:?} {}\n    times {times:?}\n    from {start:?}", case.mechanism, case.note)
            });
        };
        count(0, times, &known, &places, &swept(group, &case.mechanism, &start, true));
        count(1, times, &known, &places, &swept(group, &case.mechanism, &start, false));
        let (near, answer) = states(group, &case.mechanism, &known, &places);
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
        count(2, times, &known, &places, &tracked(group, &case.mechanism, &start));
        if let Some(batch) = batch {
            let places = [places, case.plan_ends.clone()].concat();
            count(3, times, &known, &places, &planned(group, &case.mechanism, &start));
            count(4, times, &known, &places, &batch);
        }
    }
}

/// Asserts that the expected states satisfy the equations of the mechanism: Φ = 0, and Φ_q q̇ + Φ_t = 0 where this can
/// be checked.
fn closes<M: Kinematics + Debug>(group: &Group<M>, mechanism: &M, known: &[Expected]) {
    for (t, known) in group.times.iter().zip(known) {
        let Some((jets, allowed)) = known else { continue };
        let (inputs, q) = (told(group, *t), jets.iter().map(|jet| jet.x).collect::<Vec<_>>());
        let at = Instant { t: *t, inputs: &inputs };
        let (Ok(phi), Ok(jacobian), Ok(phi_t)) =
            (mechanism.constraints(&at, &q), mechanism.jacobian(&at, &q), mechanism.time_derivative(&at, &q))
        else {
            panic!("{mechanism:?}: so many coordinates has it not")
        };
        assert!(largest(phi.as_ref()) < 1e-12, "{mechanism:?} does not close at t = {t:?}: {q:?}");
        let mut rates = phi_t.as_ref().to_vec();
        for (&(row, column), entry) in M::model().constraint_pattern.entries.iter().zip(jacobian.as_ref()) {
            rates[row] += entry * jets[column].v;
        }
        let loose = allowed.iter().fold(1e-9, |most: f64, allowed| most.max(allowed[1]));
        assert!(largest(&rates) < loose, "{mechanism:?} does not move like this at t = {t:?}: {rates:?}");
    }
}

fn swept<M: Kinematics>(group: &Group<M>, mechanism: &M, start: &[f64], use_plan: bool) -> Answer {
    let options = Options { use_plan, ..Options::default() };
    let mut solver = mechanism.solver().with_options(options);
    if M::INPUTS > 0 {
        solver = solver.with_inputs(&*group.inputs);
    }
    let (trajectory, refusal) = match solver.sweep_from(start, &group.times) {
        Ok(trajectory) => (trajectory, None),
        Err(error) => (*error.trajectory, Some(refusal(&error.source))),
    };
    let states = trajectory.states.into_iter().map(|state| [state.q, state.q_dot, state.q_ddot]).collect();
    Answer { states, refusal }
}

fn tracked<M: Kinematics>(group: &Group<M>, mechanism: &M, start: &[f64]) -> Answer {
    let mut answer = Answer { states: Vec::new(), refusal: None };
    let first = told(group, group.times[0]);
    let mut tracker = match mechanism.solver().tracker_from(&Instant { t: group.times[0], inputs: &first }, start) {
        Ok(tracker) => tracker,
        Err(error) => return Answer { refusal: Some(refusal(&error)), ..answer },
    };
    for &t in &group.times {
        match tracker.update(&Instant { t, inputs: &told(group, t) }) {
            Ok(state) => answer.states.push([&state.q, &state.q_dot, &state.q_ddot].map(Clone::clone)),
            Err(error) => {
                let found = refusal(&error);
                // Between instants the inputs follow the tracker's own course, so that the time of the limit cannot be
                // compared.
                let t = found.t.filter(|_| M::INPUTS == 0);
                return Answer { refusal: Some(Refusal { t, ..found }), ..answer };
            }
        }
    }
    answer
}

fn planned<M: Kinematics>(group: &Group<M>, mechanism: &M, start: &[f64]) -> Answer {
    let mut answer = Answer { states: Vec::new(), refusal: None };
    let refusal = |error: PlanError| {
        let words = error.to_string();
        let typed = error.limit().is_some() || matches!(error, PlanError::Undecided { .. });
        // The error only says which instant cannot be reached.
        Some(Refusal { t: None, typed, words })
    };
    let first = told(group, group.times[0]);
    let mut planned = match Planned::new(mechanism, &Instant { t: group.times[0], inputs: &first }, start) {
        Ok(planned) => planned,
        Err(error) => return Answer { refusal: refusal(error), ..answer },
    };
    for &t in &group.times {
        match planned.at(&Instant { t, inputs: &told(group, t) }) {
            Ok(found) => answer.states.push([found.q(), found.q_dot(), found.q_ddot()].map(<[f64]>::to_vec)),
            Err(error) => return Answer { refusal: refusal(error), ..answer },
        }
    }
    answer
}
