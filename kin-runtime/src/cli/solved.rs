//! One instant, solved, with everything that is reported about it.

use super::degrees;
use super::engine::Engine;
use super::failure::Failure;
use super::names::listing;
use super::session::Session;
use super::setup::Setup;
use crate::error::{Degeneracy, SolveError};
use crate::mobility::Mobility;
use crate::model::{Level, Model};
use crate::modes::Mode;
use crate::motion::Motion;
use crate::present::certificate::Certified;
use crate::present::number::rounded;
use crate::present::text;
use crate::ratios::VelocityRatios;
use crate::signal::Instant;
use crate::state::State;
use crate::transmission::TransmissionAngle;

/// A solved instant.
#[derive(Clone, Debug)]
pub(super) struct SolvedInstant {
    pub(super) state: State,
    pub(super) motion: Motion,
    pub(super) mobility: Mobility,
    pub(super) ratios: VelocityRatios,
    pub(super) angles: Vec<TransmissionAngle>,
    pub(super) modes: Vec<Mode>,
    /// The certificate, if it was requested.
    pub(super) certificate: Option<Certified>,
    /// Whether angles are in degrees.
    pub(super) degrees: bool,
}

impl SolvedInstant {
    /// With angles in degrees, if requested. Velocity ratios stay per radian.
    pub(super) fn shown(mut self, model: &Model, degrees: bool) -> Self {
        if !degrees {
            return self;
        }
        self.angles.iter_mut().for_each(|angle| angle.angle = angle.angle.to_degrees());
        let state = degrees::state(model, &self.state, true).into_owned();
        let motion = degrees::motion(model, &self.motion, true).into_owned();
        Self { state, motion, degrees, ..self }
    }
}

/// Solves at `t` and refuses motions that the drivers leave open.
pub(super) fn solve(engine: &dyn Engine, setup: &Setup, t: f64, least_norm: bool) -> Result<SolvedInstant, Failure> {
    let say = |error| analysis(engine, &error);
    let (state, mobility) = driven_state(engine, setup, t, least_norm)?;
    let motion = engine.motion(setup, &state).map_err(say)?;
    // Ratios and transmission angles may not exist; the state is valid without them.
    let ratios =
        engine.velocity_ratios(setup, &state).unwrap_or(VelocityRatios { drivers: Vec::new(), inputs: Vec::new() });
    let angles = engine.transmission_angles(&state).unwrap_or_default();
    let modes = engine.modes(&state.instant(), &state.q);
    Ok(SolvedInstant { state, motion, mobility, ratios, angles, modes, certificate: None, degrees: false })
}

/// The state at an instant, without the other results.
pub(super) fn driven_state(
    engine: &dyn Engine,
    setup: &Setup,
    t: f64,
    least_norm: bool,
) -> Result<(State, Mobility), Failure> {
    let state = engine.state(setup, t).map_err(|error| misfit(engine, setup, t, &error))?;
    let mobility = engine.mobility(setup, &state.instant(), &state.q).map_err(|error| analysis(engine, &error))?;
    if !least_norm {
        fully_driven(engine, &mobility, t)?;
    }
    Ok((state, mobility))
}

/// Notes that the answer is the one of least norm among many.
pub(super) fn note_freedom(session: &mut Session<'_>, freedom_left: usize) {
    if freedom_left > 0 {
        let open = text::count(freedom_left, "degree");
        session.note(&format!("note: {open} of freedom left open; this is the answer of least norm"));
    }
}

/// A note for an instant at which the guess leads to other modes than at t = 0: a motion from t = 0 would stay in those
/// of t = 0.
pub(super) fn other_modes(engine: &dyn Engine, setup: &Setup, t: f64) -> Option<String> {
    if t == 0.0 || engine.model().plan.modes.is_empty() {
        return None;
    }
    let modes = |t: f64| engine.state(setup, t).ok().map(|state| engine.modes(&state.instant(), &state.q));
    let (first, now) = (modes(0.0)?, modes(t)?);
    let other = first.iter().zip(&now).filter(|(first, now)| now.sign.is_some() && first.sign != now.sign);
    let options: Vec<String> = other.filter_map(|(mode, _)| Some(format!("{}={}", mode.name, mode.sign?))).collect();
    (!options.is_empty()).then(|| {
        format!(
            "note: the guess leads to another assembly mode at t = {} than at t = 0; a motion from t = 0 stays in --mode {}",
            rounded(t),
            options.join(",")
        )
    })
}

/// Prints the note of [`other_modes`].
pub(super) fn note_modes(session: &mut Session<'_>, engine: &dyn Engine, setup: &Setup, t: f64) {
    if let Some(note) = other_modes(engine, setup, t) {
        session.note(&note);
    }
}

/// Notes that rows of velocity level do not determine a position.
pub(super) fn note_start(session: &mut Session<'_>, mobility: &Mobility) {
    let free = mobility.position_degrees_of_freedom_left;
    if mobility.velocity_level_rows > 0 && free > 0 {
        let values = match free {
            1 => "the start value of 1 coordinate is".to_owned(),
            _ => format!("the start values of {free} coordinates are"),
        };
        session.note(&format!(
            "note: {values} taken from the guess (--guess): rows of velocity level determine rates only; \
             `sweep` integrates them from its first instant on"
        ));
    }
}

fn has_velocity_rows(engine: &dyn Engine) -> bool {
    engine.model().rows.iter().any(|row| row.level == Level::Velocity)
}

