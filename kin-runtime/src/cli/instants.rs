//! The instants of a motion: a grid, a list, or up to the limits of the mechanism.

use super::engine::{Arc, Engine};
use super::failure::{Failure, Ledger};
use super::limit_search::{Sought, Stop, is_limit, limit};
use super::setup::Setup;
use super::turns::{natural_end, speed, turn};
use super::values::{self, TimeOrAngle};
use crate::model::Model;
use crate::observer::Reached;
use crate::present::number::rounded;
use std::ops::ControlFlow;

/// The instants of a motion.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct GridArgs {
    /// The first instant, or `limit` [default: 0]
    #[arg(
        long,
        value_name = "A",
        long_help = "\
The first instant, 0 by default. `limit` is the limit that the mechanism
reaches when time runs backwards from 0, or from --to if that is earlier"
    )]
    from: Option<String>,
    /// The last instant, or `limit`
    #[arg(long, value_name = "B")]
    to: Option<String>,
    /// Number of steps; N steps are N + 1 instants
    #[arg(long, value_name = "N")]
    steps: Option<String>,
    /// The instants one by one, in place of --from, --to and --steps
    #[arg(long, value_name = "T1,T2,…")]
    times: Option<String>,
}

impl GridArgs {
    /// Whether any of these options is given.
    pub(super) const fn is_given(&self) -> bool {
        self.from.is_some() || self.to.is_some() || self.steps.is_some() || self.times.is_some()
    }

    /// The requested instants; `steps` is the default number of steps.
    pub(super) fn requested(&self, steps: usize, model: &Model) -> Result<RequestedInstants, Failure> {
        let mut ledger = Ledger::default();
        let end = |option: &str, text: &Option<String>| {
            text.as_deref().map(|t| MotionEnd::read(option, t, model)).transpose()
        };
        if let Some(times) = &self.times {
            let other_options = [("--from", &self.from), ("--to", &self.to), ("--steps", &self.steps)];
            for (name, _) in other_options.into_iter().filter(|(_, value)| value.is_some()) {
                ledger.fault("--times", format!("cannot be combined with {name}; use one or the other"));
            }
            let times = ledger.take(values::times("--times", times, model));
            return ledger.close(times.map(RequestedInstants::Times));
        }
        let from = ledger.take(end("--from", &self.from)).flatten().unwrap_or(MotionEnd::At(TimeOrAngle::At(0.0)));
        let to = ledger.take(end("--to", &self.to)).flatten();
        let steps = match &self.steps {
            Some(text) => ledger.take(values::steps(text)),
            None => Some(steps),
        };
        if let (MotionEnd::At(TimeOrAngle::At(from)), Some(MotionEnd::At(TimeOrAngle::At(to))), Some(steps)) =
            (from, to, steps)
        {
            ledger.take(values::grid_is_possible(from, to, steps));
        }
        ledger.close(steps.map(|steps| RequestedInstants::Grid { from, to, steps }))
    }
}

/// How a motion continues where the driver can go no further.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct ArcArgs {
    /// Go on through dead centres, where the driver turns back: the whole curve
    #[arg(
        long,
        long_help = "\
Go on through dead centres, where the driver turns back and the mechanism goes
on into its other closure, until the motion is where it began. Rows are equally
spaced along the arc. With --to t stays between --from and --to"
    )]
    along_arc: bool,
}

impl ArcArgs {
    /// The requested instants, along the arc if the option is given.
    pub(super) fn applied_to(self, requested: RequestedInstants) -> Result<RequestedInstants, Failure> {
        let refuse = |message: &str| Err(Failure::option("--along-arc", message));
        match requested {
            requested if !self.along_arc => Ok(requested),
            RequestedInstants::Grid { from: MotionEnd::At(from), to: None, steps } => {
                Ok(RequestedInstants::Arc { from, to: None, steps })
            }
            RequestedInstants::Grid { from: MotionEnd::At(from), to: Some(MotionEnd::At(to)), steps } => {
                Ok(RequestedInstants::Arc { from, to: Some(to), steps })
            }
            RequestedInstants::Grid { .. } => {
                refuse("goes on through limits; leave `--to limit` and `--from limit` out")
            }
            RequestedInstants::Times(_) | RequestedInstants::Arc { .. } => {
                refuse("has instants of its own; use --from, --to and --steps in place of --times")
            }
        }
    }
}

