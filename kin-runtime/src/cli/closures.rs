//! The ways in which a mechanism closes at the first instant of a motion, as a choice that a page offers.

use super::engine::Engine;
use super::failure::Failure;
use super::setup::Setup;
use super::solved::analysis;
use crate::assembly::{Assemblies, Assembly};
use crate::model::Model;
use crate::plan::StepKind;
use crate::planned::Sign;
use crate::present::number::rounded;
use crate::state::State;
use std::f64::consts::TAU;

/// The setup for a motion from the instant t: a closure that is requested by its number becomes the guess.
pub(super) fn settled(engine: &dyn Engine, setup: Setup, t: f64) -> Result<Setup, Failure> {
    let Some(number) = setup.closure else { return Ok(setup) };
    let all = engine.assemblies(&setup, t).map_err(|error| analysis(engine, &error))?;
    let Some(found) = number.checked_sub(1).and_then(|k| all.found.get(k)) else {
        let message = format!("there is no closure {number} at t = {}; `modes` lists {}", rounded(t), all.found.len());
        return Err(Failure::option("--mode", message));
    };
    let modes = &engine.model().plan.modes;
    let is_requested = |&(mode, wanted): &(usize, Sign)| {
        found.modes.iter().all(|&(name, sign)| name != modes[mode].name || sign == wanted)
    };
    match setup.modes.iter().all(is_requested) {
        true => Ok(Setup { guesses: guesses(found), closure: None, ..setup }),
        false => Err(Failure::option("--mode", format!("closure {number} is {}; leave one of both out", found.name()))),
    }
}

/// The configuration of a closure as guesses.
fn guesses(found: &Assembly) -> Vec<(usize, f64)> {
    found.q.iter().copied().enumerate().collect()
}

/// Largest number of motions that one page shows.
pub(super) const MAX_MOTIONS: usize = 8;
/// Largest number of unknowns of a group without a closed form whose closures are searched for a page.
const MAX_SEARCHED_UNKNOWNS: usize = 3;
/// Largest number of modes of which a page shows all combinations. Only for so few modes are their closures computed,
/// to leave out combinations that do not close.
const MAX_COMBINED_MODES: usize = MAX_MOTIONS.ilog2() as usize;
/// Configurations that differ by less than this, apart from whole turns of bodies, are the same.
const SAME_CONFIGURATION: f64 = 1e-6;

/// The name of the requested motion, and the names and setups of other motions.
pub(super) struct ChosenClosures {
    pub(super) name: String,
    pub(super) other_motions: Vec<(String, Setup)>,
}

impl ChosenClosures {
    /// The requested motion alone.
    pub(super) fn requested_alone(engine: &dyn Engine, first: &State) -> Self {
        let chosen_signs = signs(engine, first);
        Self { name: mode_name(engine.model(), &chosen_signs, &chosen_signs), other_motions: Vec::new() }
    }

    /// The requested motion and at most `most` others: closures that are proven to exist if they can be found quickly,
    /// otherwise combinations of signs, which may or may not close.
    pub(super) fn all(engine: &dyn Engine, setup: &Setup, first: &State, most: usize) -> Self {
        let model = engine.model();
        let mut iterated = model.plan.steps.iter().filter_map(|step| match step.kind {
            StepKind::Newton(unknowns) => Some(unknowns),
            _ => None,
        });
        // Whether all closures can be found in a short time.
        let quick = match iterated.next() {
            None => engine.closes_by_signs(setup, first.t),
            Some(unknowns) => {
                unknowns <= MAX_SEARCHED_UNKNOWNS && iterated.all(|unknowns| unknowns <= MAX_SEARCHED_UNKNOWNS)
            }
        };
        let proven =
            setup.given.is_empty() && model.plan.exists() && quick && model.plan.modes.len() <= MAX_COMBINED_MODES;
        let all = proven.then(|| engine.assemblies(setup, first.t).ok()).flatten();
        let all = all.filter(|all| all.undecided.is_empty());
        match all {
            Some(all) if all.names().iter().zip(&all.found).any(|(name, found)| *name != found.name()) => {
                Self::searched(setup, first, &all, most)
            }
            all => {
                let chosen_signs = signs(engine, first);
                let combinations =
                    combinations(&chosen_signs).into_iter().filter(|signs| closes(model, all.as_ref(), signs));
                let named_setup = |signs: Vec<Sign>| {
                    let modes = signs.iter().copied().enumerate().collect();
                    (mode_name(model, &chosen_signs, &signs), Setup { modes, ..setup.clone() })
                };
                let other_motions = combinations.take(most).map(named_setup).collect();
                Self { name: mode_name(model, &chosen_signs, &chosen_signs), other_motions }
            }
        }
    }

