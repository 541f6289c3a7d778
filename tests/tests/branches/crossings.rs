//! Single loops whose branches cross exactly or nearly: parallelograms, antiparallelograms, kites, other four-bars with
//! a change point, and slider-cranks with a rod as long as the crank.

use crate::bars::{Angles, Bar, Ends, Middles, Slider, slider};
use crate::case::Group;
use crate::closure::FourBar;
use crate::draw::{Draw, near_a_crossing};
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A four-bar with an exact crossing: a parallelogram, a kite of either kind, or another four-bar; and its crank angle
/// there.
pub(crate) fn crossing(random: &mut Random) -> (FourBar, f64) {
    let (a, b, sign) = (random.length(), random.length(), random.sign());
    match random.whole(0, 3) {
        0 if (a - b).abs() > 0.02 => (FourBar { a, b, c: a, d: b, sign }, PI * f64::from(random.whole(1, 2) as u8)),
        1 if (a - b).abs() > 0.02 => (FourBar { a, b: a, c: b, d: b, sign }, PI * f64::from(random.whole(1, 2) as u8)),
        // The moving pin is between the longer sides of the kite, so that the crank's pin never meets the ground pin.
        2 if b > a + 0.02 => (FourBar { a, b, c: b, d: a, sign }, TAU),
        _ => {
            let outer = random.chance(0.5);
            (near_a_crossing(random, outer, 0.0), if outer { PI } else { TAU })
        }
    }
}

/// Four of them over one grid of times that leads each past its crossing; unless `exact`, the ground link is slightly
/// too long or too short.
fn four_bars<M: Bar>(random: &mut Random, exact: bool) -> Group<M> {
    let end = random.sign() * random.between(1.5, 6.5);
    let times = random.grid(end);
    let mut cases = Vec::new();
    while cases.len() < 4 {
        let (mut bar, limit) = crossing(random);
        if !exact {
            // In a four-bar with two crossings, both are now inexact.
            bar.d += random.small(-9.0, -3.0);
        }
        let start = limit - random.meeting(&times, 0.05, 0.9);
        if bar.is_free(start, 0.05) {
            cases.push(M::case(bar, start, [0.0, end]));
        }
    }
    Group::new(times, cases)
}

fn sliders(random: &mut Random, exact: bool) -> Group<Slider> {
    let end = random.sign() * random.between(1.5, 6.5);
    let times = random.grid(end);
    let mut cases = Vec::new();
    while cases.len() < 4 {
        let r = random.length();
        let l = if exact { r } else { r + random.small(-9.0, -3.0) };
        let start = FRAC_PI_2 - random.meeting(&times, 0.05, 0.9);
        if start.cos().abs() > 0.06 {
            cases.push(slider([r, l], random.sign(), start, [0.0, end]));
        }
    }
    Group::new(times, cases)
}

#[test]
fn exact_crossings_of_four_bars() {
    let (mut random, mut tally) = (Random::new(211), Tally::default());
    for _ in 0..motions(0.15).div_ceil(12) {
        follow(&mut tally, &four_bars::<Ends>(&mut random, true));
        follow(&mut tally, &four_bars::<Middles>(&mut random, true));
        follow(&mut tally, &four_bars::<Angles>(&mut random, true));
    }
    tally.obeys("exact crossings of four-bars");
}

#[test]
fn near_crossings_of_four_bars() {
    let (mut random, mut tally) = (Random::new(212), Tally::default());
    for _ in 0..motions(0.1).div_ceil(12) {
        follow(&mut tally, &four_bars::<Ends>(&mut random, false));
        follow(&mut tally, &four_bars::<Middles>(&mut random, false));
        follow(&mut tally, &four_bars::<Angles>(&mut random, false));
    }
    tally.obeys("near crossings of four-bars");
}

#[test]
fn slider_cranks_of_equal_lengths() {
    let (mut random, mut tally) = (Random::new(213), Tally::default());
    for round in 0..motions(0.1).div_ceil(4) {
        follow(&mut tally, &sliders(&mut random, round % 2 == 0));
    }
    tally.obeys("slider-cranks");
}

/// At a crossing, the branch with the same closed form continues with the same velocity.
#[test]
fn closed_forms_are_smooth_at_crossings() {
    let mut random = Random::new(214);
    let mut seen = 0;
    for _ in 0..500 {
        let (bar, limit) = crossing(&mut random);
        let [start, r] = [limit - 1.0, random.length()];
        let slider = slider([r, r], random.sign(), 0.5, [0.0, 6.0]);
        for (branch, crossings) in [Ends::case(bar, start, [0.0, 6.0])]
            .map(|case| (case.branch, case.crossings))
            .into_iter()
            .chain([(slider.branch, slider.crossings)])
        {
            for place in crossings {
                let [Some(before), Some(behind)] = [-1e-6, 1e-6].map(|h| branch(place + h, 0.0)) else { continue };
                for (a, b) in before.iter().zip(&behind) {
                    let fast = 1.0 + a.v.abs();
                    assert!((a.v - b.v).abs() < 1e-3 * fast, "{bar:?} at {place}: {} and {}", a.v, b.v);
                    assert!((a.x - b.x).sin().abs() < 1e-5 * fast, "{bar:?} at {place}: {} and {}", a.x, b.x);
                }
                seen += 1;
            }
        }
    }
    assert!(seen > 1000, "{seen} crossings");
}
