//! Instants just before a fold or a crossing, from 0.1 to 10⁻⁹ before it, and some just behind it: every result must be
//! right. At a fold q̇ and q̈ grow without bound, and so may their errors; at a crossing they are smooth.

use crate::bars::{Angles, Bar, Ends, Middles, Slider, slider};
use crate::case::{Case, Group};
use crate::closure::FourBar;
use crate::crossings::crossing;
use crate::draw::{Draw, near_a_crossing};
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Times that start at 0.4 before the place, followed by instants at decreasing powers of ten before it, or by a single
/// near one.
fn nearer(random: &mut Random, way: f64) -> Vec<f64> {
    let exact = random.chance(0.5);
    let mut before = |k: i32| way * 10_f64.powi(-k) * if exact { 1.0 } else { random.between(0.5, 1.0) };
    let mut times: Vec<f64> = (1..=9).map(&mut before).collect();
    times.insert(0, 0.4 * way);
    match random.whole(0, 3) {
        // Directly to one near instant.
        0 => times = vec![times[0], times[random.whole(2, 9)]],
        // Past the place and away from it.
        1 => times.extend([-0.01 * way, -0.3 * way]),
        _ => {}
    }
    // The place is at a distance of 0.4 from the start.
    times.into_iter().map(|t| 0.4 * way - t).collect()
}

/// Four-bars with a fold or a crossing at t = 0.4.
fn bars<M: Bar>(random: &mut Random, times: &[f64], way: f64, fold: bool) -> Group<M> {
    let mut cases: Vec<Case<M>> = Vec::new();
    while cases.len() < 4 {
        let (bar, limit) = if fold { folding(random, way) } else { crossing(random) };
        let start = limit - 0.4 * way;
        if bar.is_free(start, 0.3) {
            cases.push(M::case(bar, start, [0.0, 0.8 * way]));
        }
    }
    Group::new(times.to_vec(), cases)
}

/// A four-bar that is stretched or folded at an angle where its branch ends for a crank that comes from the side of
/// −`way`.
pub(crate) fn folding(random: &mut Random, way: f64) -> (FourBar, f64) {
    loop {
        let outer = random.chance(0.5);
        let mut bar = near_a_crossing(random, outer, 0.0);
        bar.d += random.between(-0.3, 0.3);
        let at = if outer { PI } else { TAU };
        let [folds, _] = bar.places(at - 2.0, at + 2.0);
        // The first fold that the crank meets.
        let met = folds
            .into_iter()
            .filter(|place| bar.is_free(place - 0.4 * way, 0.0))
            .min_by(|a, b| (a * way).total_cmp(&(b * way)));
        if let Some(met) = met.filter(|_| bar.d > 0.1) {
            return (bar, met);
        }
    }
}

fn sliders(random: &mut Random, times: &[f64], way: f64, fold: bool) -> Group<Slider> {
    let mut one = || {
        let r = random.length();
        let l = if fold { r * random.between(0.4, 0.9) } else { r };
        let limit = if fold { if way > 0.0 { (l / r).asin() } else { -(l / r).asin() } } else { FRAC_PI_2 };
        slider([r, l], random.sign(), limit - 0.4 * way, [0.0, 0.8 * way])
    };
    let cases = [one(), one(), one(), one()].into();
    Group::new(times.to_vec(), cases)
}

fn approach(tally: &mut Tally, random: &mut Random, fold: bool) {
    let way = random.sign();
    let times = nearer(random, way);
    match random.whole(0, 3) {
        0 => follow(tally, &bars::<Ends>(random, &times, way, fold)),
        1 => follow(tally, &bars::<Middles>(random, &times, way, fold)),
        2 => follow(tally, &bars::<Angles>(random, &times, way, fold)),
        _ => follow(tally, &sliders(random, &times, way, fold)),
    }
}

#[test]
fn instants_before_a_fold() {
    let (mut random, mut tally) = (Random::new(251), Tally::default());
    for _ in 0..motions(0.06).div_ceil(4) {
        approach(&mut tally, &mut random, true);
    }
    tally.obeys("instants before a fold");
}

#[test]
fn instants_before_a_crossing() {
    let (mut random, mut tally) = (Random::new(252), Tally::default());
    for _ in 0..motions(0.06).div_ceil(4) {
        approach(&mut tally, &mut random, false);
    }
    tally.obeys("instants before a crossing");
}
