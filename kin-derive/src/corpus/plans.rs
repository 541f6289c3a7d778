//! The solution of a plan satisfies the rows, for every mechanism of the repository: Φ = 0, Φ_q q̇ = −Φ_t, Φ_q q̈ = γ
//! wherever its margins are positive, for random parameters, modes and starts.

use super::all;
use super::repository::{Found, mechanisms};
use crate::analyse::analyse;
use crate::oracle::{Environment, Solution, evaluate, run};
use kin_core::KinematicSystem;
use kin_core::expr::Symbol;
use kin_core::plan::{SolutionPlan, plan};

/// The values of all symbols; supplied functions are x ↦ 1 + 0.2 sin x.
struct Values<'a> {
    parameters: &'a [f64],
    t: f64,
    q: &'a [f64],
    q_dot: &'a [f64],
}

impl Environment for Values<'_> {
    fn symbol(&self, symbol: Symbol) -> f64 {
        match symbol {
            Symbol::Parameter(k) => self.parameters[k as usize],
            Symbol::Time => self.t,
            Symbol::Input(k, order) => [0.7 + 0.1 * f64::from(k), 0.3, -0.2][usize::from(order)],
            Symbol::Coordinate(k) => self.q[k as usize],
            Symbol::Rate(k) => self.q_dot[k as usize],
            _ => f64::NAN,
        }
    }

    fn supplied(&self, _: u32, order: u8, x: f64) -> f64 {
        [1.0 + 0.2 * x.sin(), 0.2 * x.cos(), -0.2 * x.sin()][usize::from(order)]
    }
}

/// A generator of pseudo-random numbers with a fixed seed.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The largest violation of a row at a solution, relative to the size of its terms.
fn violation(system: &KinematicSystem, values: &Values<'_>, solution: &Solution) -> f64 {
    let graph = &system.set.graph;
    let mut worst = 0.0_f64;
    for equation in &system.equations {
        let mut roots = vec![equation.phi, equation.phi_t, equation.gamma];
        roots.extend(equation.phi_q.iter().map(|(_, e)| *e));
        let found = evaluate(graph, &roots, values);
        let (mut velocity, mut acceleration) = (found[1], -found[2]);
        let (mut velocity_size, mut acceleration_size) = (found[1].abs(), found[2].abs());
        let mut size = 1.0_f64;
        for ((k, _), e) in equation.phi_q.iter().zip(&found[3..]) {
            let (v, a) = (e * solution.q_dot[*k as usize], e * solution.q_ddot[*k as usize]);
            velocity += v;
            acceleration += a;
            velocity_size += v.abs();
            acceleration_size += a.abs();
            size = size.max((e * solution.q[*k as usize]).abs()).max(e.abs());
        }
        let own = [found[0] / size, velocity / (1e-6 + velocity_size), acceleration / (1e-6 + acceleration_size)];
        worst = own.into_iter().fold(worst, |worst, v| if v.is_nan() { f64::INFINITY } else { worst.max(v.abs()) });
    }
    worst
}

/// The number of random draws for which the plan has a solution.
fn tried(name: &str, system: &KinematicSystem, plan: &SolutionPlan, defaults: &[f64]) -> usize {
    let (mut random, mut closed) = (Random(7), 0);
    let n = system.set.coordinates.len();
    for _ in 0..40 {
        let parameters: Vec<f64> = defaults.iter().map(|d| d * (0.9 + 0.2 * random.unit())).collect();
        let t = random.unit();
        let modes: Vec<f64> = plan.modes.iter().map(|_| if random.unit() < 0.5 { -1.0 } else { 1.0 }).collect();
        let start: Vec<f64> = (0..n).map(|_| 2.0 * random.unit() - 1.0).collect();
        let zero = vec![0.0; n];
        let before = Values { parameters: &parameters, t, q: &zero, q_dot: &zero };
        let solution = run(plan, &before, &modes, &start);
        let all = solution.q.iter().chain(&solution.q_dot).chain(&solution.q_ddot);
        if !all.clone().all(|v| v.is_finite() && v.abs() < 1e6) || !solution.margins.iter().all(|m| *m > 1e-4) {
            continue;
        }
        closed += 1;
        let after = Values { parameters: &parameters, t, q: &solution.q, q_dot: &solution.q_dot };
        let own = violation(system, &after, &solution);
        assert!(own < 1e-8, "{name}: {own:e} at {solution:?}\n{plan}\n{system}");
    }
    closed
}

#[test]
fn plans_close_the_rows() {
    let sources = all().map(|case| (case.name.to_owned(), super::TokenStream::new(), case.source(&case.attributes())));
    let found = mechanisms().into_iter().map(|Found { name, args, item }| (name, args, item));
    let (mut plans, mut closed_by_plan) = (0, 0);
    for (name, args, item) in sources.chain(found) {
        let (_, Ok(lowered)) = analyse(args, item) else { continue };
        let Ok(system) = kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate) else { continue };
        let plan = plan(&system);
        if plan.absent.is_some() {
            continue;
        }
        plans += 1;
        let defaults: Vec<f64> = (lowered.mechanism.parameters.iter())
            .flat_map(|p| p.default.clone().unwrap_or_else(|| vec![0.7; p.len.unwrap_or(1)]))
            .collect();
        closed_by_plan += usize::from(tried(&name, &system, &plan, &defaults) > 0);
    }
    assert!(plans > 160 && closed_by_plan > 150, "{plans} plans, {closed_by_plan} closed for some draw");
}
