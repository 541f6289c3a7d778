//! The only module that is generic over the mechanism: motions of many sets of dimensions, scored in lanes.

use crate::error::StudyError;
use crate::fingerprint::fingerprint;
use crate::sampling::Range;
use crate::scores::{Gathering, Score, Scoring, normalise};
use crate::study::{Closures, Ramp, Study};
use crate::suggest::unknown;
use kin_runtime::batch::{BatchError, Column, End, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::model::Model;
use kin_runtime::{Instant, Lanes, Mechanism, Sign, Signal, Solver};
use std::fmt;

/// Largest number of modes whose combinations are all computed: 2¹² rows for every set of dimensions.
const MODES: usize = 12;

/// A mechanism whose motions are computed for many sets of dimensions at once.
pub(crate) trait Machine: Send + Sync {
    /// The mechanism's tables.
    fn model(&self) -> &'static Model;

    /// Sweeps `count` sets of dimensions over all instants. `signs` has a column for every mode of the plan; the signs
    /// of a set are one of the combinations in [`Motion::modes`].
    fn sweep(&self, parameters: &[Column<'_>], signs: &[Column<'_>], count: usize) -> Result<Scored, BatchError>;
}

/// What is kept of the motions of many sets of dimensions.
pub(crate) struct Scored {
    /// For every score, its values for all sets; the value of a set that ended early is meaningless.
    pub(crate) scores: Vec<Values>,
    /// For every set, the least margin of its motion; for a set that ended early, the margin at its end.
    pub(crate) margins: Vec<f64>,
    /// For every set, where its motion ended, if it ended early.
    pub(crate) ends: Vec<Option<End>>,
}

/// The values of a score for all sets.
pub(crate) enum Values {
    /// A number each.
    Numbers(Vec<f64>),
    /// A list of this length each, one set after another.
    Lists(usize, Vec<f32>),
}

/// What all motions of a study have in common.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// The instants.
    pub(crate) times: Vec<f64>,
    /// The default values of all parameters, with the fixed values of the study.
    pub(crate) defaults: Vec<f64>,
    /// Combinations of signs, each with its name.
    pub(crate) modes: Vec<(String, Vec<f64>)>,
    /// The [`fingerprint`] of the mechanism.
    pub(crate) fingerprint: u64,
}

struct Bound<M> {
    mechanism: M,
    times: Vec<f64>,
    inputs: Vec<Signal<f64>>,
    start: Vec<f64>,
    scoring: Scoring<M>,
    scores: Vec<Score>,
}

/// The mechanism of a study, and what its motions have in common.
pub(crate) fn bind<M>(study: &Study) -> Result<(Box<dyn Machine>, Motion), StudyError>
where
    M: Mechanism + Default + Send + Sync + 'static,
{
    let model = M::model();
    if let Some(why) = model.plan.absent {
        return Err(BatchError::NoPlan(why).into());
    }
    let mut mechanism = M::default();
    for (name, range) in &study.parameters {
        let place = model.parameters.iter().position(|parameter| parameter.name == name);
        if let (Range::Fixed(value), Some(place)) = (range, place) {
            mechanism.set_parameter(place, *value);
        }
    }
    let times = study.times.clone();
    if times.is_empty() || times.iter().any(|t| !t.is_finite()) {
        let message = "a motion needs instants: write `[motion]` with `to` and `steps`, or with `times`";
        return Err(StudyError::description(message).on_line(study.line("motion")));
    }
    let inputs = inputs(model, study)?;
    let scores: Vec<&Score> = study.scores.iter().map(|(_, score)| score).collect();
    let scoring = Scoring::new(&scores, &times).map_err(|(place, message)| {
        let name = study.scores.get(place).map_or("", |(name, _)| name.as_str());
        StudyError::description(message).on_line(study.line(&format!("scores.{name}")))
    })?;
    let (start, modes) = starts(&mechanism, study, &Instant { t: times[0], inputs: &inputs[..M::INPUTS] })?;
    let defaults = mechanism.parameters::<f64>().as_ref().to_vec();
    let motion = Motion { times: times.clone(), defaults, modes, fingerprint: fingerprint(&mechanism) };
    let scores = scores.into_iter().cloned().collect();
    Ok((Box::new(Bound { mechanism, times, inputs, start, scoring, scores }), motion))
}

