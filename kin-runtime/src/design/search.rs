//! Many starts on all cores: random designs, a first descent from each, and the best of them to the end.

use super::builder::Design;
use super::error::{DesignError, Missed};
use super::evolution::evolve;
use super::fit::{CONVERGENCE, DescentEnd, DescentLimits, FIRST, NOTHING, REFINEMENT, SELECTION, descend, error};
use super::follow::{DescentBranch, Family};
use super::problem::Problem;
use super::result::{Designed, Slack};
use super::task::Task;
use super::variables::FIRST as PERIODS;
use crate::mechanism::Mechanism;
use crate::planned::Sign;
use crate::random::Random;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use rayon::prelude::*;

/// The progress of a search.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Progress {
    /// Descents that are finished.
    pub done: usize,
    /// Their total number.
    pub total: usize,
}

/// Receives the progress of a search and decides whether it goes on.
type Watch<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// How to search.
#[derive(Clone, Copy)]
pub struct Search<'a> {
    /// Random designs to begin with.
    pub starts: usize,
    /// The same seed gives the same result, on however many cores.
    pub seed: u64,
    /// Is called after every descent and before every evaluation of a design; if it returns `Break`, the best design so far
    /// is the result.
    pub watch: Option<Watch<'a>>,
}

impl Default for Search<'_> {
    fn default() -> Self {
        Self { starts: 100, seed: 1, watch: None }
    }
}

impl core::fmt::Debug for Search<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Search").field("starts", &self.starts).field("seed", &self.seed).finish_non_exhaustive()
    }
}

/// Largest number of random designs that are drawn for one start.
const MAX_DRAWS: usize = 2000;
/// Of those that keep the conditions, how many are compared.
const COMPARED: usize = 24;
/// Of these, how many are improved by a few steps before the best of them is the start.
const IMPROVED_DRAWS: usize = 4;
/// Largest number of searches, each with conditions tightened by the violations that were found between instants.
const ROUNDS: usize = 4;
/// By how much conditions are tightened, relative to what was found.
const TIGHTENING: f64 = 1.2;
/// Of the first descents, one in so many goes on.
const TAKEN: usize = 4;
/// At least this many go on; at most this many of them are taken to the end.
const FINISHED: usize = 12;
/// Largest difference of two errors, relative to the error, with which they count as the same minimum.
const SAME_ERROR: f64 = 1e-6;

impl<M: Mechanism> Design<M> {
    /// Searches for the parameters with the least sum of squared misses.
    ///
    /// # Errors
    /// [`Nothing`](DesignError::Nothing) without free parameters or without objectives; [`Inputs`](DesignError::Inputs)
    /// for a mechanism with inputs; [`NoStart`](DesignError::NoStart) where no random design assembles all the way and
    /// keeps the conditions; [`Stopped`](DesignError::Stopped) by `watch` before there was a design.
    pub fn search(&self, search: &Search<'_>) -> Result<Designed<M>, DesignError> {
        let found = searched(self, &self.task, search)?;
        Ok(found.map(|parameters| self.mechanism(&parameters)))
    }

    /// The mechanism with these parameters.
    pub(crate) fn mechanism(&self, parameters: &[f64]) -> M {
        let mut mechanism = (self.make)();
        for (index, value) in parameters.iter().enumerate() {
            mechanism.set_parameter(index, *value);
        }
        mechanism
    }
}

