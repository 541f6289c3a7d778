//! All ways in which a mechanism closes.

use super::Solver;
use super::any_solver::AnySolver;
use crate::analysis::acceleration::acceleration;
use crate::analysis::position::position;
use crate::analysis::rounding::settle_rates;
use crate::analysis::velocity::{factorize, velocity};
use crate::assembly::{Assemblies, Assembly, Undecided};
use crate::certificate::{Certificate, Uncertified};
use crate::equations::scale::Scale;
use crate::equations::{Equations, geometry};
use crate::error::SolveError;
use crate::linear::Factorization;
use crate::mechanism::Mechanism;
use crate::model::{CoordinateKind, Model};
use crate::modes::modes;
use crate::plan::{Depth, Plan, Solved};
use crate::planned::Sign;
use crate::planned::branch::FAR_FROM_LIMITS;
use crate::proof::{Certified, Closing, MarginSign, Prover, SearchOutcome, combinations, search, violated, zeros};
use crate::scalar::Interval;
use crate::scalar::compare::all_finite;
use crate::signal::Instant;
use crate::workspace::Subset;

/// Half the width of the search for lengths that no row determines, relative to the size of the mechanism.
const LENGTH_REACH: f64 = 16.0;

/// Certifies q.
type Prove<'a> = dyn FnMut(&[f64]) -> Result<Certificate, Uncertified> + 'a;

impl<M: Mechanism> Solver<'_, M> {
    /// All ways in which the mechanism closes at an instant: every assembly mode, each with a certificate of its
    /// position, and whether they are proven to be all.
    ///
    /// Where the plan has a closed form for every group, all combinations of signs are solved, and one that has no
    /// closure is proven to have none by the plan in interval arithmetic. All other mechanisms, and those in which
    /// signs do not distinguish all closures (for example because an angle φ occurs only as 2φ), are searched by branch
    /// and prune: every unknown angle covers a full turn around its guess, boxes without a solution are excluded, and
    /// in every other box the solution is proven to be unique. Boxes for which neither can be proven are reported as
    /// undecided.
    ///
    /// ```
    /// use kin_runtime::{Instant, Kinematics, mechanism};
    ///
    /// #[mechanism]
    /// #[bodies(crank, coupler, rocker)]
    /// #[revolute(C: ground @ (0, 0), crank @ (0, 0))]
    /// #[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
    /// #[revolute(B: coupler @ (0.4, 0), rocker @ (0, 0))]
    /// #[revolute(D: rocker @ (0.3, 0), ground @ (0.4, 0.1))]
    /// #[driver(drive: crank.phi = pi/4 + t)]
    /// struct FourBar;
    ///
    /// let all = FourBar.solver().assemblies(&Instant::at(0.0))?;
    /// assert!(all.is_complete());
    /// let names: Vec<String> = all.found.iter().map(|assembly| assembly.name()).collect();
    /// assert_eq!(names, ["A-B-D=+", "A-B-D=-"]);
    /// # Ok::<(), kin_runtime::SolveError>(())
    /// ```
    ///
    /// # Errors
    /// [`NotCertified`](SolveError::NotCertified) where nothing can be proven at all: degrees of freedom are left, or
    /// rows use supplied functions; [`NonFinite`](SolveError::NonFinite), [`Length`](SolveError::Length) and
    /// [`UnknownCoordinate`](SolveError::UnknownCoordinate).
    pub fn assemblies(&self, at: &Instant<'_>) -> Result<Assemblies, SolveError> {
        (self as &dyn AnySolver).closures(at)
    }
}

