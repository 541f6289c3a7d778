//! How far a mechanism moves.

use super::Solver;
use crate::certificate::Uncertified;
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::plan::{Depth, Plan, Solved, StepKind};
use crate::planned::{Limit, LimitKind, Sign, Step};
use crate::proof::{Seen, Stretch, Winding, refined, stretches};
use crate::ranges::{Range, RangeLimit, Ranges};
use crate::scalar::Interval;
use crate::workspace::{Array, Instant, Signal};

/// How narrow a stretch becomes of which nothing is known, relative to the whole way, and one with a limit.
const NARROWEST: [f64; 2] = [1e-8, 1e-12];
/// Most stretches that are looked at in one combination of modes, and at one limit.
const MOST: [usize; 2] = [50_000, 4_000];
/// Most modes whose combinations are gone through.
const MODES: usize = 12;
/// How far from a limit the motion towards it begins, relative to the range.
const BEFORE: f64 = 1e-2;

impl<M: Mechanism> Solver<'_, M> {
    /// Where the mechanism closes between the time of an instant and another, in every combination of its modes, and the
    /// limits at which that ends: dead centres, which come with the joints that are in line, and branch points. Inputs go
    /// on from the instant with constant acceleration ([`Signal::after`]), as those of a sweep from the command line do.
    ///
    /// The plan is evaluated over intervals of t. Where all its margins are positive on an interval the mechanism closes on
    /// all of it, where one is negative it closes nowhere; what is neither is halved. So ranges are proven, and limits are
    /// enclosed to about ten digits of the way.
    ///
    /// ```
    /// use kin_runtime::planned::LimitKind;
    /// use kin_runtime::{Instant, Kinematics, mechanism};
    ///
    /// /// Crank 0.3, coupler 0.25, rocker 0.2, pivots 0.5 apart: the crank goes as far as cos φ = 0.458333….
    /// #[mechanism]
    /// #[bodies(crank, coupler, rocker)]
    /// #[revolute(O: ground @ (0, 0), crank @ (0, 0))]
    /// #[revolute(A: crank @ (0.3, 0), coupler @ (0, 0))]
    /// #[revolute(B: coupler @ (0.25, 0), rocker @ (0.2, 0))]
    /// #[revolute(C: ground @ (0.5, 0), rocker @ (0, 0))]
    /// #[driver(drive: crank.phi = t)]
    /// struct FourBar;
    ///
    /// let all = FourBar.solver().ranges(&Instant::at(-0.1), 3.0)?;
    /// let end = (0.1375_f64 / 0.3).acos();
    /// assert!(all.is_complete() && all.limits.iter().all(|limit| limit.kind == Some(LimitKind::DeadCentre)));
    /// assert!(all.limits[0].t.contains(end) && all.limits[0].joints == ["A", "B", "C"]);
    /// // Two modes, which are one motion: at the dead centre it goes from one into the other.
    /// assert_eq!((all.ranges.len(), all.circuits), (2, 1));
    /// # Ok::<(), kin_runtime::SolveError>(())
    /// ```
    ///
    /// # Errors
    /// [`NotCertified`](SolveError::NotCertified) where no plan in closed form solves the mechanism, with the joints of the
    /// group that closes by iteration;
    /// [`NonFinite`](SolveError::NonFinite), [`Length`](SolveError::Length) and
    /// [`UnknownCoordinate`](SolveError::UnknownCoordinate).
    pub fn ranges(&self, from: &Instant<'_>, to: f64) -> Result<Ranges, SolveError> {
        let guess: Vec<f64> = self.checked_guess()?.into_iter().map(|guess| guess.unwrap_or(0.0)).collect();
        self.analyse(&Instant { t: to, inputs: from.inputs }, |_| Ok(()))?;
        self.analyse(from, |_| Ok(()))?;
        let plan = &M::model().plan;
        if let Some(why) = self.not_enclosed() {
            return Err(SolveError::NotCertified { t: from.t, why });
        }
        let way = [from.t.min(to), from.t.max(to)];
        let narrowest = NARROWEST.map(|narrowest| narrowest * (way[1] - way[0]));
        let mut all = Collected { ranges: Vec::new(), limits: Vec::new() };
        for code in 0..1_usize << plan.modes.len() {
            let signs: Vec<f64> =
                (0..plan.modes.len()).map(|place| if code >> place & 1 == 0 { 1.0 } else { -1.0 }).collect();
            let look = &mut |a: f64, b: f64| self.look([a, b], from, &signs, &guess);
            let found = stretches(way, narrowest[0], MOST[0], look);
            let found = refined(&found, narrowest, MOST[1], look);
            for (place, stretch) in found.iter().enumerate() {
                match stretch.seen {
                    Seen::Closed => all.ranges.push((signs.clone(), *stretch)),
                    Seen::Open(_) => {}
                    Seen::Unknown(margin) => {
                        let neighbours = [place.checked_sub(1).map(|k| found[k]), found.get(place + 1).copied()];
                        all.limits.push(self.limit(from, &signs, margin, *stretch, neighbours));
                    }
                }
            }
        }
        Ok(all.finish::<M>())
    }

    /// Why the plan cannot be enclosed along t in all combinations of its modes.
    fn not_enclosed(&self) -> Option<Uncertified> {
        let model = M::model();
        let plan = &model.plan;
        if let Some(why) = plan.absent.or((!self.given.is_empty()).then_some("coordinates are prescribed")) {
            return Some(Uncertified::NoPlan { why });
        }
        if let Some(place) = plan.steps.iter().position(|step| matches!(step.kind, StepKind::Newton(_))) {
            let joints = Step::new(model, place).map_or_else(Vec::new, |step| step.joints().collect());
            return Some(Uncertified::NoClosedForm { joints });
        }
        if let Some(row) = plan.watched().next() {
            return Some(Uncertified::Redundant { row: model.rows.get(row).map_or("", |row| row.name) });
        }
        let modes = plan.modes.len();
        (modes > MODES).then_some(Uncertified::TooManyModes { modes, most: MODES })
    }

    /// What the plan says of an interval of t, in the modes with these signs. Inputs go on from the instant `start`.
    pub(super) fn look(&self, way: [f64; 2], start: &Instant<'_>, signs: &[f64], guess: &[f64]) -> Seen {
        let Some([_, margins]) = self.enclosed(way, start, signs, guess) else { return Seen::Unknown(0) };
        let first = margins.iter().position(|margin| margin.lower() <= Plan::SMALLEST_MARGIN || !margin.is_defined());
        match first {
            None => Seen::Closed,
            Some(margin) if margins[margin].upper() < 0.0 => Seen::Open(margin),
            Some(margin) => Seen::Unknown(margin),
        }
    }

    /// q and the margins over an interval of t, by the plan with these signs.
    pub(super) fn enclosed(
        &self,
        [from, to]: [f64; 2],
        start: &Instant<'_>,
        signs: &[f64],
        guess: &[f64],
    ) -> Option<[Vec<Interval>; 2]> {
        let middle = 0.5 * from + 0.5 * to;
        let since = Winding(Interval::new(from, to)) - Winding(Interval::from(start.t));
        let later = |u: &Signal| u.map(|x| Winding(Interval::from(x))).after(since);
        let inputs: Vec<Signal<Winding>> = start.inputs.iter().map(later).collect();
        // Angles are those nearest to the configuration in the middle, as far as it exists.
        let near = self.near_by_plan(middle, start, signs, guess);
        let interval = |list: &[f64]| list.iter().map(|&x| Winding(Interval::from(x))).collect::<Vec<_>>();
        let at = Instant { t: Winding(Interval::new(from, to)), inputs: &inputs };
        let all = Winding(Interval::ENTIRE);
        let mut lists: [Vec<Winding>; 3] = std::array::from_fn(|_| vec![all; M::COORDINATES]);
        let mut margins = vec![all; M::model().plan.margins];
        let [q, q_dot, q_ddot] = &mut lists;
        let solved = Solved { q, q_dot, q_ddot, margins: &mut margins };
        let parameters = self.mechanism.parameters::<Winding>();
        let (signs, near) = (interval(signs), interval(&near));
        self.mechanism.solve_with(parameters.as_ref(), &at, &signs, &near, Depth::Position, solved).ok()?;
        let [q, ..] = lists;
        Some([q, margins].map(|list| list.into_iter().map(|x| x.0).collect()))
    }

    /// q by the plan, with the guess where it has none.
    fn near_by_plan(&self, t: f64, start: &Instant<'_>, signs: &[f64], guess: &[f64]) -> Vec<f64> {
        let zeros = || M::Coordinates::<f64>::filled(0.0);
        let ([mut q, mut q_dot, mut q_ddot], mut margins) =
            ([zeros(), zeros(), zeros()], vec![0.0; M::model().plan.margins]);
        let solved = Solved { q: q.as_mut(), q_dot: q_dot.as_mut(), q_ddot: q_ddot.as_mut(), margins: &mut margins };
        let parameters = self.mechanism.parameters::<f64>();
        let inputs: Vec<Signal> = start.inputs.iter().map(|u| u.after(t - start.t)).collect();
        let at = Instant { t, inputs: &inputs };
        let done = self.mechanism.solve_with(parameters.as_ref(), &at, signs, guess, Depth::Position, solved);
        let found = q.as_ref().iter().zip(guess).map(|(&x, &guess)| if x.is_finite() { x } else { guess });
        if done.is_ok() { found.collect() } else { guess.to_vec() }
    }

    /// The limit in a stretch where a margin changes its sign, or touches 0; its configuration is found by the motion towards
    /// it from a neighbour in which the mechanism closes.
    fn limit(
        &self,
        start: &Instant<'_>,
        signs: &[f64],
        margin: usize,
        stretch: Stretch,
        neighbours: [Option<Stretch>; 2],
    ) -> FoundLimit {
        let closed = |side: &Option<Stretch>| side.filter(|stretch| stretch.seen == Seen::Closed);
        let open = |side: &Option<Stretch>| matches!(side, Some(Stretch { seen: Seen::Open(_), .. }));
        let [before, after] = neighbours;
        let proven = (closed(&before).is_some() && open(&after)) || (open(&before) && closed(&after).is_some());
        let (inside, beyond) = match (closed(&before), closed(&after)) {
            (Some(range), _) => (range.to - BEFORE * (range.to - range.from), after.map_or(stretch.to, |side| side.to)),
            (None, Some(range)) => {
                (range.from + BEFORE * (range.to - range.from), before.map_or(stretch.from, |side| side.from))
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
        // Where a margin changes its sign, it is a fold whatever the motion towards it says.
        let kind = found.and_then(|limit| limit.kind()).or(proven.then_some(LimitKind::DeadCentre));
        FoundLimit { signs: signs.to_vec(), margin, stretch, kind, q, proven }
    }

    /// The limit that ends a motion in these modes, and the configuration there.
    fn approached(&self, start: &Instant<'_>, signs: &[f64], way: [f64; 2]) -> (Option<Limit>, Vec<f64>) {
        let later = |t: f64, out: &mut [Signal]| {
            out.iter_mut().zip(start.inputs).for_each(|(out, u)| *out = u.after(t - start.t));
        };
        let modes = signs.iter().enumerate().filter_map(|(place, &sign)| Some((place, Sign::of(sign)?)));
        let guesses = self.guesses.iter();
        let solver = Solver::new(self.mechanism).with_options(self.options).with_inputs(&later);
        let solver = guesses.fold(solver, |solver, &(place, guess)| solver.with_guess(place, guess));
        let solver = modes.fold(solver, |solver, (place, sign)| solver.with_mode(place, sign));
        match solver.sweep(&way) {
            Ok(_) => (None, Vec::new()),
            Err(error) => {
                let q = error.q_at_limit().map(<[f64]>::to_vec).unwrap_or_default();
                (error.source.limit().copied(), q)
            }
        }
    }
}

/// A limit as it was found.
struct FoundLimit {
    signs: Vec<f64>,
    margin: usize,
    stretch: Stretch,
    kind: Option<LimitKind>,
    q: Vec<f64>,
    proven: bool,
}

/// Everything that was found, mode by mode.
struct Collected {
    ranges: Vec<(Vec<f64>, Stretch)>,
    limits: Vec<FoundLimit>,
}

impl Collected {
    /// In the order of t, with circuits.
    fn finish<M: Mechanism>(mut self) -> Ranges {
        let plan = &M::model().plan;
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
            circuit: number(*circuit),
        };
        let ranges = self.ranges.iter().zip(&circuit).map(range).collect();
        let limit = |found: FoundLimit| {
            let step = Step::of_margin(M::model(), found.margin);
            let drivers = step.map_or_else(Vec::new, |step| step.drivers().collect());
            RangeLimit {
                t: Interval::new(found.stretch.from, found.stretch.to),
                modes: modes(&found.signs),
                joints: step.map_or_else(Vec::new, |step| step.joints().collect()),
                drivers: drivers.into_iter().map(|name| (name, driven::<M>(name, &found.q))).collect(),
                kind: found.kind,
                q: found.q,
                proven: found.proven,
            }
        };
        let limits = self.limits.into_iter().map(limit).collect();
        Ranges { ranges, limits, circuits: numbers.len() }
    }

    /// For every range the first of those that it is connected with: at a proven limit of a group, where both signs of that
    /// group end, everything else being the same.
    fn circuits(&self, plan: &Plan) -> Vec<usize> {
        let mut first: Vec<usize> = (0..self.ranges.len()).collect();
        let ends = |signs: &[f64], stretch: &Stretch| {
            (0..self.ranges.len())
                .filter(|&k| {
                    let (of, range) = &self.ranges[k];
                    of == signs && (range.to == stretch.from || range.from == stretch.to)
                })
                .collect::<Vec<usize>>()
        };
        for found in self.limits.iter().filter(|limit| limit.proven) {
            let Some(place) = plan.modes.iter().position(|mode| mode.margin == found.margin) else { continue };
            let mut other = found.signs.clone();
            other[place] = -other[place];
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

/// The value of the one coordinate that a driver drives.
fn driven<M: Mechanism>(name: &str, q: &[f64]) -> Option<f64> {
    let model = M::model();
    let row = model.rows.iter().position(|row| model.joints.get(row.joint).is_some_and(|joint| joint.name == name))?;
    let mut entries = model.constraint_pattern.entries.iter().filter(|(of, _)| *of == row);
    let (Some(&(_, column)), None) = (entries.next(), entries.next()) else { return None };
    q.get(column).copied()
}
