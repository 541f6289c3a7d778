//! Booms on cylinders that extend to their ends and retract; the cylinder's length is given as a function of time, or
//! one instant at a time.

use crate::case::{Case, Group, Sampled};
use crate::closure::dyadic;
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::{Signal, mechanism};
use kin_tests::random::Random;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// Two booms side by side, whose cylinders have the same length.
#[mechanism]
#[input(ram)]
#[bodies(boom, other)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[distance(cylinder: ground @ (foot, 0), boom @ (arm, 0), length = ram)]
#[revolute(second_pin: ground @ (0, 1), other @ (0, 0))]
#[distance(second_cylinder: ground @ (foot2, 1), other @ (arm2, 0), length = ram)]
#[derive(Clone, Debug)]
struct Booms {
    foot: f64,
    arm: f64,
    foot2: f64,
    arm2: f64,
}

/// The length of the cylinders, middle + stroke sin t.
#[derive(Clone, Copy, Debug)]
struct Ram {
    middle: f64,
    stroke: f64,
}

/// One boom: the distances from the ground pin to the cylinder's foot and to the cylinder's pin on the boom, and the
/// sign of its branch.
#[derive(Clone, Copy, Debug)]
struct Boom {
    foot: f64,
    arm: f64,
    sign: f64,
}

impl Boom {
    /// The differences between the longest length that the boom allows and the longest of the cylinder, and between the
    /// shortest of the cylinder and the shortest allowed.
    fn spare(self, Ram { middle, stroke }: Ram) -> [f64; 2] {
        [self.foot + self.arm - (middle + stroke), (middle - stroke) - (self.foot - self.arm).abs()]
    }

    /// The angle β: with U = (f + a)² − e² and V = e² − (f − a)², tan ½β is √V / √U. Where the cylinder just reaches
    /// its end, U or V is a square, and its root changes sign. If the length is only known at single instants
    /// (`sampled`), this cannot be seen, and the sign remains.
    fn angle(self, ram: Ram, t: Jet, off: f64, sampled: bool) -> Option<Jet> {
        let Self { foot, arm, sign } = self;
        let t = t * (1.0 + off);
        let length = t.sin() * ram.stroke + ram.middle;
        let root = |spare: f64, wave: Jet, other: Jet| {
            let wave = wave * (2.0 * ram.stroke).sqrt();
            if spare == 0.0 && !sampled {
                return Some(wave * other.sqrt());
            }
            let square = (wave * wave + (spare + off)) * other;
            (square.x > 0.0).then(|| square.sqrt())
        };
        let [long, short] = self.spare(ram);
        let u = root(long, (-t * 0.5 + FRAC_PI_4).sin(), length + (foot + arm))?;
        let v = root(short, (t * 0.5 + FRAC_PI_4).sin(), length + (foot - arm).abs())?;
        Some((v * sign).atan2(u) * 2.0)
    }

    /// The times at which the branch ends, at which it crosses another one, and at which the cylinder is near its end.
    fn places(self, ram: Ram, end: f64) -> [Vec<f64>; 3] {
        let [mut folds, mut crossings, mut near] = [const { Vec::new() }; 3];
        for (spare, at) in self.spare(ram).into_iter().zip([FRAC_PI_2, -FRAC_PI_2]) {
            for turn in -3..=3 {
                let place = at + TAU * f64::from(turn);
                if place < end.min(0.0) - PI || place > end.max(0.0) + PI {
                    continue;
                }
                if spare.abs() < 1e-4 {
                    near.push(place);
                }
                if spare == 0.0 {
                    crossings.push(place);
                } else if spare < 0.0 {
                    let width = 2.0 * (-0.5 * spare / ram.stroke).sqrt().min(1.0).asin();
                    folds.extend([place - width, place + width]);
                }
            }
        }
        [folds, crossings, near]
    }

    /// A boom with one of its ends at the distance `off` from an end of the cylinder.
    fn drawn(random: &mut Random, ram: Ram, off: f64) -> Self {
        loop {
            let (long, short) = (ram.middle + ram.stroke, ram.middle - ram.stroke);
            let foot = dyadic(random.between(0.3, 1.2));
            let stretched = random.chance(0.6);
            let arm = if stretched { long - foot } else { foot + random.sign() * short };
            let arm = arm + if stretched { off } else { off * (foot - arm).signum() };
            let boom = Self { foot, arm, sign: random.sign() };
            // The other end of the boom is far away, or is never reached.
            let spare = boom.spare(ram)[usize::from(stretched)];
            if arm > 0.1 && (spare > 0.02 || spare < -0.02 && -spare < ram.stroke) {
                return boom;
            }
        }
    }
}

fn booms([one, other]: [Boom; 2], ram: Ram, end: f64) -> Case<Booms> {
    let branch = move |sampled: bool| {
        move |t: f64, off: f64| {
            let t = Jet::time(t);
            let (zero, phi) = (Jet::default(), one.angle(ram, t, off, sampled)?);
            Some(vec![zero, zero, phi, zero, Jet::from(1.0), other.angle(ram, t, off, sampled)?])
        }
    };
    let [mut folds, mut crossings, mut near] = one.places(ram, end);
    let [more_folds, more_crossings, more_near] = other.places(ram, end);
    folds.extend(more_folds);
    crossings.extend(more_crossings);
    near.extend(more_near.into_iter().chain(folds.iter().copied()));
    let sampled = if crossings.is_empty() {
        Sampled::As { branch: Box::new(branch(true)), places: near }
    } else {
        // Whether a cylinder with sampled lengths has just reached its end between two samples is unknown.
        Sampled::Unknown
    };
    let mechanism = Booms { foot: one.foot, arm: one.arm, foot2: other.foot, arm2: other.arm };
    let note = format!("{one:?} {other:?} {ram:?}");
    Case { sampled, ..Case::new(mechanism, branch(false), [folds, crossings], note) }
}

fn drawn(random: &mut Random) -> Group<Booms> {
    let end = random.sign() * random.between(2.0, 7.0);
    let mut times = random.grid(end);
    random.hit(&mut times, end.signum() * FRAC_PI_2);
    let ram = Ram { middle: dyadic(random.between(0.6, 1.2)), stroke: dyadic(random.between(0.1, 0.4)) };
    let mut one = || {
        let off = if random.chance(0.15) { 0.0 } else { random.small(-10.0, -2.0) };
        let first = Boom::drawn(random, ram, off);
        let other = match random.whole(0, 2) {
            0 => Boom { sign: random.sign(), ..first },
            1 => Boom::drawn(random, ram, off),
            _ => {
                let off = random.small(-10.0, -2.0);
                Boom::drawn(random, ram, off)
            }
        };
        booms([first, other], ram, end)
    };
    let cases = [one(), one(), one(), one()].into();
    let inputs = move |t: f64, inputs: &mut [Signal]| {
        let (sin, cos) = t.sin_cos();
        inputs[0] = Signal::new(ram.middle + ram.stroke * sin, ram.stroke * cos, -ram.stroke * sin);
    };
    Group { times, cases, inputs: Box::new(inputs) }
}

#[test]
fn cylinders_to_their_ends_and_back() {
    let (mut random, mut tally) = (Random::new(261), Tally::default());
    for _ in 0..motions(0.1).div_ceil(4) {
        follow(&mut tally, &drawn(&mut random));
    }
    tally.obeys("cylinders");
}