impl dyn AnySolver + '_ {
    /// All ways in which the mechanism closes.
    pub(super) fn closures(&self, at: &Instant<'_>) -> Result<Assemblies, SolveError> {
        let (model, guess) = (self.model(), self.start()?);
        if !all_finite(&guess) {
            self.equations_at(at)?.check("guess", &guess)?;
        }
        let by_plan = self.angles_with_free_turns(at, &guess);
        // `is_sound_plan` checks the instant and the parameters; otherwise `equations_at` does, and a length is needed.
        let is_sound = by_plan.is_some() && self.is_sound_plan(at);
        let length = if is_sound { 0.0 } else { Scale::around(&mut self.equations_at(at)?, &guess).length };
        let refuse = |why| SolveError::NotCertified { t: at.t, why };
        // Fails if degrees of freedom are left: then there is no list of closures.
        let square = self.square(at, &guess).map_err(refuse)?;
        let mut system = self.boxes(at);
        let (is_same, mut prover) = (self.redundant_everywhere().is_some(), Prover::new(&square));
        let mut prove = |q: &[f64]| match is_same {
            true => prover.position(&mut *system, q),
            false => Prover::new(&self.square(at, q)?).position(&mut *system, q),
        };
        if let Some(bounded) = by_plan {
            let mut margins = zeros(model.plan.margins);
            let mut without_value = None;
            let close = &mut |signs: &[f64]| {
                let closing = self.close(at, signs, &guess, &mut margins, &mut prove);
                closing.unwrap_or_else(|q| {
                    without_value = Some(q);
                    Closing::Open { margin: model.plan.margins, excluded: false }
                })
            };
            let (found, undecided) = combinations(model, close);
            if found.is_empty() {
                geometry::check(&self.equations_at(at)?)?;
            }
            if let (true, Some(q)) = (found.is_empty(), without_value) {
                // The error names the row.
                self.equations_at(at)?.evaluate(Subset::PHI, &q, None)?;
            }
            return Ok(Assemblies { found, undecided, searched: half_turns(model, &bounded, &guess) });
        }
        geometry::check(&self.equations_at(at)?)?;
        let [region, wide] = region(model, &guess, length);
        let mut boxes = self.boxes(at);
        let prove = &mut |q: &[f64]| {
            let lists = self.analysed(at, q).ok_or(Uncertified::Malformed)?;
            let certificate = prove(&lists[0])?;
            Ok((lists, certificate))
        };
        let SearchOutcome { mut found, undecided, unfinished, searched } =
            search(&square, &mut *boxes, [&region, &wide], prove).map_err(refuse)?;
        found.sort_by(|([a, ..], _), ([b, ..], _)| b.partial_cmp(a).unwrap_or(std::cmp::Ordering::Equal));
        let mut apart: Vec<Certified> = Vec::new();
        for closure in found {
            if !apart.iter().any(|(_, other)| is_turned(model, &closure.1, other)) {
                apart.push(closure);
            }
        }
        let name = |k: usize| model.coordinates[k].name;
        let searched: Vec<(&'static str, Interval)> = searched.into_iter().map(|(k, x)| (name(k), x)).collect();
        let undecided_region = |region: Vec<Interval>| Undecided::Region {
            coordinates: searched.iter().map(|(name, _)| *name).zip(region).collect(),
        };
        let undecided =
            undecided.into_iter().map(undecided_region).chain(unfinished.map(|seen| Undecided::Unfinished { seen }));
        let undecided = undecided.collect();
        let assembly = |([q, q_dot, q_ddot], certificate): ([Vec<f64>; 3], Certificate)| {
            let modes = self.equations_at(at).and_then(|equations| modes(&equations, &q)).unwrap_or_default();
            let modes = modes.iter().filter_map(|mode| Some((mode.name, mode.sign?))).collect();
            Assembly { modes, q, q_dot, q_ddot, certificate: Ok(certificate) }
        };
        Ok(Assemblies { found: apart.into_iter().map(assembly).collect(), undecided, searched })
    }

    /// Whether the plan solves every group in closed form.
    pub(super) fn is_closed_form(&self) -> bool {
        let plan = &self.model().plan;
        plan.exists() && self.settings().given.is_empty() && !plan.iterates()
    }

    /// The closure that the plan gives with these signs, or why there is none.
    ///
    /// # Errors
    /// Its q if the numbers of it are not all finite, though all margins are positive.
    fn close(
        &self,
        at: &Instant<'_>,
        signs: &[f64],
        start: &[f64],
        margins: &mut [f64],
        prove: &mut Prove<'_>,
    ) -> Result<Closing<Assembly>, Vec<f64>> {
        let plan = &self.model().plan;
        margins.fill(0.0);
        let [mut q, mut q_dot, mut q_ddot] = self.zeros();
        let solved = Solved { q: &mut q, q_dot: &mut q_dot, q_ddot: &mut q_ddot, margins: &mut *margins };
        let outcome = self.solve(at, signs, start, Depth::Acceleration, solved);
        // NaN is not positive either.
        let is_good = |margin: &f64| *margin > Plan::SMALLEST_MARGIN;
        Ok(match margins.iter().position(|margin| !is_good(margin)) {
            None if !all_finite(&q) => return Err(q),
            None if self.violates(at, signs, start) => Closing::Violated,
            None if outcome.is_ok() => {
                if margins.iter().any(|margin| *margin < FAR_FROM_LIMITS) {
                    self.settle(at, [&mut q, &mut q_dot, &mut q_ddot]);
                }
                let certificate = prove(&q);
                let modes = plan.modes.iter().zip(signs).filter_map(|(mode, &sign)| Some((mode.name, Sign::of(sign)?)));
                Closing::Closed(Assembly { q, q_dot, q_ddot, modes: modes.collect(), certificate })
            }
            None => Closing::Open { margin: 0, excluded: false },
            Some(margin) => {
                let seen = self.look([at.t, at.t], at, signs, start);
                Closing::Open { margin, excluded: matches!(seen, MarginSign::Open(_)) }
            }
        })
    }

    /// True if it is proven that the only configuration that the plan gives with these signs violates a redundant row,
    /// which the plan leaves out: an antiparallelogram violates the rows of the third crank of a parallelogram, for
    /// example.
    fn violates(&self, at: &Instant<'_>, signs: &[f64], start: &[f64]) -> bool {
        let model = self.model();
        let redundant: Vec<usize> = model.plan.redundant_rows().collect();
        if redundant.is_empty() {
            return false;
        }
        let Some([q, _]) = self.enclosed([at.t, at.t], at, signs, start) else { return false };
        violated(model, &redundant, &mut *self.boxes(at), &q).is_some()
    }

    /// q near a configuration, with its q̇ and q̈.
    fn analysed(&self, at: &Instant<'_>, near: &[f64]) -> Option<[Vec<f64>; 3]> {
        let equations = &mut self.equations_at(at).ok()?;
        let q = position(equations, near).ok()?.q;
        equations.scale = Scale::around(equations, &q);
        let (q_dot, factor) = velocity(equations, &q, None).ok()?;
        let q_ddot = acceleration(equations, &q, &q_dot, &factor).ok()?;
        let mut lists = [q, q_dot, q_ddot];
        settle(equations, lists.each_mut(), &factor);
        Some(lists)
    }

    /// Settles the rates of a solution beside a limit of the plan.
    #[cold]
    fn settle(&self, at: &Instant<'_>, lists: [&mut Vec<f64>; 3]) {
        let Ok(mut equations) = self.equations_at(at) else { return };
        equations.scale = Scale::around(&mut equations, lists[0]);
        if let Ok(factor) = factorize(&mut equations, lists[0], None) {
            settle(&mut equations, lists, &factor);
        }
    }

    /// Room for q, q̇ and q̈.
    pub(super) fn zeros(&self) -> [Vec<f64>; 3] {
        [(); 3].map(|()| zeros(self.model().coordinates.len()))
    }
}

