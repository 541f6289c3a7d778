//! One loop whose branches cross exactly, or come near to it: parallelograms, their crossed counterparts, kites, other
//! four-bars with a change point, slider-cranks with a rod as long as the crank.

use crate::case::{Case, Group};
use crate::closure::FourBar;
use crate::draw::{Draw, near_a_crossing};
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A four-bar whose frames are at the ends of its links.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(D: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = start + t)]
#[derive(Clone, Debug)]
pub(crate) struct Ends {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    start: f64,
}

/// The same with frames in the middle of the links, and the coupler a distance.
#[mechanism]
#[bodies(crank, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (-a/2, 0))]
#[distance(coupler: crank @ (a/2, 0), rocker @ (c/2, 0), length = b)]
#[revolute(D: ground @ (d, 0), rocker @ (-c/2, 0))]
#[driver(drive: crank.phi = start + t)]
#[derive(Clone, Debug)]
pub(crate) struct Middles {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    start: f64,
}

/// The same by two equations for three angles.
#[mechanism]
#[coordinates(phi1, phi2, phi3)]
#[constraint(close_x: a*cos(phi1) + b*cos(phi2) - c*cos(phi3) = d)]
#[constraint(close_y: a*sin(phi1) + b*sin(phi2) - c*sin(phi3) = 0)]
#[driver(drive: phi1 = start + t)]
#[derive(Clone, Debug)]
pub(crate) struct Angles {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    start: f64,
}

/// A slider-crank.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = start + t)]
#[derive(Clone, Debug)]
pub(crate) struct Slider {
    r: f64,
    l: f64,
    start: f64,
}

/// Mechanisms that are one four-bar, with the coordinates that its three angles give.
pub(crate) trait Bar: Sized {
    fn new(bar: FourBar, start: f64) -> Self;
    fn coordinates(bar: FourBar, angles: [Jet; 3]) -> Vec<Jet>;

    fn case(bar: FourBar, start: f64, span: [f64; 2]) -> Case<Self> {
        let [folds, crossings] = bar.places(start + span[0], start + span[1]);
        let branch = move |t: f64, off: f64| {
            let phi = Jet::time(t) + start;
            let [coupler, rocker] = bar.close(phi, off)?;
            Some(Self::coordinates(bar, [phi, coupler, rocker]))
        };
        let in_time = |places: Vec<f64>| places.into_iter().map(|place| place - start).collect();
        let note = format!("sign {}", bar.sign);
        Case::new(Self::new(bar, start), branch, [folds, crossings].map(in_time), note)
    }
}

impl Bar for Ends {
    fn new(FourBar { a, b, c, d, .. }: FourBar, start: f64) -> Self {
        Self { a, b, c, d, start }
    }

    fn coordinates(FourBar { a, d, .. }: FourBar, [phi, coupler, rocker]: [Jet; 3]) -> Vec<Jet> {
        let zero = Jet::default();
        vec![zero, zero, phi, phi.cos() * a, phi.sin() * a, coupler, Jet::from(d), zero, rocker]
    }
}

impl Bar for Middles {
    fn new(FourBar { a, b, c, d, .. }: FourBar, start: f64) -> Self {
        Self { a, b, c, d, start }
    }

    fn coordinates(FourBar { a, c, d, .. }: FourBar, [phi, _, rocker]: [Jet; 3]) -> Vec<Jet> {
        let (a, c) = (a / 2.0, c / 2.0);
        vec![phi.cos() * a, phi.sin() * a, phi, rocker.cos() * c + d, rocker.sin() * c, rocker]
    }
}

impl Bar for Angles {
    fn new(FourBar { a, b, c, d, .. }: FourBar, start: f64) -> Self {
        Self { a, b, c, d, start }
    }

    fn coordinates(_: FourBar, angles: [Jet; 3]) -> Vec<Jet> {
        angles.into()
    }
}

/// x = r cos φ ± √W with W = l² − r² sin² φ = (l − r)(l + r) + r² cos² φ, which is a square where rod and crank are equal.
pub(crate) fn slider([r, l]: [f64; 2], sign: f64, start: f64, [from, to]: [f64; 2]) -> Case<Slider> {
    let branch = move |t: f64, off: f64| {
        let phi = (Jet::time(t) + start) * (1.0 + off);
        let (sin, cos) = (phi.sin() * r, phi.cos() * r);
        let constant = if l == r { 0.0 } else { (l - r + off * l) * (l + r) };
        let root = if constant == 0.0 {
            cos
        } else {
            let square = cos * cos + constant;
            (square.x > 0.0).then(|| square.sqrt())?
        };
        let rod = (-sin).atan2(root * sign);
        let zero = Jet::default();
        Some(vec![zero, zero, phi, cos, sin, rod, cos + root * sign, zero, zero])
    };
    let (mut folds, mut crossings) = (Vec::new(), Vec::new());
    let width = if l < r { (((r - l) * (r + l)).sqrt() / r).asin() } else { 0.0 };
    for turn in -4..=4 {
        for side in [-width, width] {
            let place = FRAC_PI_2 + PI * f64::from(turn) + side - start;
            if l <= r && from.min(to) - 0.1 < place && place < from.max(to) + 0.1 {
                if l == r { &mut crossings } else { &mut folds }.push(place);
            }
        }
    }
    Case::new(Slider { r, l, start }, branch, [folds, crossings], format!("sign {sign}"))
}

/// A four-bar that crosses exactly: a parallelogram, a kite of either kind, or any other.
pub(crate) fn crossing(random: &mut Random) -> (FourBar, f64) {
    let (a, b, sign) = (random.length(), random.length(), random.sign());
    match random.whole(0, 3) {
        0 if (a - b).abs() > 0.02 => (FourBar { a, b, c: a, d: b, sign }, PI * f64::from(random.whole(1, 2) as u8)),
        1 if (a - b).abs() > 0.02 => (FourBar { a, b: a, c: b, d: b, sign }, PI * f64::from(random.whole(1, 2) as u8)),
        // The longer pair of a kite about the moving pin: the crank's pin never meets the ground pin on the way.
        2 if b > a + 0.02 => (FourBar { a, b, c: b, d: a, sign }, TAU),
        _ => {
            let outer = random.chance(0.5);
            (near_a_crossing(random, outer, 0.0), if outer { PI } else { TAU })
        }
    }
}

/// Four of them over one grid that leads each past its crossing; `off` is what the ground link is too long by.
fn four_bars<M: Bar>(random: &mut Random, exact: bool) -> Group<M> {
    let end = random.sign() * random.between(1.5, 6.5);
    let times = random.grid(end);
    let mut cases = Vec::new();
    while cases.len() < 4 {
        let (mut bar, limit) = crossing(random);
        if !exact {
            // Of a four-bar with two crossings, both are near now.
            bar.d += random.small(-9.0, -3.0);
        }
        let start = limit - end * random.between(0.05, 0.9);
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
        let start = FRAC_PI_2 - end * random.between(0.05, 0.9);
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

/// At a crossing, the branch that is called the same one goes on with the velocity that it came with.
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