/// The parameters with the least sum of squared misses.
pub(crate) fn searched(
    family: &dyn Family,
    task: &Task,
    search: &Search<'_>,
) -> Result<Designed<Vec<f64>>, DesignError> {
    if task.free.is_empty() {
        return Err(DesignError::Nothing { what: "no parameter is free" });
    }
    if task.objectives.iter().all(|objective| objective.instants() == 0) {
        return Err(DesignError::Nothing { what: "the design has no objective" });
    }
    if search.starts == 0 {
        return Err(DesignError::Nothing { what: "a search has at least one start" });
    }
    if !task.model.inputs.is_empty() {
        return Err(DesignError::Inputs { inputs: task.model.inputs.to_vec() });
    }
    let problem = Problem { family, task, is_stopped: None };
    let modes = problem.all_modes();
    // Conditions are kept at instants; where they are broken between them, they are tightened by as much.
    let mut tightened = task.clone();
    let mut ends = Vec::new();
    for _ in 0..ROUNDS {
        let design = Problem { family, task: &tightened, is_stopped: None };
        let mut descents = Descents { design, search, modes: &modes, stopped: AtomicBool::new(false) };
        let found = descents.run(&mut ends);
        let stopped = *descents.stopped.get_mut();
        let Some(best) = found.first() else {
            if stopped {
                return Err(DesignError::Stopped);
            }
            return Err(problem.no_start(&modes, search));
        };
        let slacks = problem.verified(&best.variables, &best.branch)?;
        let broken = slacks.iter().any(|slack| slack.slack < 0.0);
        if !broken || stopped {
            let mut designed = problem.designed(best, slacks);
            designed.errors = found.iter().map(|end| end.error).collect();
            let nothing = NOTHING * problem.wanted();
            let same = |error: &&f64| match problem.is_least() {
                true => **error - best.error <= SAME_ERROR * best.error.abs(),
                false => **error <= (1.0 + SAME_ERROR) * best.error.max(nothing),
            };
            designed.met = designed.errors.iter().filter(same).count();
            (designed.starts, designed.assembled, designed.finished) = (search.starts, ends.len(), found.len());
            designed.stopped = stopped;
            return Ok(designed);
        }
        for (condition, slack) in tightened.conditions.iter_mut().zip(&slacks) {
            condition.tighten(TIGHTENING * (-slack.slack).max(0.0));
        }
        // New starts are drawn if none of the old ones keeps the tightened conditions.
        let design = Problem { family, task: &tightened, is_stopped: None };
        ends.retain(|end: &DescentEnd| error(design, &end.variables, &end.branch).is_some());
    }
    Err(DesignError::NotKept { rounds: ROUNDS })
}

impl Problem<'_> {
    /// Every mode of the plan with the prescribed sign, or else the one that the guesses lead to.
    fn all_modes(&self) -> Vec<(usize, Option<Sign>)> {
        let Task { model, objectives, modes, .. } = self.task;
        let instant = objectives.iter().find_map(|objective| objective.times.first().copied()).unwrap_or(0.0);
        let found = self.family.guessed(self.task, instant);
        let guessed = |index: usize| found.as_ref()?.get(index).and_then(|mode| mode.sign);
        let requested = |index: usize| modes.iter().find(|(other, _)| *other == index).map(|(_, sign)| *sign);
        (0..model.plan.modes.len()).map(|index| (index, requested(index).unwrap_or_else(|| guessed(index)))).collect()
    }

    /// What is reported of a design with these slacks.
    fn designed(&self, end: &DescentEnd, slacks: Vec<Slack>) -> Designed<Vec<f64>> {
        let (task, parameters) = (self.task, self.task.parameters_at(&end.variables));
        let evaluated = self.evaluate(&end.variables, &end.branch, false).unwrap_or_default();
        let modes = end.branch.modes.iter().map(|&(index, sign)| (task.model.plan.modes[index].name, sign));
        Designed {
            parameters: task.varied(&parameters),
            error: end.error,
            least: self.is_least().then_some(evaluated.least),
            times: evaluated.times,
            modes: modes.collect(),
            slacks,
            starts: 0,
            assembled: 0,
            finished: 0,
            met: 0,
            errors: Vec::new(),
            stopped: false,
            mechanism: parameters,
        }
    }

    /// Random variables.
    fn draw(&self, random: &mut Random, modes: &[(usize, Option<Sign>)]) -> (Vec<f64>, DescentBranch) {
        let mut share = || 0.5 * (random.symmetric() + 1.0);
        // Bounds may be far wider than the wanted values are large: half of the draws are restricted to a smaller part
        // of them, of random width.
        let (size, near) = (self.size(), (2.0 * share() - 1.0).max(0.0));
        let mut variables: Vec<f64> = self.task.free.iter().map(|free| free.drawn(size, near, share())).collect();
        for objective in self.task.objectives.iter().filter(|objective| objective.free.is_some()) {
            let count = objective.instants();
            // The first instant within one period; then equal gaps that do not fill the period.
            variables.push((1.0 + share()) / PERIODS);
            let all = 0.3 + 0.65 * share();
            let gap = all / (count as f64);
            variables.extend((1..count).map(|_| gap));
        }
        let sign = |share: f64| if share < 0.5 { Sign::Plus } else { Sign::Minus };
        let forward = share() < 0.5;
        let modes =
            modes.iter().map(|&(place, requested)| (place, requested.unwrap_or_else(|| sign(share())))).collect();
        (variables, DescentBranch { modes, forward })
    }

    /// A random design that keeps all conditions: of some that are drawn the best are improved by a few steps, and the best
    /// of these is taken.
    fn drawn(&self, number: usize, seed: u64, modes: &[(usize, Option<Sign>)]) -> Option<DescentEnd> {
        // Numbers of one seed are far from those of the next.
        let mut random = Random::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ ((number as u64) << 20));
        let mut found: Vec<DescentEnd> = Vec::new();
        for _ in 0..MAX_DRAWS {
            self.go_on().ok()?;
            let (variables, branch) = self.draw(&mut random, modes);
            let Some(error) = error(*self, &variables, &branch) else { continue };
            found.push(DescentEnd { variables, error, branch });
            if found.len() == COMPARED {
                break;
            }
        }
        found.sort_by(|a, b| a.error.total_cmp(&b.error));
        let tried = found.into_iter().take(IMPROVED_DRAWS).map(|end| improved(*self, end, SELECTION));
        tried.min_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// What is wrong with some of the random designs, of which none can be a start.
    fn no_start(&self, modes: &[(usize, Option<Sign>)], search: &Search<'_>) -> DesignError {
        let conditions = &self.task.conditions;
        let (mut random, mut open, mut why) = (Random::new(search.seed), 0, None);
        let mut missed: Vec<Missed> = conditions
            .iter()
            .map(|condition| Missed { condition: condition.name(), designs: 0, closest: None })
            .collect();
        let progress = Progress { done: search.starts, total: search.starts };
        for _ in 0..MAX_DRAWS {
            if search.watch.is_some_and(|watch| watch(progress).is_break()) {
                return DesignError::Stopped;
            }
            let (variables, branch) = self.draw(&mut random, modes);
            let evaluated = match self.evaluate(&variables, &branch, false) {
                Ok(evaluated) => evaluated,
                Err(error) => {
                    (open, why) = (open + 1, why.or(Some(Box::new(error))));
                    continue;
                }
            };
            for (index, missed) in missed.iter_mut().enumerate() {
                let slacks =
                    evaluated.conditions.iter().zip(&evaluated.slacks).filter(|(condition, _)| **condition == index);
                let least = slacks.map(|(_, slack)| slack.value).fold(f64::INFINITY, f64::min);
                if least <= 0.0 {
                    missed.designs += 1;
                    missed.closest = Some(missed.closest.map_or(-least, |closest| closest.min(-least)));
                }
            }
        }
        missed.retain(|missed| missed.designs > 0);
        DesignError::NoStart { drawn: search.starts * MAX_DRAWS, sampled: MAX_DRAWS, open, why, missed }
    }
}