/// Replaces rates that rounding errors dominate, by NaN where no accurate ones are found.
fn settle(equations: &mut Equations<'_>, [q, q_dot, q_ddot]: [&mut Vec<f64>; 3], factor: &Factorization) {
    if settle_rates(equations, [q, q_dot, q_ddot], factor).is_err() {
        q_dot.fill(f64::NAN);
        q_ddot.fill(f64::NAN);
    }
}

/// True for a coordinate that is a length: the x or y of a body, or a scalar with the unit of lengths.
pub(super) fn is_length(model: &Model, k: usize) -> bool {
    let (info, units) = (&model.coordinates[k], &model.units);
    info.kind.is_length() || (units.length.is_some() && units.of(info.name) == units.length)
}

/// True for the angle of a body.
pub(super) fn is_angle(model: &Model, k: usize) -> bool {
    model.coordinates[k].kind.is_angle()
}

/// The names of angles, with intervals of half a turn on both sides of their guesses.
pub(super) fn half_turns(model: &Model, angles: &[usize], guess: &[f64]) -> Vec<(&'static str, Interval)> {
    let around = |&k: &usize| (model.coordinates[k].name, half_turn(model, k, guess[k]));
    angles.iter().map(around).collect()
}

/// The interval of half a turn on both sides of an angle, in its unit.
fn half_turn(model: &Model, k: usize, angle: f64) -> Interval {
    Interval::around(angle, (0.5 * model.turn(k)).next_up())
}

/// The box, around the guesses, in which closures are searched; and the same with scalar coordinates that are more than a turn
/// away from 0 taken for lengths, for those with which the equations do not repeat after a turn.
pub(super) fn region(model: &Model, guess: &[f64], length: f64) -> [Vec<Interval>; 2] {
    let turn = |k: usize| half_turn(model, k, guess[k]);
    let reach = |k: usize, size: f64| Interval::around(guess[k], LENGTH_REACH * size);
    let is_scalar = |k: usize| matches!(model.coordinates[k].kind, CoordinateKind::Scalar);
    let usual = |k: usize| match is_length(model, k) {
        true if is_scalar(k) => reach(k, length.max(guess[k].abs())),
        true => reach(k, length),
        false => turn(k),
    };
    let is_far = |k: usize| is_scalar(k) && guess[k].abs() > model.turn(k);
    let wide = |k: usize| if is_far(k) { usual(k).hull(reach(k, guess[k].abs())) } else { usual(k) };
    let all = 0..guess.len();
    [all.clone().map(usual).collect(), all.map(wide).collect()]
}

/// True if two certified closures are the same up to whole turns of angles: without these turns, the first lies in the
/// box in which the other is the only solution.
fn is_turned(model: &Model, closure: &Certificate, other: &Certificate) -> bool {
    const TURN: Interval = Interval::new(std::f64::consts::TAU, std::f64::consts::TAU.next_up());
    closure.q.iter().zip(&other.unique).enumerate().all(|(k, (&x, alone))| {
        let turns =
            if is_angle(model, k) { ((alone.midpoint() - x.midpoint()) / std::f64::consts::TAU).round() } else { 0.0 };
        let turned = x + Interval::from(turns) * TURN;
        alone.lower() <= turned.lower() && turned.upper() <= alone.upper()
    })
}

/// The largest difference of two configurations up to whole turns of angles, relative to a radian and to the size of
/// the mechanism.
pub(super) fn difference(model: &Model, a: &[f64], b: &[f64], length: f64) -> f64 {
    let distance = |(k, (a, b)): (usize, (&f64, &f64))| {
        let turns =
            if is_angle(model, k) { ((a - b) / std::f64::consts::TAU).round() * std::f64::consts::TAU } else { 0.0 };
        (a - b - turns).abs() / if is_length(model, k) { length } else { 1.0 }
    };
    a.iter().zip(b).enumerate().map(distance).fold(0.0, f64::max)
}
