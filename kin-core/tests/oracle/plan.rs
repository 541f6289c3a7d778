//! Runs a plan in double precision: the oracle of the generated code.

use super::Environment;
use super::program::interpret;
use kin_core::expr::Symbol;
use kin_core::plan::{Section, SolutionPlan};
use kin_core::program::{Program, Slot};

/// What a plan gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solution {
    /// q.
    pub q: Vec<f64>,
    /// q̇.
    pub q_dot: Vec<f64>,
    /// q̈.
    pub q_ddot: Vec<f64>,
    /// The margins of the steps: positive where what is solved counts.
    pub margins: Vec<f64>,
    /// Corrections that iterations took.
    pub iterations: usize,
}

/// Most corrections of an iteration.
const CORRECTIONS: usize = 30;
/// A relative correction this small is the last.
const LAST: f64 = 3e-9;

/// An environment with what only plans know.
struct Inside<'a, E> {
    outer: &'a E,
    modes: &'a [f64],
    start: &'a [f64],
    unknowns: &'a [f64],
    saved: &'a [f64],
}

impl<E: Environment> Environment for Inside<'_, E> {
    fn symbol(&self, symbol: Symbol) -> f64 {
        let at = |list: &[f64], k: u32| list.get(k as usize).copied().unwrap_or(f64::NAN);
        match symbol {
            Symbol::Mode(k) => at(self.modes, k),
            Symbol::Start(k) => at(self.start, k),
            Symbol::Unknown(k) => at(self.unknowns, k),
            Symbol::Saved(k) => at(self.saved, k),
            other => self.outer.symbol(other),
        }
    }

    fn supplied(&self, function: u32, order: u8, argument: f64) -> f64 {
        self.outer.supplied(function, order, argument)
    }
}

/// q, q̇, q̈ and margins for the parameters, the time and the inputs of `environment`, in the closures that `modes`
/// asks for, with angles near those of `start`.
pub fn run(plan: &SolutionPlan, environment: &impl Environment, modes: &[f64], start: &[f64]) -> Solution {
    let n = start.len();
    let mut out =
        Solution { q: vec![f64::NAN; n], q_dot: vec![f64::NAN; n], q_ddot: vec![f64::NAN; n], ..Solution::default() };
    out.margins = vec![f64::NAN; plan.margins];
    let (mut unknowns, mut saved) = (start.to_vec(), vec![f64::NAN; plan.saved as usize]);
    for (section, _) in &plan.sections {
        match section {
            Section::Closed(program) => {
                let inside = Inside { outer: environment, modes, start, unknowns: &unknowns, saved: &saved };
                for (slot, value) in interpret(program, &inside) {
                    match slot {
                        Slot::Position(k) => out.q[k] = value,
                        Slot::Velocity(k) => out.q_dot[k] = value,
                        Slot::Acceleration(k) => out.q_ddot[k] = value,
                        Slot::Margin(k) => out.margins[k] = value,
                        Slot::Saved(k) => saved[k] = value,
                        _ => {}
                    }
                }
            }
            Section::Newton { unknowns: places, correction, converged } => {
                let (mut good, before) = (0.0, unknowns.clone());
                for _ in 0..CORRECTIONS {
                    let inside = Inside { outer: environment, modes, start, unknowns: &unknowns, saved: &saved };
                    let steps: Vec<f64> = interpret(correction, &inside).into_iter().map(|(_, step)| step).collect();
                    out.iterations += 1;
                    let mut last = true;
                    for (&place, step) in places.iter().zip(steps) {
                        let x = &mut unknowns[place as usize];
                        *x -= step;
                        last &= (step / (1.0 + x.abs())).abs() <= LAST;
                    }
                    if last {
                        good = 1.0;
                        break;
                    }
                }
                if good == 0.0 {
                    // What follows has numbers to compute with.
                    unknowns = before;
                }
                saved[*converged as usize] = good;
            }
        }
    }
    out
}

/// For every mode, what tells it at a configuration, −1 ≤ w ≤ 1: its sign is the mode, 0 where both closures meet.
pub fn closures(plan: &SolutionPlan, environment: &impl Environment) -> Vec<f64> {
    entries(&plan.branch_values, environment)
}

/// x with Φ_q x = b at a configuration; the entries of b are [`Symbol::Right`].
pub fn resolve(plan: &SolutionPlan, environment: &impl Environment) -> Vec<f64> {
    let [factorise, solve] = &plan.resolve;
    let mut saved = vec![f64::NAN; plan.factors];
    for (slot, value) in interpret(factorise, environment) {
        saved[slot.index()] = value;
    }
    // The second step knows what is saved and b, and nothing else.
    let right = |symbol| match symbol {
        Symbol::Right(_) => environment.symbol(symbol),
        Symbol::Saved(k) => saved[k as usize],
        _ => f64::NAN,
    };
    entries(solve, &right)
}

fn entries(program: &Program, environment: &impl Environment) -> Vec<f64> {
    interpret(program, environment).into_iter().map(|(_, value)| value).collect()
}