/// A design after a descent.
fn improved(design: Problem<'_>, start: DescentEnd, effort: DescentLimits) -> DescentEnd {
    if design.is_least() { evolve(design, start, effort) } else { descend(design, start, effort) }
}

/// The descents of a search.
struct Descents<'s> {
    design: Problem<'s>,
    search: &'s Search<'s>,
    modes: &'s [(usize, Option<Sign>)],
    stopped: AtomicBool,
}

impl Descents<'_> {
    /// First descents from random designs, where there are none yet, and the best of them taken to the end, in ascending
    /// order of their errors.
    fn run(&self, ends: &mut Vec<DescentEnd>) -> Vec<DescentEnd> {
        let starts = self.search.starts;
        let taken = |count: usize| (count / TAKEN).max(FINISHED).min(count);
        let (done, total) = (AtomicUsize::new(0), starts + taken(starts) + FINISHED.min(starts));
        let (search, stopped) = (self.search, &self.stopped);
        let is_stopped = || {
            let done = done.load(Ordering::Relaxed);
            if search.watch.is_some_and(|watch| watch(Progress { done, total }).is_break()) {
                stopped.store(true, Ordering::Relaxed);
            }
            stopped.load(Ordering::Relaxed)
        };
        let design = Problem { is_stopped: Some(&is_stopped), ..self.design };
        let count = || {
            done.fetch_add(1, Ordering::Relaxed);
            is_stopped();
        };
        if ends.is_empty() {
            let first = |number: usize| {
                if stopped.load(Ordering::Relaxed) {
                    return None;
                }
                let end = design.drawn(number, search.seed, self.modes).map(|start| improved(design, start, FIRST));
                count();
                end
            };
            *ends = (0..starts).into_par_iter().filter_map(first).collect();
            ends.sort_by(|a, b| a.error.total_cmp(&b.error));
        }
        let further = |ends: &[DescentEnd], effort: DescentLimits| -> Vec<DescentEnd> {
            let one = |end: &DescentEnd| {
                if stopped.load(Ordering::Relaxed) {
                    return end.clone();
                }
                let end = improved(design, end.clone(), effort);
                count();
                end
            };
            let mut found: Vec<DescentEnd> = ends.par_iter().map(one).collect();
            found.sort_by(|a, b| a.error.total_cmp(&b.error));
            found
        };
        let mut found = further(&ends[..taken(ends.len())], REFINEMENT);
        found.truncate(FINISHED);
        further(&found, CONVERGENCE)
    }
}