/// Where a motion begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum MotionEnd {
    At(TimeOrAngle),
    /// Where the mechanism can go no further.
    Limit,
}

impl MotionEnd {
    fn read(option: &str, text: &str, model: &Model) -> Result<Self, Failure> {
        match text.trim() {
            "limit" => Ok(Self::Limit),
            _ => values::moment(option, text, model).map(Self::At),
        }
    }
}

/// The instants that the options specify.
#[derive(Clone, Debug)]
pub(super) enum RequestedInstants {
    Times(Vec<TimeOrAngle>),
    Grid {
        from: MotionEnd,
        /// Without an end the motion takes one turn of the driven crank, or one unit of time.
        to: Option<MotionEnd>,
        steps: usize,
    },
    /// Along the arc of the solution curve, until it closes or t leaves the interval.
    Arc {
        from: TimeOrAngle,
        to: Option<TimeOrAngle>,
        steps: usize,
    },
}

/// The instants of a motion, and what ends it.
#[derive(Clone, Debug, Default)]
pub(super) struct Instants {
    /// The instants that are solved, without limits at the ends.
    pub(super) times: Vec<f64>,
    /// The index in `times` of the instant at which the mechanism is assembled: the motion is followed from there in
    /// both directions.
    pub(super) start: usize,
    /// The limits at the beginning and at the end of the motion.
    pub(super) limits: [Option<Stop>; 2],
    /// Notes about ends for which a limit was requested and none was found.
    pub(super) notes: Vec<String>,
    /// The arc that is followed in place of all of these.
    pub(super) arc: Option<Arc>,
}

impl Instants {
    /// Instants that are all solved, without limits.
    fn plain(times: Vec<f64>) -> Self {
        Self { times, ..Self::default() }
    }

    /// How many there are, limits included.
    pub(super) fn len(&self) -> usize {
        let limits = self.limits.iter().flatten().filter(|stop| stop.q.is_some());
        self.arc.map_or(self.times.len() + limits.count(), |arc| arc.steps + 1)
    }
}

impl RequestedInstants {
    /// The time at which inputs and prescribed coordinates have their values, if it is not the first instant: 0 for a motion
    /// that begins at a limit, whose time is not known.
    pub(super) fn since(&self) -> Option<f64> {
        matches!(self, Self::Grid { from: MotionEnd::Limit, .. }).then_some(0.0)
    }

    /// Whether no end is given.
    pub(super) fn is_open(&self) -> bool {
        matches!(self, Self::Grid { to: None, .. })
    }

    /// The instant at which the mechanism is assembled. If the motion begins at a limit, it is followed backwards from
    /// there: from t = 0, which the guesses describe, or if it does not close there from another instant.
    pub(super) fn first(&self, engine: &dyn Engine, setup: &Setup) -> Result<f64, Failure> {
        let at = |option: &str, moment: &TimeOrAngle| instant(option, *moment, engine, setup);
        match self {
            Self::Times(times) => times.first().map_or(Ok(0.0), |moment| at("--times", moment)),
            Self::Grid { from: MotionEnd::At(from), .. } | Self::Arc { from, .. } => at("--from", from),
            Self::Grid { from: MotionEnd::Limit, to: Some(MotionEnd::At(to)), .. } => {
                let to = at("--to", to)?;
                Ok(closing(engine, setup, [to.min(0.0), to]))
            }
            Self::Grid { from: MotionEnd::Limit, .. } => {
                let either_way = (-4..=6).flat_map(|power| [1.0, -1.0].map(|sign| sign * 2_f64.powi(power)));
                Ok(closing(engine, setup, std::iter::once(0.0).chain(either_way)))
            }
        }
    }