/// All inputs at every instant, one instant after another.
fn inputs(model: &Model, study: &Study) -> Result<Vec<Signal<f64>>, StudyError> {
    let times = &study.times;
    let (first, last) = (times[0], times[times.len() - 1]);
    for (name, _) in &study.inputs {
        if !model.inputs.contains(&name.as_str()) {
            let message = unknown("input", name, model.inputs.iter().copied());
            return Err(StudyError::description(message).on_line(study.line(&format!("motion.inputs.{name}"))));
        }
    }
    let mut ramps = Vec::new();
    for (place, name) in model.inputs.iter().enumerate() {
        let given = study.inputs.iter().find(|(known, _)| known == name).map(|(_, ramp)| *ramp);
        let default = model.input_defaults.get(place).copied().flatten().map(|value| Ramp { from: value, to: value });
        ramps.push(given.or(default).ok_or_else(|| {
            let message = format!("the input `{name}` needs a value: `inputs = {{ {name} = 0 }}` in `[motion]`");
            StudyError::description(message).on_line(study.line("motion"))
        })?);
    }
    let at = |t: f64| {
        ramps.iter().map(move |ramp| {
            // At a single instant nothing changes.
            let rate = if last == first { 0.0 } else { (ramp.to - ramp.from) / (last - first) };
            Signal::new(ramp.from + rate * (t - first), rate, 0.0)
        })
    };
    Ok(times.iter().flat_map(|t| at(*t)).collect())
}

/// The configuration near which motions start, and the combinations of modes with their names.
type Starts = (Vec<f64>, Vec<(String, Vec<f64>)>);

/// The start of all motions, and the combinations of modes that the study computes.
fn starts<M: Mechanism>(mechanism: &M, study: &Study, at: &Instant<'_>) -> Result<Starts, StudyError> {
    let modes = M::model().plan.modes;
    let wrong = |message: String| StudyError::description(message).on_line(study.line("motion.mode"));
    let solver = Solver::new(mechanism);
    let solved = solver.state(at);
    let start = match &solved {
        Ok(state) => state.q.clone(),
        Err(_) => solver.guess().into_iter().map(|guess| guess.unwrap_or(0.0)).collect(),
    };
    let mut signs: Vec<Option<Sign>> = vec![None; modes.len()];
    if solved.is_ok() {
        let mut branches = vec![0.0; M::model().plan.signs()];
        let parameters = mechanism.parameters::<f64>();
        // All lists have the lengths that the mechanism requires.
        if mechanism.branches_with(parameters.as_ref(), at, &start, &mut branches).is_ok() {
            signs = branches.into_iter().take(modes.len()).map(Sign::of).collect();
        }
    }
    let chosen: &[(String, Sign)] = match &study.modes {
        Closures::All if modes.len() > MODES => {
            return Err(wrong(format!("at most {MODES} modes can be gone through")));
        }
        Closures::All => {
            let sign = |combination: usize, k: usize| if combination >> k & 1 == 0 { Sign::Plus } else { Sign::Minus };
            let each = |combination: usize| (0..modes.len()).map(|k| sign(combination, k)).collect::<Vec<_>>();
            return Ok((start, (0..1_usize << modes.len()).map(|k| named::<M>(&each(k))).collect()));
        }
        Closures::OfGuess => &[],
        Closures::Signs(signs) => signs,
    };
    for (name, sign) in chosen {
        let place = modes.iter().position(|mode| mode.name == name);
        let place = place.ok_or_else(|| wrong(unknown("mode", name, modes.iter().map(|mode| mode.name))))?;
        signs[place] = Some(*sign);
    }
    if let Some(undecided) = signs.iter().position(Option::is_none) {
        let name = modes[undecided].name;
        let why =
            solved.err().map_or_else(String::new, |error| format!(", as the default dimensions do not close: {error}"));
        return Err(wrong(format!(
            "the sign of mode {name} is not determined; write `mode = {{ {name} = \"+\" }}` in `[motion]`{why}"
        )));
    }
    let signs: Vec<Sign> = signs.into_iter().flatten().collect();
    Ok((start, vec![named::<M>(&signs)]))
}

