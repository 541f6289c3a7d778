//! Scissor lifts that are pulled nearly flat, exactly flat, or farther than is possible.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::mechanism;
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

macro_rules! lift {
    ($Name:ident, $stages:tt, $less:tt) => {
        /// A scissor lift with arms of length 1, whose sliding foot is pulled along the floor.
        #[mechanism]
        #[bodies(left[$stages], right[$stages])]
        #[revolute(foot: ground @ (0, 0), left[0] @ (-0.5, 0))]
        #[y(slide: right[0] @ (-0.5, 0) = 0)]
        #[revolute(middle[i in 0..$stages]: left[i] @ (0, 0), right[i] @ (0, 0))]
        #[revolute(near[i in 0..$less]: left[i] @ (0.5, 0), right[i + 1] @ (-0.5, 0))]
        #[revolute(far[i in 0..$less]: right[i] @ (0.5, 0), left[i + 1] @ (-0.5, 0))]
        #[driver(pull: distance(ground @ (0, 0), right[0] @ (-0.5, 0)) = 0.95 + amplitude * sin(t))]
        #[derive(Clone, Debug)]
        struct $Name {
            amplitude: f64,
        }

        impl Lift for $Name {
            const STAGES: usize = $stages;

            fn new(amplitude: f64) -> Self {
                Self { amplitude }
            }
        }
    };
}

/// A lift of `STAGES` stages.
trait Lift: Sized {
    const STAGES: usize;
    fn new(amplitude: f64) -> Self;
}

/// A lift of one stage, which has no joints between stages.
#[mechanism]
#[bodies(left, right)]
#[revolute(foot: ground @ (0, 0), left @ (-0.5, 0))]
#[y(slide: right @ (-0.5, 0) = 0)]
#[revolute(middle: left @ (0, 0), right @ (0, 0))]
#[driver(pull: distance(ground @ (0, 0), right @ (-0.5, 0)) = 0.95 + amplitude * sin(t))]
#[derive(Clone, Debug)]
struct One {
    amplitude: f64,
}

impl Lift for One {
    const STAGES: usize = 1;

    fn new(amplitude: f64) -> Self {
        Self { amplitude }
    }
}

lift!(Two, 2, 1);
lift!(Three, 3, 2);

/// The pull is cos α: 1 − cos α = 0.05 − A sin t = (0.05 − A) + 2A sin²(¼π − ½t), and sin²(½α) is half of that. For A =
/// 0.05, sin ½α = √A sin(¼π − ½t) passes through 0.
fn lift<M: Lift>(amplitude: f64, sign: f64, end: f64) -> Case<M> {
    let spare = if (amplitude - 0.05).abs() < 1e-15 { 0.0 } else { 0.05 - amplitude };
    let branch = move |t: f64, off: f64| {
        let wave = (Jet::from(0.5 * FRAC_PI_2) - Jet::time(t) * (0.5 * (1.0 + off))).sin() * amplitude.sqrt();
        let half = if spare == 0.0 {
            wave
        } else {
            let square = wave * wave + 0.5 * (spare + 0.1 * off);
            (square.x > 0.0).then(|| square.sqrt())?
        };
        let half = half * sign;
        let alpha = half.atan2((-half * half + 1.0).sqrt()) * 2.0;
        let (sin, cos) = (alpha.sin(), alpha.cos());
        let arms = |angle: Jet| {
            let centre = move |stage: usize| [cos * 0.5, sin * (stage as f64 + 0.5), angle];
            (0..M::STAGES).flat_map(centre)
        };
        Some(arms(alpha).chain(arms(-alpha + PI)).collect())
    };
    // The first time at which the lift locks.
    let width = if spare < 0.0 { 2.0 * (-0.5 * spare / amplitude).sqrt().asin() } else { 0.0 };
    let first = if end > 0.0 { FRAC_PI_2 } else { -3.0 * FRAC_PI_2 };
    let places = vec![first - width, first + width];
    let (folds, crossings) = if spare < 0.0 { (places, vec![]) } else { (vec![], places) };
    // If the lift does not become flat, no branches cross.
    let crossings = if spare > 0.0 { vec![] } else { crossings };
    Case::new(M::new(amplitude), branch, [folds, crossings], format!("sign {sign}"))
}

/// Four lifts over one grid, which are pulled beyond flat or short of flat by 10^-2 to 10^-10 of the stroke, or exactly
/// flat.
fn drawn<M: Lift>(random: &mut Random) -> Group<M> {
    let end = if random.chance(0.5) { random.between(2.0, 4.5) } else { -random.between(5.0, 7.5) };
    let mut times = random.grid(end);
    random.hit(&mut times, if end > 0.0 { FRAC_PI_2 } else { -3.0 * FRAC_PI_2 });
    let mut one = || {
        let off = if random.chance(0.1) { 0.0 } else { random.small(-10.0, -2.0) };
        lift(0.05 * (1.0 + off), random.sign(), end)
    };
    let cases = [one(), one(), one(), one()].into();
    Group::new(times, cases)
}

#[test]
fn scissor_lifts_near_the_floor() {
    let (mut random, mut tally) = (Random::new(231), Tally::default());
    for _ in 0..motions(0.15).div_ceil(12) {
        follow(&mut tally, &drawn::<One>(&mut random));
        follow(&mut tally, &drawn::<Two>(&mut random));
        follow(&mut tally, &drawn::<Three>(&mut random));
    }
    tally.obeys("scissor lifts");
}

/// Sweeps from 0 to 3 in 30 and in 100 steps; the lift locks at t = 1.5645.
#[test]
fn a_lift_of_two_stages_locks() {
    let mut tally = Tally::default();
    for steps in [30, 100] {
        let times = (0..=steps).map(|k| 3.0 * f64::from(k) / f64::from(steps)).collect();
        let case = lift::<Two>(0.050_001, 1.0, 3.0);
        assert!((case.folds[0] - 1.5645).abs() < 1e-4);
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys("a lift of two stages");
}
