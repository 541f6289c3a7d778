//! Ranges of motion where every group has a closed form: the plan over intervals of t.

use super::super::any_solver::AnySolver;
use super::super::assemblies::half_turns;
use super::super::choices::add_new;
use super::driven;
use crate::error::SolveError;
use crate::model::Model;
use crate::plan::{Depth, Plan, Solved};
use crate::planned::{Limit, LimitKind, Sign, Step};
use crate::proof::{MarginSign, Stretch, Winding, refined, stretches};
use crate::ranges::{Range, RangeLimit, Ranges};
use crate::scalar::Interval;
use crate::signal::{Instant, Signal};

/// Smallest width of an undecided stretch, and of a stretch with a limit, relative to the whole interval of t.
const MIN_WIDTHS: [f64; 2] = [1e-8, 1e-12];
/// Largest number of stretches that are examined in one combination of modes, and at one limit.
const MAX_STRETCHES: [usize; 2] = [50_000, 4_000];
/// How far from a limit the motion towards it begins, relative to the range.
const APPROACH: f64 = 1e-2;

impl dyn AnySolver + '_ {
    /// The ranges in all combinations of modes. The plan is evaluated over intervals of t. Where all its margins are
    /// positive on an interval the mechanism closes on all of it, where one is negative it closes nowhere; an interval
    /// for which neither is proven is halved.
    ///
    /// `turning` are the angles of which each whole turn gives another closure, as far as they are known. `None` if it turns
    /// out that signs do not distinguish all closures.
    ///
    /// # Errors
    /// If a length is negative in a range.
    pub(super) fn ranges_by_plan(
        &self,
        from: &Instant<'_>,
        to: f64,
        guess: &[f64],
        mut turning: Vec<usize>,
    ) -> Result<Option<Ranges>, SolveError> {
        let plan = &self.model().plan;
        let way = [from.t.min(to), from.t.max(to)];
        let narrowest = MIN_WIDTHS.map(|narrowest| narrowest * (way[1] - way[0]));
        let mut all = Collected { ranges: Vec::new(), limits: Vec::new() };
        for code in 0..1_usize << plan.modes.len() {
            let signs: Vec<f64> =
                (0..plan.modes.len()).map(|index| if code >> index & 1 == 0 { 1.0 } else { -1.0 }).collect();
            let look = &mut |a: f64, b: f64| self.look([a, b], from, &signs, guess);
            let found = stretches(way, narrowest[0], MAX_STRETCHES[0], look);
            let found = refined(&found, narrowest, MAX_STRETCHES[1], look);
            // At the first instant it may not close, and show no choices.
            for stretch in found.iter().filter(|stretch| !matches!(stretch.seen, MarginSign::Unknown(_))) {
                let t = 0.5 * stretch.from + 0.5 * stretch.to;
                let inputs = inputs_after(from, t);
                let at = Instant { t, inputs: &inputs };
                // Where a length changes its sign, closures meet, and a range ends.
                if stretch.seen == MarginSign::Closed {
                    self.equations_at(&at)?;
                }
                let Some(turns) = self.free_turns(&at, &signs, guess) else { return Ok(None) };
                add_new(&mut turning, turns.angles);
            }
            for (index, stretch) in found.iter().enumerate() {
                match stretch.seen {
                    MarginSign::Closed => all.ranges.push((signs.clone(), *stretch)),
                    MarginSign::Open(_) => {}
                    MarginSign::Unknown(margin) => {
                        let neighbours = [index.checked_sub(1).map(|k| found[k]), found.get(index + 1).copied()];
                        all.limits.push(self.limit(from, (&signs, guess), margin, *stretch, neighbours));
                    }
                }
            }
        }
        let middle =
            |signs: &[f64], range: &Stretch| self.near_by_plan(0.5 * range.from + 0.5 * range.to, from, signs, guess);
        let searched = half_turns(self.model(), &turning, guess);
        Ok(Some(Ranges { searched, ..all.finish(self.model(), &middle) }))
    }

    /// What the plan proves for an interval of t, in the modes with these signs. Inputs continue from the instant
    /// `start`.
    pub(in crate::solver) fn look(
        &self,
        way: [f64; 2],
        start: &Instant<'_>,
        signs: &[f64],
        guess: &[f64],
    ) -> MarginSign {
        let Some([q, margins]) = self.enclosed(way, start, signs, guess) else { return MarginSign::Unknown(0) };
        let first = margins.iter().position(|margin| margin.lower() <= Plan::SMALLEST_MARGIN || !margin.is_defined());
        // No margin shows that a formula has no value, as the root of a negative number.
        let without_value = || q.iter().any(|x| !x.is_bounded()).then_some(margins.len());
        let first = first.or_else(without_value);
        // The margin of a later group encloses its values wherever the groups before it close.
        let open = margins.iter().position(|margin| margin.is_defined() && margin.upper() < 0.0);
        match (first, open) {
            (None, _) => MarginSign::Closed,
            (Some(_), Some(margin)) => MarginSign::Open(margin),
            (Some(margin), None) => MarginSign::Unknown(margin),
        }
    }

    /// q and the margins over an interval of t, by the plan with these signs.
    pub(in crate::solver) fn enclosed(
        &self,
        [from, to]: [f64; 2],
        start: &Instant<'_>,
        signs: &[f64],
        guess: &[f64],
    ) -> Option<[Vec<Interval>; 2]> {
        let middle = 0.5 * from + 0.5 * to;
        let number = |x: f64| Winding::of(Interval::from(x));
        let t = Winding::of(Interval::new(from, to));
        let since = t - number(start.t);
        let later = |u: &Signal| u.map(number).after(since);
        let inputs: Vec<Signal<Winding>> = start.inputs.iter().map(later).collect();
        // Angles are those nearest to the configuration in the middle, as far as it exists.
        let near = self.near_by_plan(middle, start, signs, guess);
        let interval = |list: &[f64]| list.iter().copied().map(number).collect::<Vec<_>>();
        let at = Instant { t, inputs: &inputs };
        let all = Winding::of(Interval::ENTIRE);
        let mut lists: [Vec<Winding>; 3] = std::array::from_fn(|_| vec![all; near.len()]);
        let mut margins = vec![all; self.model().plan.margins];
        let [q, q_dot, q_ddot] = &mut lists;
        let solved = Solved { q, q_dot, q_ddot, margins: &mut margins };
        self.solve_over(&at, &interval(signs), &interval(&near), solved).ok()?;
        let [q, ..] = lists;
        Some([q, margins].map(|list| list.into_iter().map(Winding::interval).collect()))
    }

    /// q by the plan; the guess for coordinates for which it has no value.
    fn near_by_plan(&self, t: f64, start: &Instant<'_>, signs: &[f64], guess: &[f64]) -> Vec<f64> {
        let ([mut q, mut q_dot, mut q_ddot], mut margins) = (self.zeros(), vec![0.0; self.model().plan.margins]);
        let solved = Solved { q: &mut q, q_dot: &mut q_dot, q_ddot: &mut q_ddot, margins: &mut margins };
        let inputs = inputs_after(start, t);
        let outcome = self.solve(&Instant { t, inputs: &inputs }, signs, guess, Depth::Position, solved);
        let found = q.iter().zip(guess).map(|(&x, &guess)| if x.is_finite() { x } else { guess });
        if outcome.is_ok() { found.collect() } else { guess.to_vec() }
    }

    /// The limit in a stretch where a margin changes its sign, or touches 0; its configuration is found by the motion
    /// towards it from a neighbour in which the mechanism closes.
    fn limit(
        &self,
        start: &Instant<'_>,
        (signs, guess): (&[f64], &[f64]),
        margin: usize,
        stretch: Stretch,
        neighbours: [Option<Stretch>; 2],
    ) -> FoundLimit {
        let closed = |side: &Option<Stretch>| side.filter(|stretch| stretch.seen == MarginSign::Closed);
        let open = |side: &Option<Stretch>| matches!(side, Some(Stretch { seen: MarginSign::Open(_), .. }));
        let [before, after] = neighbours;
        let proven = (closed(&before).is_some() && open(&after)) || (open(&before) && closed(&after).is_some());
        let (inside, beyond) = match (closed(&before), closed(&after)) {
            (Some(range), _) => {
                (range.to - APPROACH * (range.to - range.from), after.map_or(stretch.to, |side| side.to))
            }
            (None, Some(range)) => {
                (range.from + APPROACH * (range.to - range.from), before.map_or(stretch.from, |side| side.from))
            }
            (None, None) => (stretch.from, stretch.from),
        };
        let (limit, q) = self.approached(start, signs, [inside, beyond]);
        let within = |limit: &Limit| {
            let slack = 1e-6 * (1.0 + stretch.to.abs());
            limit.at().is_some_and(|at| at >= stretch.from - slack && at <= stretch.to + slack)
        };
        let found = limit.filter(within);
        let q = if found.is_some() { q } else { Vec::new() };
        // Where a margin changes its sign the limit is a fold, even if the motion towards it did not find its kind; where it
        // is undefined, it may jump.
        let all = self.enclosed([stretch.from, stretch.to], start, signs, guess);
        let is_defined = all.is_some_and(|[_, margins]| margins.get(margin).is_some_and(|margin| margin.is_defined()));
        let is_fold = proven && is_defined;
        let kind = found.and_then(|limit| limit.kind()).or(is_fold.then_some(LimitKind::DeadCentre));
        FoundLimit { signs: signs.to_vec(), margin, stretch, kind, q, proven, is_fold }
    }

    /// The limit that ends a motion in these modes, and the configuration there.
    fn approached(&self, start: &Instant<'_>, signs: &[f64], way: [f64; 2]) -> (Option<Limit>, Vec<f64>) {
        let modes = signs.iter().enumerate().filter_map(|(index, &sign)| Some((index, Sign::of(sign)?)));
        match self.moved(start, way, &self.settings().guesses, &modes.collect::<Vec<_>>()) {
            Ok(_) => (None, Vec::new()),
            Err(end) => (end.limit, end.q),
        }
    }
}