/// A combination of modes with its name.
fn named<M: Mechanism>(signs: &[Sign]) -> (String, Vec<f64>) {
    let names = M::model().plan.modes.iter().zip(signs).map(|(mode, sign)| format!("{}{sign}", mode.name));
    (names.collect::<Vec<_>>().join(" "), signs.iter().map(|sign| sign.value()).collect())
}

impl<M: Mechanism + Send + Sync + 'static> Machine for Bound<M> {
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn sweep(&self, parameters: &[Column<'_>], signs: &[Column<'_>], count: usize) -> Result<Scored, BatchError> {
        let start: Vec<Column<'_>> = self.start.iter().map(|number| Column::Shared(*number)).collect();
        let part = |k: usize, element: fn(&Signal<f64>) -> f64| -> Vec<f64> {
            self.inputs.iter().skip(k).step_by(M::INPUTS.max(1)).map(element).collect()
        };
        let numbers: Vec<[Vec<f64>; 3]> =
            (0..M::INPUTS).map(|k| [part(k, |u| u.value), part(k, |u| u.rate), part(k, |u| u.acceleration)]).collect();
        let inputs: Vec<Signal<Column<'_>>> = numbers
            .iter()
            .map(|[value, rate, acceleration]| Signal {
                value: Column::Each(value),
                rate: Column::Each(rate),
                acceleration: Column::Each(acceleration),
            })
            .collect();
        let sweeps =
            Sweeps { parameters, times: &self.times, inputs: &inputs, modes: Modes::Signs(signs), start: &start };
        let mut out = Motions::new(count, self.scoring.start());
        let scoring = &self.scoring;
        sweep(&self.mechanism, &sweeps, &mut out, &always, |gathering: &mut Gathering, moment| {
            scoring.visit(&self.mechanism, gathering, moment);
        })?;
        let values = |(place, score): (usize, &Score)| match score {
            Score::Path { normalised, .. } => self.paths(&out, place, *normalised),
            _ => Values::Numbers(out.scores(|gathering| scoring.score(place, gathering)).collect()),
        };
        let scores = self.scores.iter().enumerate().map(values).collect();
        let ends: Vec<Option<End>> = out.ends().collect();
        let least = out.scores(|gathering| scoring.margin(gathering));
        let margins = least.zip(&ends).map(|(least, end)| end.as_ref().map_or(least, |end| end.margin)).collect();
        Ok(Scored { scores, margins, ends })
    }
}

impl<M: Mechanism + 'static> Bound<M> {
    /// The paths that a score keeps.
    fn paths(&self, out: &Motions<Gathering>, place: usize, normalised: bool) -> Values {
        let width = 2 * self.times.len();
        let mut lists = Vec::with_capacity(width * out.count());
        let mut path = vec![0.0; width];
        for (block, gathering) in out.blocks().enumerate() {
            let Some(lanes) = self.scoring.path(place, gathering) else { continue };
            for lane in 0..Lanes::COUNT.min(out.count() - block * Lanes::COUNT) {
                path.iter_mut().zip(lanes).for_each(|(number, lanes)| *number = lanes.to_array()[lane]);
                if normalised {
                    normalise(&mut path);
                }
                lists.extend(path.iter().map(|number| *number as f32));
            }
        }
        Values::Lists(width, lists)
    }
}

impl fmt::Debug for dyn Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.model().name)
    }
}
