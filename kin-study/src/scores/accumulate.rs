//! Scores accumulated in lanes, instant after instant.

use super::reporter::Reporter;
use super::score::{Measure, Score};
use crate::suggest::unknown;
use kin_runtime::batch::Moment;
use kin_runtime::{Lanes, Mechanism, Scalar};

/// How a score is accumulated; a variant says what its state holds.
#[derive(Clone, Debug)]
enum Rule {
    /// The least or greatest value so far.
    Least,
    Greatest,
    /// The sum so far.
    Mean,
    /// The least and the greatest value so far.
    Range,
    /// The least or greatest value so far, and its instant.
    TimeOfLeast,
    TimeOfGreatest,
    /// The value at the instant with this index.
    At(usize),
    /// For every given point, the square of its least distance so far. The quantity after that of x is y.
    Distance(Vec<[f64; 2]>, Measure),
    /// x and y at all instants, whose number this is.
    Path(usize),
}

impl Rule {
    /// The initial values of its state.
    fn start(&self) -> Vec<f64> {
        match self {
            Self::Least => vec![f64::INFINITY],
            Self::Greatest => vec![f64::NEG_INFINITY],
            Self::Mean | Self::At(_) => vec![0.0],
            Self::Range => vec![f64::INFINITY, f64::NEG_INFINITY],
            Self::TimeOfLeast => vec![f64::INFINITY, f64::NAN],
            Self::TimeOfGreatest => vec![f64::NEG_INFINITY, f64::NAN],
            Self::Distance(points, _) => vec![f64::INFINITY; points.len()],
            Self::Path(instants) => vec![f64::NAN; 2 * instants],
        }
    }
}

/// The accumulated state of a block.
pub(crate) type Gathering = Box<[Lanes]>;

/// A score of the study: its rule, and the indices of its quantity and of its first number in the state of a block.
#[derive(Clone, Debug)]
struct Gathered {
    rule: Rule,
    quantity: usize,
    state: usize,
}

/// All scores of a study, for one motion.
pub(crate) struct Scoring<M> {
    reporter: Reporter<M>,
    scores: Vec<Gathered>,
    instants: usize,
    state: usize,
}

impl<M: Mechanism + 'static> Scoring<M> {
    /// The scores over a motion with these instants; an error has the index of its score.
    pub(crate) fn new(scores: &[&Score], times: &[f64]) -> Result<Self, (usize, String)> {
        let mut names: Vec<String> = Vec::new();
        let mut gathered = Vec::with_capacity(scores.len());
        // The least margin comes before all scores.
        let mut state = 1;
        for (place, score) in scores.iter().enumerate() {
            let quantity = names.len();
            let rule = rule::<M>(score, times, &mut names).map_err(|message| (place, message))?;
            Reporter::<M>::new(&[names[quantity].as_str()]).map_err(|message| (place, message))?;
            gathered.push(Gathered { quantity, state, rule });
            state += gathered.last().map_or(0, |score| score.rule.start().len());
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let reporter = Reporter::new(&names).map_err(|message| (0, message))?;
        Ok(Self { reporter, scores: gathered, instants: times.len(), state })
    }

    /// The initial state of a block.
    pub(crate) fn start(&self) -> Gathering {
        let rules = self.scores.iter().flat_map(|score| score.rule.start());
        let numbers: Box<[Lanes]> = std::iter::once(f64::INFINITY).chain(rules).map(Lanes::from).collect();
        debug_assert_eq!(numbers.len(), self.state);
        numbers
    }

    /// Adds a block of sets at one instant. What lanes accumulate after the end of their motion is not used.
    #[inline]
    pub(crate) fn visit(&self, mechanism: &M, gathering: &mut [Lanes], moment: &Moment<'_>) {
        let mut room = self.reporter.evaluates().then(|| self.reporter.room());
        if let Some(room) = &mut room {
            self.reporter.evaluate(mechanism, moment, room);
        }
        gathering[0] = least(gathering[0], moment.margin);
        for score in &self.scores {
            let value = self.reporter.value(score.quantity, room.as_deref(), moment);
            let state = &mut gathering[score.state..];
            match &score.rule {
                Rule::Least => state[0] = least(state[0], value),
                Rule::Greatest => state[0] = greatest(state[0], value),
                Rule::Mean => state[0] = state[0] + value,
                Rule::Range => (state[0], state[1]) = (least(state[0], value), greatest(state[1], value)),
                Rule::TimeOfLeast => first(state, value, moment.t, |new, old| new < old),
                Rule::TimeOfGreatest => first(state, value, moment.t, |new, old| new > old),
                Rule::At(instant) if *instant == moment.instant => state[0] = value,
                Rule::At(_) => {}
                Rule::Distance(points, _) => {
                    let y = self.reporter.value(score.quantity + 1, room.as_deref(), moment);
                    for (square, point) in state.iter_mut().zip(points) {
                        let [dx, dy] = [value - Lanes::from(point[0]), y - Lanes::from(point[1])];
                        *square = least(*square, dx * dx + dy * dy);
                    }
                }
                Rule::Path(_) => {
                    let y = self.reporter.value(score.quantity + 1, room.as_deref(), moment);
                    state[2 * moment.instant..][..2].copy_from_slice(&[value, y]);
                }
            }
        }
        if let Some(room) = room {
            Reporter::keep(room);
        }
    }

    /// The least margin of a block over all instants.
    pub(crate) fn margin(&self, gathering: &[Lanes]) -> Lanes {
        gathering[0]
    }

    /// x and y at all instants, one after another, if the score at this index is a path.
    pub(crate) fn path<'g>(&self, place: usize, gathering: &'g [Lanes]) -> Option<&'g [Lanes]> {
        match self.scores[place] {
            Gathered { rule: Rule::Path(instants), state, .. } => Some(&gathering[state..][..2 * instants]),
            _ => None,
        }
    }

    /// The score at this index, of a block whose motion is complete.
    pub(crate) fn score(&self, place: usize, gathering: &[Lanes]) -> Lanes {
        let Gathered { rule, state: first, .. } = &self.scores[place];
        let state = &gathering[*first..];
        match rule {
            Rule::Least | Rule::Greatest | Rule::At(_) | Rule::Path(_) => state[0],
            Rule::Mean => state[0] / Lanes::from(self.instants as f64),
            Rule::Range => state[1] - state[0],
            Rule::TimeOfLeast | Rule::TimeOfGreatest => state[1],
            Rule::Distance(points, measure) => {
                let squares = &state[..points.len()];
                let square = match measure {
                    Measure::Greatest => squares.iter().copied().fold(Lanes::from(0.0), greatest),
                    Measure::RootMeanSquare => {
                        let sum = squares.iter().fold(Lanes::from(0.0), |sum, square| sum + *square);
                        sum / Lanes::from(points.len() as f64)
                    }
                };
                square.sqrt()
            }
        }
    }
}

