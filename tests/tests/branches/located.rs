//! Where a motion ends at a limit, the time of the limit and the configuration there are accurate to 1e-9, for every
//! method.

use crate::approaches::folding;
use crate::bars::{Angles, Bar, Ends, Middles, slider};
use crate::case::Case;
use crate::crossings::crossing;
use crate::draw::Draw;
use crate::platforms;
use crate::tally::motions;
use kin_runtime::nalgebra::DMatrix;
use kin_runtime::{Instant, Kinematics, LimitKind, Planned};
use kin_tests::compare::largest;
use kin_tests::random::Random;
use std::f64::consts::FRAC_PI_2;
use std::fmt::Debug;

/// The number of limits that were located, that were not located, and that were refused.
#[derive(Default)]
struct Count {
    located: usize,
    missed: usize,
    refused: usize,
}

/// Moves past the nearest fold or crossing in steps of `step`, by a sweep, by a tracker and by the plan alone.
fn past_its_limit<M: Kinematics + Debug>(case: &Case<M>, step: f64, count: &mut Count) {
    let nearest = |places: &[f64]| places.iter().copied().filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
    let (fold, crossing) = (nearest(&case.folds), nearest(&case.crossings));
    let limit = fold.min(crossing);
    let all = case.folds.iter().chain(&case.crossings);
    // Cases with a second limit nearby are excluded.
    if limit.is_infinite() || limit < 0.2 || all.into_iter().any(|t| *t != limit && (t - limit).abs() < 0.1) {
        return;
    }
    let start: Vec<f64> = (case.branch)(0.0, 0.0).expect("it closes").iter().map(|jet| jet.x).collect();
    let kind = if fold < crossing { LimitKind::DeadCentre } else { LimitKind::BranchPoint };
    let times: Vec<f64> = (0..=((limit + 0.5) / step) as usize).map(|k| k as f64 * step).collect();
    let mechanism = &case.mechanism;
    let solver = mechanism.solver();
    let mut judge = |found: Option<(f64, Option<LimitKind>)>, q: Option<&[f64]>| {
        let Some((t, found)) = found else {
            count.refused += 1;
            return;
        };
        assert!(found.is_none_or(|found| found == kind), "{mechanism:?}: {found:?} at {limit}");
        let Some(q) = q else {
            count.missed += 1;
            return;
        };
        assert!((t - limit).abs() < 1e-9, "{mechanism:?}: {t} is {:.1e} from {limit}", t - limit);
        let at = Instant::at(limit);
        let phi = mechanism.constraints(&at, q).expect("lengths agree");
        assert!(largest(phi.as_ref()) < 1e-9, "{mechanism:?} at {limit}: Φ = {:?}", phi.as_ref());
        let entries = mechanism.jacobian(&at, q).expect("lengths agree");
        let mut jacobian = DMatrix::zeros(M::ROWS, M::COORDINATES);
        for (&(row, column), &entry) in M::model().constraint_pattern.entries.iter().zip(entries.as_ref()) {
            jacobian[(row, column)] = entry;
        }
        let values = jacobian.singular_values();
        assert!(values.min() < 3e-9 * values.max(), "{mechanism:?} at {limit}: {:.1e}", values.min() / values.max());
        count.located += 1;
    };
    // A motion that continues along its branch has no limit.
    if let Err(error) = solver.sweep_from(&start, &times) {
        let limit = error.source.limit();
        judge(limit.and_then(|limit| Some((limit.at()?, limit.kind()))), error.q_at_limit());
    }
    let mut tracker = solver.tracker_from(&Instant::at(0.0), &start).expect("it closes");
    if let Some(error) = times.iter().find_map(|t| tracker.update(&Instant::at(*t)).err()) {
        judge(error.limit().and_then(|limit| Some((limit.at()?, limit.kind()))), tracker.q_at_limit());
    }
    let mut planned = Planned::new(mechanism, &Instant::at(0.0), &start).expect("it closes");
    if let Some(error) = times.iter().find_map(|t| planned.at(&Instant::at(*t)).err()) {
        judge(error.limit().and_then(|limit| Some((limit.at()?, limit.kind()))), planned.q_at_limit());
    }
}

impl Count {
    /// Asserts that at most one of `many` limits is not located.
    #[track_caller]
    fn obeys(&self, family: &str, many: usize) {
        let Self { located, missed, refused } = self;
        let all = located + missed + refused;
        assert!(
            *located > 20 && many * (missed + refused) <= all,
            "{family}: {located} located, {missed} without q, {refused} without t"
        );
    }
}

fn bars<M: Bar + Kinematics + Debug>(random: &mut Random, folds: &mut Count, crossings: &mut Count) {
    let step = random.between(0.01, 0.3);
    let (bar, limit) = folding(random, 1.0);
    let start = limit - random.between(0.3, 0.9);
    if bar.is_free(start, 0.05) {
        past_its_limit(&M::case(bar, start, [0.0, 3.0]), step, folds);
    }
    let (bar, limit) = crossing(random);
    let start = limit - random.between(0.3, 1.2);
    if bar.is_free(start, 0.05) {
        past_its_limit(&M::case(bar, start, [0.0, 3.0]), step, crossings);
    }
}

#[test]
fn limits_of_four_bars() {
    let (mut random, mut folds, mut crossings) = (Random::new(301), Count::default(), Count::default());
    for _ in 0..motions(0.2) {
        bars::<Ends>(&mut random, &mut folds, &mut crossings);
        bars::<Middles>(&mut random, &mut folds, &mut crossings);
        bars::<Angles>(&mut random, &mut folds, &mut crossings);
    }
    folds.obeys("folds of four-bars", 50);
    crossings.obeys("crossings of four-bars", 50);
}

#[test]
fn limits_of_slider_cranks() {
    let (mut random, mut folds, mut crossings) = (Random::new(302), Count::default(), Count::default());
    for _ in 0..motions(0.2) {
        let (r, step) = (random.length(), random.between(0.01, 0.3));
        let start = FRAC_PI_2 - random.between(0.3, 0.9);
        past_its_limit(&slider([r, r], random.sign(), start, [0.0, 3.0]), step, &mut crossings);
        let l = random.between(0.7, 0.95) * r;
        let start = (l / r).asin() - random.between(0.3, 0.6);
        past_its_limit(&slider([r, l], random.sign(), start, [0.0, 3.0]), step, &mut folds);
    }
    folds.obeys("folds of slider-cranks", 50);
    crossings.obeys("crossings of slider-cranks", 50);
}

#[test]
fn limits_of_platforms() {
    let (mut random, mut folds) = (Random::new(303), Count::default());
    for _ in 0..motions(1.0) {
        past_its_limit(&platforms::case(&mut random), random.between(0.02, 0.3), &mut folds);
    }
    folds.obeys("folds of platforms", 10);
}