/// The inputs of an instant, continued to a time with constant acceleration.
fn inputs_after(start: &Instant<'_>, t: f64) -> Vec<Signal> {
    start.inputs.iter().map(|u| u.after(t - start.t)).collect()
}

/// A limit as it was found.
struct FoundLimit {
    signs: Vec<f64>,
    margin: usize,
    stretch: Stretch,
    kind: Option<LimitKind>,
    q: Vec<f64>,
    proven: bool,
    /// True if it is proven, and the margin continuous, so that two closures come together.
    is_fold: bool,
}

/// All ranges and limits that were found, each with its signs.
struct Collected {
    ranges: Vec<(Vec<f64>, Stretch)>,
    limits: Vec<FoundLimit>,
}

impl Collected {
    /// The result in the order of t, with the numbers of circuits; `middle` gives q in the middle of a range.
    fn finish(mut self, model: &'static Model, middle: &dyn Fn(&[f64], &Stretch) -> Vec<f64>) -> Ranges {
        let plan = &model.plan;
        self.ranges.sort_by(|(_, a), (_, b)| a.from.total_cmp(&b.from));
        self.limits.sort_by(|a, b| a.stretch.from.total_cmp(&b.stretch.from));
        let circuit = self.circuits(plan);
        let mut numbers: Vec<usize> = Vec::new();
        let mut number = |root: usize| {
            numbers.iter().position(|&other| other == root).unwrap_or_else(|| {
                numbers.push(root);
                numbers.len() - 1
            })
        };
        let modes = |signs: &[f64]| {
            plan.modes.iter().zip(signs).filter_map(|(mode, &sign)| Some((mode.name, Sign::of(sign)?))).collect()
        };
        let range = |((signs, stretch), circuit): (&(Vec<f64>, Stretch), &usize)| Range {
            modes: modes(signs),
            from: stretch.from,
            to: stretch.to,
            q: middle(signs, stretch),
            circuit: number(*circuit),
        };
        let ranges = self.ranges.iter().zip(&circuit).map(range).collect();
        let limit = |found: FoundLimit| {
            let step = Step::of_margin(model, found.margin);
            let drivers = step.map_or_else(Vec::new, |step| step.drivers().collect());
            RangeLimit {
                t: Interval::new(found.stretch.from, found.stretch.to),
                modes: modes(&found.signs),
                joints: step.map_or_else(Vec::new, |step| step.joints().collect()),
                drivers: drivers.into_iter().map(|name| (name, driven(model, name, &found.q))).collect(),
                kind: found.kind,
                q: found.q,
                proven: found.proven,
            }
        };
        let limits = self.limits.into_iter().map(limit).collect();
        Ranges { ranges, limits, circuits: numbers.len(), searched: Vec::new() }
    }