/// The rule of a score; the names of its quantities are added to the list.
fn rule<M: Mechanism>(score: &Score, times: &[f64], names: &mut Vec<String>) -> Result<Rule, String> {
    let (quantity, rule) = match score {
        Score::Least(quantity) => (quantity, Rule::Least),
        Score::Greatest(quantity) => (quantity, Rule::Greatest),
        Score::Mean(quantity) => (quantity, Rule::Mean),
        Score::Range(quantity) => (quantity, Rule::Range),
        Score::TimeOfLeast(quantity) => (quantity, Rule::TimeOfLeast),
        Score::TimeOfGreatest(quantity) => (quantity, Rule::TimeOfGreatest),
        Score::At { of: quantity, t } => (quantity, Rule::At(instant(times, *t)?)),
        Score::Path { point, .. } => {
            names.extend(coordinates::<M>(point)?);
            return Ok(Rule::Path(times.len()));
        }
        Score::Distance { point, to, measure } => {
            if to.is_empty() || !to.as_flattened().iter().all(|number| number.is_finite()) {
                return Err("a distance needs at least one point, and finite numbers".to_owned());
            }
            names.extend(coordinates::<M>(point)?);
            return Ok(Rule::Distance(to.clone(), *measure));
        }
    };
    names.push(quantity.clone());
    Ok(rule)
}

/// The names of the coordinates of a point.
fn coordinates<M: Mechanism>(point: &str) -> Result<[String; 2], String> {
    let points = M::model().points;
    match points.iter().any(|known| known.name == point) {
        true => Ok(["x", "y"].map(|axis| format!("{point}.{axis}"))),
        false => Err(unknown("point", point, points.iter().map(|known| known.name))),
    }
}

/// The index of an instant, which must be one of those of the motion to within rounding.
fn instant(times: &[f64], t: f64) -> Result<usize, String> {
    let away = |place: &usize| (times[*place] - t).abs();
    let nearest = (0..times.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
    let span = times.iter().fold(1e-300_f64, |most, t| most.max(t.abs()));
    match nearest {
        Some(place) if away(&place) <= 1e-9 * span => Ok(place),
        Some(place) => Err(format!("t = {t} is none of the instants; the nearest is t = {}", times[place])),
        None => Err("the motion has no instants".to_owned()),
    }
}

/// The lesser of two numbers, lane by lane; the first if the second is NaN.
#[inline(always)]
fn least(old: Lanes, new: Lanes) -> Lanes {
    let (old, new) = (old.to_array(), new.to_array());
    Lanes::generate(|lane| if new[lane] < old[lane] { new[lane] } else { old[lane] })
}

/// The greater of two numbers, lane by lane; the first if the second is NaN.
#[inline(always)]
fn greatest(old: Lanes, new: Lanes) -> Lanes {
    let (old, new) = (old.to_array(), new.to_array());
    Lanes::generate(|lane| if new[lane] > old[lane] { new[lane] } else { old[lane] })
}

/// Replaces the value in the state and its instant in the lanes in which the new value is better.
#[inline(always)]
fn first(state: &mut [Lanes], value: Lanes, t: f64, better: impl Fn(f64, f64) -> bool) {
    let (new, old, at) = (value.to_array(), state[0].to_array(), state[1].to_array());
    let is_better: [bool; Lanes::COUNT] = std::array::from_fn(|lane| better(new[lane], old[lane]));
    state[0] = Lanes::generate(|lane| if is_better[lane] { new[lane] } else { old[lane] });
    state[1] = Lanes::generate(|lane| if is_better[lane] { t } else { at[lane] });
}
