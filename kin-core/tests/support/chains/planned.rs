//! A solution plan with the mechanism that it belongs to.

use super::{Oracle, environment};
use crate::support::oracle::{Solution, closures, resolve, run};
use kin_core::expr::Symbol;
use kin_core::plan::{SolutionPlan, plan};
use kin_core::vocabulary::StepKind;

pub struct Planned(pub SolutionPlan);

impl Planned {
    pub fn new(oracle: &Oracle) -> Self {
        let plan = plan(&oracle.system);
        assert_eq!(plan.absent, None);
        Self(plan)
    }

    /// The unknowns of every iteration, in order.
    pub fn newton(&self) -> Vec<usize> {
        let unknowns = |kind| if let StepKind::Newton(unknowns) = kind { Some(unknowns) } else { None };
        self.0.steps.iter().filter_map(|step| unknowns(step.kind)).collect()
    }

    /// The number of steps that close in one of two ways.
    pub fn closed(&self) -> usize {
        self.0.steps.iter().filter(|step| step.kind == StepKind::Closure).count()
    }

    /// The letters of the steps that are dyads, in order.
    pub fn groups(&self) -> Vec<&str> {
        self.0.steps.iter().map(|step| step.group.as_str()).filter(|group| !group.is_empty()).collect()
    }

    /// What tells the modes of the configuration q.
    pub fn closures(&self, oracle: &Oracle, t: f64, q: &[f64]) -> Vec<f64> {
        let mut closures = closures(&self.0, &environment(&oracle.parameters, t, q, &[]));
        closures.truncate(self.0.modes.len());
        closures
    }

    /// x with Φ_q x = b at the configuration q.
    pub fn resolve(&self, oracle: &Oracle, t: f64, q: &[f64], b: &[f64]) -> Vec<f64> {
        let at = environment(&oracle.parameters, t, q, &[]);
        resolve(&self.0, &|symbol| if let Symbol::Right(k) = symbol { b[k as usize] } else { at(symbol) })
    }

    /// What it gives; it is not told q.
    pub fn run(&self, oracle: &Oracle, t: f64, modes: &[f64], start: &[f64]) -> Solution {
        assert_eq!(modes.len(), self.0.modes.len());
        let unknown = vec![f64::NAN; start.len()];
        run(&self.0, &environment(&oracle.parameters, t, &unknown, &unknown), modes, start)
    }
}
