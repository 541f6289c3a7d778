//! Cranks that swing to a fold or a crossing and reverse there: slightly before it, slightly behind it, or exactly at
//! it.

use crate::case::{Case, Group, NEAR};
use crate::closure::FourBar;
use crate::crossings::crossing;
use crate::draw::{Draw, near_a_crossing};
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A four-bar whose crank swings.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = middle + swing * sin(t))]
#[derive(Clone, Debug)]
struct Swinging {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    middle: f64,
    swing: f64,
}

fn swinging(bar: FourBar, middle: f64, swing: f64, grid: &[f64]) -> Case<Swinging> {
    let end = grid[grid.len() - 1];
    let FourBar { a, b, c, d, sign } = bar;
    let branch = move |t: f64, off: f64| {
        let phi = (Jet::time(t) * (1.0 + off)).sin() * swing + middle;
        let [coupler, rocker] = bar.close(phi, off)?;
        let zero = Jet::default();
        Some(vec![zero, zero, phi, phi.cos() * a, phi.sin() * a, coupler, Jet::from(d), zero, rocker])
    };
    let width = swing.abs();
    // The times at which the crank is at these angles, and the instants at which it reverses so near to one that
    // nothing is determined.
    let in_time = |places: Vec<f64>| -> Vec<f64> {
        let mut times = Vec::new();
        for place in places {
            let sine = (place - middle) / swing;
            if (sine.abs() - 1.0).abs() * width < NEAR {
                // The crank is slow there, and remains near for some time.
                times.extend(grid.iter().filter(|t| (t.sin() - sine).abs() * width < NEAR));
                let steps = ((3.0 * NEAR / width).sqrt() / NEAR) as i32;
                for turn in -3..3 {
                    let turn = FRAC_PI_2 * sine.signum() + TAU * f64::from(turn);
                    times.extend((-steps..=steps).map(|k| turn + NEAR * f64::from(k)));
                }
            }
            if sine.abs() < 1.0 {
                let first = sine.asin();
                times.extend((-3..3).flat_map(|turn| [first, PI - first].map(|t| t + TAU * f64::from(turn))));
            }
        }
        times.retain(|t| *t > end.min(0.0) - 0.1 && *t < end.max(0.0) + 0.1);
        times
    };
    let [folds, crossings] = bar.places(middle - width, middle + width);
    let (crossings, folds) =
        (in_time(crossings), if folds.is_empty() { folds } else { fold_times(&folds, middle, swing) });
    let mechanism = Swinging { a, b, c, d, middle, swing };
    Case::new(mechanism, branch, [folds, crossings], format!("sign {sign}"))
}

/// The times at which the crank passes a fold; none if it reverses before the fold.
fn fold_times(folds: &[f64], middle: f64, swing: f64) -> Vec<f64> {
    let sines = folds.iter().map(|place| (place - middle) / swing).filter(|sine| sine.abs() < 1.0);
    sines
        .flat_map(|sine| {
            let first = sine.asin();
            (-3..3).flat_map(move |turn| [first, PI - first].map(|t| t + TAU * f64::from(turn)))
        })
        .collect()
}

/// Four cranks that swing to within 10^-2 to 10^-10 of the fold or crossing, on either side.
fn drawn(random: &mut Random, fold: bool) -> Group<Swinging> {
    let end = random.sign() * random.between(2.0, 5.0);
    let mut times = random.grid(end);
    random.hit(&mut times, if end > 0.0 { FRAC_PI_2 } else { -3.0 * FRAC_PI_2 });
    let mut cases = Vec::new();
    while cases.len() < 4 {
        let (bar, place) = if fold {
            let outer = random.chance(0.5);
            let mut bar = near_a_crossing(random, outer, 0.0);
            bar.d += random.between(-0.2, 0.2);
            let at = if outer { PI } else { TAU };
            let [folds, _] = bar.places(at - 2.0, at + 2.0);
            let Some(place) = folds.first().copied() else { continue };
            (bar, place)
        } else {
            crossing(random)
        };
        // The crank reverses at this place, and comes from the side on which the mechanism closes.
        let from = random.sign() * random.between(0.3, 1.0);
        let off = if !fold && random.chance(0.1) { 0.0 } else { random.small(-10.0, -2.0) };
        let (middle, swing) = (place + from, -from * (1.0 + off));
        let way = (1..40).map(|k| middle + swing * f64::from(k) / 41.0);
        if bar.d > 0.1 && bar.is_free(middle, 0.05) && way.into_iter().all(|phi| bar.is_free(phi, 0.0)) {
            cases.push(swinging(bar, middle, swing, &times));
        }
    }
    Group::new(times, cases)
}

#[test]
fn cranks_that_turn_at_a_fold() {
    let (mut random, mut tally) = (Random::new(281), Tally::default());
    for _ in 0..motions(0.06).div_ceil(4) {
        follow(&mut tally, &drawn(&mut random, true));
    }
    tally.obeys("cranks that turn at a fold");
}

#[test]
fn cranks_that_turn_at_a_crossing() {
    let (mut random, mut tally) = (Random::new(282), Tally::default());
    for _ in 0..motions(0.06).div_ceil(4) {
        follow(&mut tally, &drawn(&mut random, false));
    }
    tally.obeys("cranks that turn at a crossing");
}
