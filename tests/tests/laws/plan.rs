//! Laws of solution plans: generated closed forms against Newton's iteration on all coordinates.

use crate::motion::{grid, swept};
use kin_runtime::Kinematics;
use kin_runtime::plan::{Depth, Solved};
use kin_tests::compare::{Differences, largest};

/// q, q̇, q̈ and margins by the plan.
struct ByPlan {
    q: Vec<f64>,
    q_dot: Vec<f64>,
    q_ddot: Vec<f64>,
    margins: Vec<f64>,
}

fn by_plan<M: Kinematics>(mechanism: &M, at: &kin_runtime::Instant<'_>, modes: &[f64], start: &[f64]) -> ByPlan {
    let none = || vec![f64::NAN; M::COORDINATES];
    let mut out = ByPlan { q: none(), q_dot: none(), q_ddot: none(), margins: vec![f64::NAN; M::model().plan.margins] };
    let ByPlan { q, q_dot, q_ddot, margins } = &mut out;
    let parameters = mechanism.parameters::<f64>();
    mechanism
        .solve_with(parameters.as_ref(), at, modes, start, Depth::Acceleration, Solved { q, q_dot, q_ddot, margins })
        .unwrap();
    out
}

/// Along a sweep, from a start beside each state: the same q, q̇ and q̈, as well as conditioning allows.
pub(crate) fn plans_equal_newton<M: Kinematics + Default>(from: f64, to: f64) {
    let (mechanism, plan) = (M::default(), &M::model().plan);
    if !plan.exists() {
        return;
    }
    let (mut differences, mut compared) = (Differences::new(), 0);
    for state in &swept(&mechanism, &grid(from, to, 12)) {
        let mut modes = vec![f64::NAN; plan.modes.len()];
        let parameters = mechanism.parameters::<f64>();
        mechanism.closures_with(parameters.as_ref(), &state.instant(), &state.q, &mut modes).unwrap();
        modes.iter_mut().for_each(|w| *w = w.signum());
        let start: Vec<f64> = state.q.iter().enumerate().map(|(k, q)| q + 1e-3 * (k as f64).sin()).collect();
        let found = by_plan(&mechanism, &state.instant(), &modes, &start);
        let margin = found.margins.iter().copied().fold(1.0, f64::min);
        assert!(!margin.is_nan(), "{:?}", found.margins);
        if margin < 1e-4 {
            continue;
        }
        compared += 1;
        differences.at(format_args!("t = {}, margin {margin}", state.t));
        let name = |place: usize| M::model().coordinates[place].name;
        let pairs = [
            ("q", &state.q, &found.q),
            ("q_dot", &state.q_dot, &found.q_dot),
            ("q_ddot", &state.q_ddot, &found.q_ddot),
        ];
        for (order, (what, newton, plan)) in pairs.into_iter().enumerate() {
            let room = 1e-12 * largest(newton).max(1.0) / margin.powf(0.5 + order as f64);
            differences.vector(what, name, newton, plan, room);
        }
    }
    assert!(compared > 0, "singular everywhere");
    differences.finish();
}
