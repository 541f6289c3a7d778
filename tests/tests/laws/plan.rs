//! Laws of solution plans: generated closed forms agree with Newton's iteration on all coordinates.

use crate::When;
use crate::motion::{grid, swept};
use kin_runtime::plan::StepKind;
use kin_runtime::{Instant, Options};
use kin_tests::compare::{Differences, largest};
use kin_tests::subject::{Analyses, PlanAnswer, Subject};

/// A solver by full Newton, without the plan.
pub(crate) fn newton(mechanism: &dyn Subject) -> Box<dyn Analyses + '_> {
    let options = Options { use_plan: false, ..Options::default() };
    mechanism.driven(options)
}

/// Along a sweep, from a start near each state, the plan gives the same q, q̇ and q̈ up to conditioning.
pub(crate) fn plans_equal_newton(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let plan = &model.plan;
    if !plan.exists() {
        return;
    }
    let (mut differences, mut compared) = (Differences::new(), 0);
    for state in &newton(mechanism).sweep(&grid(from, to, 12)).unwrap() {
        let modes = mechanism.modes(&state.instant(), &state.q);
        let start: Vec<f64> = state.q.iter().enumerate().map(|(k, q)| q + 1e-3 * (k as f64).sin()).collect();
        let found = mechanism.by_plan(&state.instant(), &modes, &start);
        let margin = found.margins.iter().copied().fold(1.0, f64::min);
        assert!(!margin.is_nan(), "{:?}", found.margins);
        margins_are_distances(mechanism, &state.instant(), &found);
        if margin < 1e-4 {
            continue;
        }
        compared += 1;
        differences.at(format_args!("t = {}, margin {margin}", state.t));
        let name = |place: usize| model.coordinates[place].name;
        let pairs = [
            ("q", &state.q, &found.q),
            ("q_dot", &state.q_dot, &found.q_dot),
            ("q_ddot", &state.q_ddot, &found.q_ddot),
        ];
        for (order, (what, newton, plan)) in pairs.into_iter().enumerate() {
            let room = 1e-12 * largest(newton).max(1.0) / margin.powf(0.5 + order as f64);
            differences.vector(what, name, newton, plan, room);
        }
        // Analyses of a given configuration, which need not satisfy Φ = 0.
        let by_newton = newton(mechanism);
        for q in [&state.q, &start] {
            let at = state.instant();
            let found = [mechanism.velocity_analysis(&at, q), mechanism.acceleration_analysis(&at, q, &state.q_dot)];
            let expected = [by_newton.velocity(&at, q), by_newton.acceleration(&at, q, &state.q_dot)];
            for ((what, found), expected) in ["q_dot of q", "q_ddot of q"].into_iter().zip(found).zip(expected) {
                assert_eq!(expected.is_ok(), found.is_ok(), "{what} at t = {}: {expected:?}, {found:?}", state.t);
                let (Ok(found), Ok(expected)) = (found, expected) else { continue };
                let room = 1e-11 * largest(&expected).max(largest(&state.q_dot)).max(1.0) / margin;
                differences.vector(what, name, &expected, &found, room);
            }
        }
    }
    assert!(compared > 0, "singular everywhere");
    differences.finish();
}

/// The margin of a group that closes in two ways, or is solved by iteration, is no larger than the square of its branch
/// value: what is far from its limit by its margin has not changed its sign. (Signs of linear steps are looked at in every
/// step of a motion.)
fn margins_are_distances(mechanism: &dyn Subject, at: &Instant<'_>, found: &PlanAnswer) {
    let (plan, name) = (&mechanism.model().plan, mechanism.model().name);
    let branch_values = mechanism.branch_values(at, &found.q);
    let groups = plan.modes.iter().chain(plan.orientations).zip(&branch_values);
    let is_seen = |step: usize| matches!(plan.steps[step].kind, StepKind::Closure | StepKind::Newton(_));
    for (group, w) in groups.filter(|(group, _)| is_seen(group.step)) {
        let (margin, square) = (found.margins[group.margin], w * w);
        assert!(margin <= square + 1e-9, "{name} at t = {}: {}, margin {margin} and w² = {square}", at.t, group.name);
    }
}

/// A sweep by the plan gives the same results as one by full Newton, and needs no fallback to Newton away from limits.
pub(crate) fn sweeps_by_plan_equal_newton(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let times = grid(from, to, 60);
    let (found, expected) = (swept(mechanism, &times), newton(mechanism).sweep(&times).unwrap());
    assert!(expected.fallbacks.is_empty());
    let mut differences = Differences::new();
    let name = |place: usize| model.coordinates[place].name;
    for (found, expected) in found.iter().zip(&expected) {
        differences.at(format_args!("t = {}", found.t));
        differences.equal("degrees of freedom", expected.degrees_of_freedom_left, found.degrees_of_freedom_left);
        let pairs = [
            ("q", &expected.q, &found.q),
            ("q_dot", &expected.q_dot, &found.q_dot),
            ("q_ddot", &expected.q_ddot, &found.q_ddot),
        ];
        for (what, expected, found) in pairs {
            let room = 1e-12 * largest(expected).max(1.0);
            differences.vector(what, name, expected, found, room);
        }
        differences.number("residual", 0.0, found.residual, 1e-12);
    }
    differences.equal("events", expected.events.len(), found.events.len());
    if !model.plan.exists() {
        differences.equal("fallbacks without a plan", 0, found.fallbacks.len());
    }
    for fallback in &found.fallbacks {
        differences.report(format_args!("full Newton {fallback}"));
    }
    differences.finish();
}

/// `Planned` gives the same states as a sweep by full Newton; its modes keep their signs and its margins are positive.
pub(crate) fn planned_instants_equal_newton(mechanism: &dyn Subject, from: f64, to: f64) {
    let model = mechanism.model();
    let plan = &model.plan;
    let (start, solver) = (When::of(mechanism, from), mechanism.solver());
    if !plan.exists() {
        let error = solver.planned(&start.at()).err().expect("there is no plan");
        assert!(error.to_string().starts_with("no plan because "), "{error}");
        return;
    }
    let mut planned = solver.planned(&start.at()).unwrap();
    let signs = planned.modes();
    let mut differences = Differences::new();
    let name = |place: usize| model.coordinates[place].name;
    for expected in &newton(mechanism).sweep(&grid(from, to, 120)).unwrap() {
        let found = planned.at(&expected.instant()).unwrap_or_else(|error| panic!("{error}"));
        differences.at(format_args!("t = {}", expected.t));
        let modes = solver.modes(&expected.instant(), &expected.q).unwrap();
        differences.equal("modes", signs.clone(), modes.iter().filter_map(|mode| mode.sign).collect());
        for (place, &margin) in found.margins.iter().enumerate() {
            if margin.is_nan() || margin <= 0.0 || margin > 1.0 {
                differences.report(format_args!("margin {place}: {margin}"));
            }
        }
        let pairs = [
            ("q", &expected.q, &found.q),
            ("q_dot", &expected.q_dot, &found.q_dot),
            ("q_ddot", &expected.q_ddot, &found.q_ddot),
        ];
        for (what, expected, found) in pairs {
            let room = 1e-12 * largest(expected).max(1.0);
            differences.vector(what, name, expected, found, room);
        }
    }
    assert_eq!(signs.len(), plan.modes.len());
    differences.finish();
}