    /// For every range the index of the first range of its circuit. Ranges are connected at a fold of a group,
    /// where the ranges of both signs of that group end, with all other signs equal.
    fn circuits(&self, plan: &Plan) -> Vec<usize> {
        let mut first: Vec<usize> = (0..self.ranges.len()).collect();
        let ends = |signs: &[f64], stretch: &Stretch| {
            (0..self.ranges.len())
                .filter(|&k| {
                    let (range_signs, range) = &self.ranges[k];
                    range_signs == signs && (range.to == stretch.from || range.from == stretch.to)
                })
                .collect::<Vec<usize>>()
        };
        for found in self.limits.iter().filter(|limit| limit.is_fold) {
            let Some(index) = plan.modes.iter().position(|mode| mode.margin == found.margin) else { continue };
            let mut other = found.signs.clone();
            other[index] = -other[index];
            let partner = self.limits.iter().find(|limit| {
                let overlap = limit.stretch.from <= found.stretch.to && found.stretch.from <= limit.stretch.to;
                limit.signs == other && limit.margin == found.margin && overlap
            });
            let Some(partner) = partner else { continue };
            let connected = [ends(&found.signs, &found.stretch), ends(&other, &partner.stretch)].concat();
            let Some(least) = connected.iter().map(|&k| first[k]).min() else { continue };
            let old: Vec<usize> = connected.iter().map(|&k| first[k]).collect();
            first.iter_mut().filter(|root| old.contains(root)).for_each(|root| *root = least);
        }
        first
    }
}