/// An error when degrees of freedom are left, with the coordinates that could be given.
pub(super) fn fully_driven(engine: &dyn Engine, mobility: &Mobility, t: f64) -> Result<(), Failure> {
    let freedom_left = mobility.degrees_of_freedom_left;
    if freedom_left == 0 {
        return Ok(());
    }
    let names = text::coordinate_names(engine.model(), &mobility.could_be_given);
    let example = names.first().copied().unwrap_or("coordinate");
    let special = match mobility.generic_rank == Some(mobility.coordinates) {
        true => {
            "\n  at general configurations the drivers determine the motion: this one is special; --guess leads to others"
        }
        false => "",
    };
    Err(Failure::Analysis(format!(
        "under-driven at t = {}: {} left open by the drivers{special}\n{}\n  \
         give {freedom_left} of them: --given {example}=value (or {example}=value:rate:acceleration),\n  \
         or take the smallest change, q̇ and q̈: --least-norm",
        rounded(t),
        if freedom_left == 1 {
            "1 degree of freedom is".to_owned()
        } else {
            format!("{freedom_left} degrees of freedom are")
        },
        listing("  could be given: ", &names),
    )))
}

/// An error of an analysis. If it is caused by given coordinates, it lists those that could be given instead.
pub(super) fn misfit(engine: &dyn Engine, setup: &Setup, t: f64, error: &SolveError) -> Failure {
    let conflict = matches!(error, SolveError::GivenConflict { open: 1.., .. });
    let without = Setup { given: Vec::new(), ..setup.clone() };
    let inputs = &without.beginning_at(t).inputs;
    let mobility = |q: Vec<f64>| engine.mobility(&without, &Instant { t, inputs }, &q);
    match engine.assemble(&without, t).and_then(mobility) {
        Ok(open) if conflict => {
            let names = text::coordinate_names(engine.model(), &open.could_be_given);
            let lead = format!("  could be given, {} of them: ", open.degrees_of_freedom_left);
            Failure::Analysis(format!("{}: {error}\n{}", engine.model().name, listing(&lead, &names)))
        }
        _ => {
            let open = matches!(error, SolveError::NotAssembled { .. } | SolveError::ModeNotAssembled { .. });
            let negative =
                matches!(error, SolveError::DegenerateGeometry { fault: Degeneracy::NegativeLength { .. }, .. });
            match (open || negative).then(|| engine.out_of_range(setup, t)).flatten() {
                Some(why) => Failure::Analysis(format!("{}: {why}\n  {error}", engine.model().name)),
                None if matches!(error, SolveError::NotAssembled { .. }) => {
                    let proven = closures(engine, setup, t).map(|hint| format!("{}\n  {hint}", named(engine, error)));
                    proven.map_or_else(|| analysis(engine, error), Failure::Analysis)
                }
                None => analysis(engine, error),
            }
        }
    }
}

/// What is proven about the closures at an instant, if a plan in closed form gives them: that there are none, or which
/// modes close.
fn closures(engine: &dyn Engine, setup: &Setup, t: f64) -> Option<String> {
    let plan = &engine.model().plan;
    if !plan.exists() || plan.iterates() {
        return None;
    }
    let all = engine.assemblies(setup, t).ok()?;
    match all.found.first() {
        None if all.undecided.is_empty() => Some(format!(
            "it is proven that it cannot be assembled at t = {}, whatever --guess: other dimensions (--set) or times \
             may close",
            rounded(t)
        )),
        None => all.undecided.first().map(|undecided| format!("whether it closes is undecided: {undecided}")),
        Some(closure) if closure.name().is_empty() => None,
        Some(closure) => Some(format!(
            "it closes from another start: --mode {}; `modes` lists every way in which it closes",
            closure.name()
        )),
    }
}

/// An error of an analysis, with a hint.
pub(super) fn analysis(engine: &dyn Engine, error: &SolveError) -> Failure {
    let hint = match error {
        SolveError::NotAssembled { limit: Some(limit), .. } if limit.contradiction().is_some() => {
            "redundant joints must fit each other: change a dimension (--set), or leave one of these joints out"
        }
        SolveError::NotAssembled { .. } => {
            "if these dimensions can close at all, start nearer to the position: --guess coordinate=value,…"
        }
        SolveError::GivenConflict { open: 0, .. } if has_velocity_rows(engine) => {
            "drivers and rows of velocity level determine every rate already: leave --given out; --guess sets a start"
        }
        SolveError::GivenConflict { open: 0, .. } => {
            "the drivers determine every coordinate already: leave --given out"
        }
        SolveError::GivenConflict { .. } => "give other coordinates, or fewer",
        SolveError::DegenerateGeometry { fault: Degeneracy::NegativeLength { .. }, .. } => {
            "other parameters (--set), inputs (--input) or times may give a length that is not negative"
        }
        SolveError::NonFinite { what: "Φ", .. }
        | SolveError::DegenerateContact { .. }
        | SolveError::DegenerateGeometry { .. } => {
            "the equations have no value there: other parameters (--set) or guesses (--guess) may have"
        }
        SolveError::ModeNotAssembled { .. } => {
            "`modes` finds all closures; other dimensions (--set), signs (--mode) or guesses (--guess) may close"
        }
        _ => return Failure::Analysis(named(engine, error)),
    };
    Failure::Analysis(format!("{}\n  {hint}", named(engine, error)))
}

/// An error after the name of the mechanism, unless it begins with that name.
fn named(engine: &dyn Engine, error: &SolveError) -> String {
    let (text, name) = (error.to_string(), engine.model().name);
    let begins = text.strip_prefix(name).is_some_and(|rest| rest.starts_with([':', ' ']));
    if begins { text } else { format!("{name}: {text}") }
}
