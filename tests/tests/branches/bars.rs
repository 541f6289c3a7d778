//! Mechanisms with a single loop: a four-bar in three formulations, and a slider-crank.

use crate::case::Case;
use crate::closure::FourBar;
use crate::jet::Jet;
use kin_runtime::mechanism;
use std::f64::consts::{FRAC_PI_2, PI};

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

/// The four-bar with frames in the middle of the links, and a massless coupler as a distance.
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

/// The four-bar by two equations for three angles.
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

/// Mechanisms that are a single four-bar, whose coordinates follow from its three angles.
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