    /// The instants. Without an end the motion takes one turn of the driven crank, or one unit of time.
    pub(super) fn instants(&self, engine: &dyn Engine, setup: &Setup) -> Result<Instants, Failure> {
        let at = |option: &str, moment: &TimeOrAngle| instant(option, *moment, engine, setup);
        let grid = |from: f64, to: f64, steps: usize| values::grid(from, to, steps).map(Instants::plain);
        match self {
            Self::Times(moments) => {
                let times: Vec<f64> = moments.iter().map(|moment| at("--times", moment)).collect::<Result<_, _>>()?;
                match times.windows(2).find(|pair| pair[0] == pair[1]) {
                    Some(pair) => Err(values::given_twice("--times", &rounded(pair[0]))),
                    None => Ok(Instants::plain(times)),
                }
            }
            Self::Grid { from: MotionEnd::At(from), to, steps } => {
                let from = at("--from", from)?;
                match to {
                    None => match open_end(engine, setup, from, *steps) {
                        Some(to) => grid(from, to, *steps),
                        None => as_far(engine, setup, (from, [Some(from), None]), *steps),
                    },
                    Some(MotionEnd::At(to)) => grid(from, at("--to", to)?, *steps),
                    Some(MotionEnd::Limit) => as_far(engine, setup, (from, [Some(from), None]), *steps),
                }
            }
            Self::Grid { from: MotionEnd::Limit, to, steps } => {
                let start = self.first(engine, setup)?;
                // Before t = 0 a motion starts at its end.
                let starts_elsewhere = start > 0.0 || start < 0.0 && !matches!(to, Some(MotionEnd::At(_)));
                let note =
                    format!("note: it does not close at t = 0: the motion is that through t = {}", rounded(start));
                let to = match to {
                    Some(MotionEnd::At(to)) => Some(at("--to", to)?),
                    Some(MotionEnd::Limit) => None,
                    None => open_end(engine, setup, start, *steps),
                };
                let mut found = as_far(engine, setup, (start, [None, to]), *steps)?;
                found.notes.extend(starts_elsewhere.then_some(note));
                Ok(found)
            }
            Self::Arc { from, to, steps } => {
                let (from, to) = (at("--from", from)?, to.as_ref().map(|to| at("--to", to)).transpose()?);
                values::grid_is_possible(from, to.unwrap_or(from + 1.0), *steps)?;
                Ok(Instants { arc: Some(Arc { from, to, steps: *steps }), ..Instants::default() })
            }
        }
    }
}

/// The end of a motion whose end is not given: after one turn of the driven crank, or after one unit of time; `None`
/// for the limit of the motion if it is met in the first step on the way there.
fn open_end(engine: &dyn Engine, setup: &Setup, from: f64, steps: usize) -> Option<f64> {
    let to = natural_end(engine, setup, from);
    let go_on = |_: Reached<'_>| ControlFlow::Continue(());
    let first = [from, from + (to - from) / steps.max(1) as f64];
    let (trajectory, error) = engine.sweep_each(setup, &first, false, &go_on, &mut |_| ControlFlow::Continue(()));
    let is_limited = error.as_ref().is_some_and(is_limit);
    (!is_limited || trajectory.reached == 0).then_some(to)
}

/// The time of an instant; for an angle, the time at which the driven crank has turned by it.
pub(super) fn instant(option: &str, moment: TimeOrAngle, engine: &dyn Engine, setup: &Setup) -> Result<f64, Failure> {
    match moment {
        TimeOrAngle::At(t) => Ok(t),
        TimeOrAngle::Turned(angle) => speed(engine, setup, 0.0).map(|speed| angle / speed).ok_or_else(|| {
            let message = "an angle says when only if a crank is driven at constant speed; write a time";
            Failure::option(option, message)
        }),
    }
}

/// The first of some instants at which the mechanism closes; the first of all if it closes at none, whose error says
/// why.
fn closing(engine: &dyn Engine, setup: &Setup, instants: impl IntoIterator<Item = f64>) -> f64 {
    let mut instants = instants.into_iter().peekable();
    let first = instants.peek().copied().unwrap_or(0.0);
    instants.find(|t| engine.state(setup, *t).is_ok()).unwrap_or(first)
}

/// An instant of a motion that is nearer to its start than this, relative to its length, is the start.
const SAME_INSTANT: f64 = 1e-9;

