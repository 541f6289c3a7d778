//! Motions that end because a row does: it is not defined beyond, it jumps, or its solution goes to infinity.

use super::jumps::reached;
use kin_runtime::{Instant, Kinematics, LimitKind, Mechanism, Options, PlanError, Refusal, SolveError, mechanism};

#[mechanism]
#[coordinates(u)]
#[driver(turn: atan2(sin(u), cos(u)) = t)]
#[guess(u = 0.1)]
struct Wrapping;

#[mechanism]
#[coordinates(u)]
#[driver(push: u = sqrt(pi - t))]
#[guess(u = 1)]
struct Root;

#[mechanism]
#[coordinates(u)]
#[driver(push: u + 0.1 * sin(u) = sqrt(pi - t))]
#[guess(u = 1)]
struct IteratedRoot;

#[mechanism]
#[coordinates(u)]
#[driver(push: u + 0.1 * sin(u) = ln(pi - t))]
#[guess(u = 1)]
struct IteratedLogarithm;

/// Not the driver ends here but the function of the coordinate.
#[mechanism]
#[coordinates(u)]
#[driver(push: u + sqrt(u) = pi - t)]
#[guess(u = 1)]
struct RootOfCoordinate;

#[mechanism]
#[coordinates(u)]
#[driver(push: 1 / u + 0.01 / (u * u * u) = pi - t)]
#[guess(u = 0.4)]
struct Infinite;

/// What ends a motion, as far as the errors of sweeps and of the plan agree.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ended {
    Undefined(f64),
    Jumps(f64),
    AtInfinity(f64),
    Otherwise,
}

fn ended_sweep(error: &SolveError) -> Ended {
    match error {
        SolveError::StepRefused { t, reason: Refusal::Undefined, .. } => Ended::Undefined(*t),
        SolveError::StepRefused { t, reason: Refusal::Discontinuous, .. } => Ended::Jumps(*t),
        _ => error.limit().map_or(Ended::Otherwise, ended_at_limit),
    }
}

fn ended_plan(error: &PlanError) -> Ended {
    match error {
        PlanError::NonFinite { what: "Φ", t, .. } => Ended::Undefined(*t),
        PlanError::Jump { t, .. } => Ended::Jumps(*t),
        _ => error.limit().map_or(Ended::Otherwise, ended_at_limit),
    }
}

fn ended_at_limit(limit: &kin_runtime::Limit) -> Ended {
    match (limit.kind(), limit.at()) {
        (Some(LimitKind::Pole), Some(at)) => Ended::AtInfinity(at),
        _ => Ended::Otherwise,
    }
}

/// The motion ends at t = π for this reason, on every grid.
fn ends<M: Mechanism + Sync>(mechanism: &M, reason: fn(f64) -> Ended) {
    let is_expected = |ended: Ended| {
        let at = match ended {
            Ended::Undefined(t) | Ended::Jumps(t) | Ended::AtInfinity(t) => t,
            Ended::Otherwise => f64::NAN,
        };
        ended == reason(at) && (at - std::f64::consts::PI).abs() < 1e-6
    };
    for parts in [1, 2, 7, 40] {
        let times: Vec<f64> = (0..=parts).map(|k| 4.0 * f64::from(k) / f64::from(parts)).collect();
        let before = times.iter().filter(|t| **t < std::f64::consts::PI).count();
        assert_eq!([before; 5], reached(mechanism, &times), "{parts}");
        let error = mechanism.solver().sweep(&times).expect_err("it ends");
        assert!(is_expected(ended_sweep(&error.source)), "{parts}: {error}");
        let mut planned = mechanism.solver().planned(&Instant::at(0.0)).expect("it closes");
        let error = times[1..].iter().find_map(|t| planned.at(&Instant::at(*t)).err()).expect("it ends");
        assert!(is_expected(ended_plan(&error)), "{parts}: {error}");
        if reason(0.0) == Ended::AtInfinity(0.0) {
            continue;
        }
        // Without the plan the same reason is found.
        let options = Options { use_plan: false, ..Options::default() };
        let error = mechanism.solver().with_options(options).sweep(&times).expect_err("it ends");
        assert!(is_expected(ended_sweep(&error.source)), "{parts}: {error}");
    }
}

#[test]
fn a_row_that_jumps_is_named() {
    ends(&Wrapping, Ended::Jumps);
}

#[test]
fn a_row_that_is_not_defined_beyond_is_named() {
    ends(&Root, Ended::Undefined);
    ends(&IteratedRoot, Ended::Undefined);
    ends(&IteratedLogarithm, Ended::Undefined);
    ends(&RootOfCoordinate, Ended::Undefined);
}

#[test]
fn an_iteration_that_goes_to_infinity_has_a_pole() {
    ends(&Infinite, Ended::AtInfinity);
}