    /// Closures by their numbers in the list of `modes`.
    fn searched(setup: &Setup, first: &State, all: &Assemblies, most: usize) -> Self {
        let count = all.found.len();
        let name = |k: usize| format!("closure {} of {count}", k + 1);
        let chosen = all.found.iter().position(|found| is_same(first.model, &found.q, &first.q));
        let rest = all.found.iter().enumerate().filter(|(k, _)| Some(*k) != chosen).take(most);
        let named_setup =
            |(k, found): (usize, &Assembly)| (name(k), Setup { guesses: guesses(found), ..setup.clone() });
        Self {
            name: chosen.map_or_else(|| "as assembled".to_owned(), name),
            other_motions: rest.map(named_setup).collect(),
        }
    }
}

/// The signs of the modes of a state.
fn signs(engine: &dyn Engine, first: &State) -> Vec<Sign> {
    let modes = engine.modes(&first.instant(), &first.q);
    modes.iter().map(|mode| mode.sign.unwrap_or(Sign::Plus)).collect()
}

/// True unless it is proven that these signs do not close.
fn closes(model: &Model, all: Option<&Assemblies>, signs: &[Sign]) -> bool {
    let is = |modes: &[(&str, Sign)]| {
        let mut chosen_signs = model.plan.modes.iter().zip(signs);
        chosen_signs.all(|(mode, sign)| modes.iter().all(|(name, found_sign)| *name != mode.name || found_sign == sign))
    };
    all.is_none_or(|all| all.found.iter().any(|found| is(&found.modes)))
}

/// Other combinations of signs, in which at most the first `MAX_COMBINED_MODES` signs differ.
fn combinations(chosen_signs: &[Sign]) -> Vec<Vec<Sign>> {
    let free = chosen_signs.len().min(MAX_COMBINED_MODES);
    let combination = |number: usize| {
        let flip = |(index, sign): (usize, &Sign)| {
            if index < free && number >> index & 1 == 1 { sign.flipped() } else { *sign }
        };
        chosen_signs.iter().enumerate().map(flip).collect()
    };
    (1..1_usize << free).map(combination).collect()
}

/// The signs of all modes if they are at most two, otherwise only those that differ from `chosen_signs`.
fn mode_name(model: &Model, chosen_signs: &[Sign], signs: &[Sign]) -> String {
    let few = signs.len() <= 2;
    let modes = model.plan.modes.iter().zip(chosen_signs).zip(signs);
    let shown = modes.filter(|((_, chosen), sign)| few || chosen != sign);
    let names: Vec<String> = shown.map(|((mode, _), sign)| format!("{} {sign}", mode.name)).collect();
    if names.is_empty() { "as assembled".to_owned() } else { names.join(", ") }
}

/// Whether configurations are the same, apart from whole turns of bodies.
fn is_same(model: &Model, a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).zip(model.coordinates).all(|((a, b), coordinate)| {
        let turns = if coordinate.kind.is_angle() { ((a - b) / TAU).round() * TAU } else { 0.0 };
        (a - b - turns).abs() <= SAME_CONFIGURATION * (1.0 + a.abs())
    })
}