/// The instants of a motion through `start`; an end that is `None` is at the limit of the motion in that direction. The
/// distance of an instant from a limit grows with the square of its number from there: close to a dead centre
/// coordinates change with the square root of the remaining time, so that curves through these instants end smoothly.
fn as_far(
    engine: &dyn Engine,
    setup: &Setup,
    (start, ends): (f64, [Option<f64>; 2]),
    steps: usize,
) -> Result<Instants, Failure> {
    values::grid_is_possible(0.0, 1.0, steps)?;
    let mut out = Instants::default();
    let (mut times, mut whole) = ([start; 2], [false; 2]);
    for (k, end) in ends.into_iter().enumerate() {
        if let Some(t) = end {
            times[k] = t;
            continue;
        }
        let direction = [-1.0, 1.0][k];
        match limit(engine, setup, start, direction)? {
            Sought::Found(stop) => {
                times[k] = stop.t;
                out.limits[k] = Some(stop);
            }
            Sought::None(searched) => {
                let turn_time = turn(engine, setup, start);
                times[k] = start + direction * turn_time.unwrap_or(1.0);
                whole[k] = turn_time.is_some();
                let until = rounded(searched);
                out.notes.push(match whole[k] {
                    true => {
                        let turns = ((searched - start) * direction / turn_time.unwrap_or(f64::INFINITY)).round();
                        let turns = if turns > 1.0 { format!("{turns} turns") } else { "a turn".to_owned() };
                        format!("note: no limit is met in {turns} of the driven crank: the motion is one turn long")
                    }
                    false => {
                        format!("note: no limit is met up to t = {until}: the motion ends at t = {}", rounded(times[k]))
                    }
                });
            }
        }
    }
    // If neither direction has a limit, the motion is one turn of the crank, not two.
    if whole == [true; 2] {
        times[0] = start;
        out.notes.truncate(1);
    }
    let [from, to] = times;
    if from == to {
        let message = format!("the mechanism is at a limit at t = {}: there is no motion", rounded(from));
        return Err(Failure::Analysis(format!("{}: {message}", engine.model().name)));
    }
    let place = |k: usize| {
        let x = k as f64 / steps as f64;
        let share = match [&out.limits[0], &out.limits[1]] {
            [None, None] => x,
            [None, Some(_)] => 1.0 - (1.0 - x).powi(2),
            [Some(_), None] => x.powi(2),
            [Some(_), Some(_)] => 0.5 * (1.0 - (std::f64::consts::PI * x).cos()),
        };
        from + share * (to - from)
    };
    let first = usize::from(out.limits[0].is_some());
    let last = steps - usize::from(out.limits[1].is_some());
    let mut times: Vec<f64> = (first..=last).map(|k| if k == steps { to } else { place(k) }).collect();
    // The motion is followed from the start in both directions. The start is therefore one of the instants; it takes
    // the place of the nearest one that has others on both sides, which stay between the start and the ends.
    let distance = |k: &usize| (times[*k] - start).abs();
    let inner = 1..times.len().saturating_sub(1);
    let mut behind = match inner.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
        Some(nearest) if start != from && start != to => {
            times[nearest] = start;
            if times[nearest - 1] >= start {
                times[nearest - 1] = 0.5 * (from + start);
            }
            if times[nearest + 1] <= start {
                times[nearest + 1] = 0.5 * (start + to);
            }
            nearest
        }
        _ => {
            let is_same = |t: &f64| (t - start).abs() <= SAME_INSTANT * (to - from).abs();
            let behind = times.iter().position(|t| is_same(t) || *t >= start).unwrap_or(times.len());
            if !times.get(behind).is_some_and(is_same) {
                times.insert(behind, start);
            }
            times[behind] = start;
            behind
        }
    };
    // Even with few steps, there is an instant between the start and a limit on either side.
    if out.limits[0].is_some() && behind == 0 && from < start {
        times.insert(0, 0.5 * (from + start));
        behind = 1;
    }
    if out.limits[1].is_some() && behind + 1 == times.len() && start < to {
        times.push(0.5 * (start + to));
    }
    Ok(Instants { times, start: behind, ..out })
}
