//! Crossings of branches in groups that are solved by iteration, where all entries of a row vanish together: loops like
//! parallelograms whose last side is a rope, a disc, or hidden in equations, and a curve that crosses itself.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::{Kinematics, mechanism};
use kin_tests::random::Random;
use std::f64::consts::PI;
use std::fmt::Debug;

/// Two cranks and a rope between their pins, which stays as long as the distance of the pivots. It comes along the first
/// crank: a rope between two points alone would have a closed form.
#[mechanism]
#[bodies(a, b)]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[revolute(P: ground @ (d, 0), b @ (0, 0))]
#[rope(K: a @ (0, 0), a @ (r, 0), b @ (r, 0), length = r + d)]
#[driver(drive: a.phi = start + speed * t)]
#[guess(a.phi = start, b.phi = start)]
#[derive(Clone, Debug)]
struct Rope {
    d: f64,
    r: f64,
    start: f64,
    speed: f64,
}

/// The same with a pin on a circle around the other.
#[mechanism]
#[bodies(a, b)]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[revolute(P: ground @ (d, 0), b @ (0, 0))]
#[on_curve(K: a @ (r, 0), b @ (r, 0), polar(theta) = d)]
#[driver(drive: a.phi = start + speed * t)]
#[guess(a.phi = start, b.phi = start)]
#[derive(Clone, Debug)]
struct Disc {
    d: f64,
    r: f64,
    start: f64,
    speed: f64,
}

/// The loop equations of a parallelogram, with a term that is always 0.
#[mechanism]
#[coordinates(p, c, q)]
#[constraint(x: r * cos(p) + d * cos(c) + w * sin(c - q) - r * cos(q) = d)]
#[constraint(y: r * sin(p) + d * sin(c) - r * sin(q) = 0)]
#[driver(drive: p = start + speed * t)]
#[guess(p = start, c = 0, q = start)]
#[derive(Clone, Debug)]
struct Equations {
    d: f64,
    r: f64,
    start: f64,
    speed: f64,
    w: f64,
}

/// A lemniscate, in numbers.
#[mechanism]
#[coordinates(u, v)]
#[constraint(curve: pow(u * u + v * v, 2) = s * s * (u * u - v * v))]
#[driver(drive: v = start + speed * t)]
#[guess(u = first, v = start)]
#[derive(Clone, Debug)]
struct Numbers {
    s: f64,
    first: f64,
    start: f64,
    speed: f64,
}

/// A pin in a slot of this shape.
#[mechanism]
#[body(pin, phi = 0)]
#[on_curve(K: ground @ (0, 0), pin @ (0, 0), implicit(X, Y) = pow(X * X + Y * Y, 2) - s * s * (X * X - Y * Y))]
#[driver(drive: pin.y = start + speed * t)]
#[guess(pin.x = first, pin.y = start)]
#[derive(Clone, Debug)]
struct Slot {
    s: f64,
    first: f64,
    start: f64,
    speed: f64,
}

/// Random motions at the angle start + speed t, past at least one multiple of π.
fn past_change_points<M: Kinematics + Sync + Clone + Debug>(
    family: &str,
    seed: u64,
    of: impl Fn([f64; 4]) -> M,
    q: fn(d: f64, angle: Jet) -> Vec<Jet>,
) {
    let (mut random, mut tally) = (Random::new(seed), Tally::default());
    for _ in 0..motions(0.1) {
        let end = random.sign() * random.between(0.6, 3.0);
        let times = random.grid(end);
        let first = random.meeting(&times, 0.05, 0.9);
        let (d, r, speed) = (random.between(0.4, 1.2), random.between(0.2, 0.35), random.sign());
        let start = PI * f64::from(random.whole(0, 1) as u8) - speed * first;
        let crossings = (-3..=3).map(|turn| (PI * f64::from(turn) - start) / speed);
        let branch = move |t: f64, off: f64| Some(q(d, Jet::time(t) * (speed * (1.0 + off)) + start));
        let case = Case::new(of([d, r, start, speed]), branch, [vec![], crossings.collect()], String::new());
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys(family);
}

fn of_cranks(d: f64, angle: Jet) -> Vec<Jet> {
    let zero = Jet::from(0.0);
    vec![zero, zero, angle, Jet::from(d), zero, angle]
}

#[test]
fn a_rope_does_not_hide_a_change_point() {
    past_change_points("ropes", 2101, |[d, r, start, speed]| Rope { d, r, start, speed }, of_cranks);
}

#[test]
fn a_disc_does_not_hide_a_change_point() {
    past_change_points("discs", 2102, |[d, r, start, speed]| Disc { d, r, start, speed }, of_cranks);
}

#[test]
fn equations_do_not_hide_a_change_point() {
    let of = |[d, r, start, speed]: [f64; 4]| Equations { d, r, start, speed, w: 0.0 };
    past_change_points("equations", 2103, of, |_, angle| vec![angle, Jet::from(0.0), angle]);
}

/// The equation of a parallelogram between the angles of its cranks, after Freudenstein.
#[mechanism]
#[coordinates(p, q)]
#[constraint(sides: 2 * r * r + 2 * d * r * (cos(q) - cos(p)) - 2 * r * r * cos(p - q) = 0)]
#[driver(drive: p = turn - swing * (1 - cos(t - back)))]
#[guess(p = turn - swing * (1 - cos(back)), q = turn - swing * (1 - cos(back)))]
#[derive(Clone, Debug)]
struct Reversing {
    d: f64,
    r: f64,
    turn: f64,
    swing: f64,
    back: f64,
}

/// A crank that turns back just beyond a change point, so that a step may pass the point twice.
#[test]
fn a_motion_that_turns_back_does_not_hide_a_change_point() {
    let (mut random, mut tally) = (Random::new(2106), Tally::default());
    for _ in 0..motions(0.2) {
        let end = random.between(1.5, 3.0);
        let times = random.grid(end);
        let back = random.between(0.4, 0.6) * end;
        let (d, r, swing) =
            (random.between(0.4, 1.2), random.between(0.2, 0.35), random.sign() * random.between(0.5, 2.0));
        let beyond = 10_f64.powf(random.between(-2.0, -0.5));
        let turn = PI * f64::from(random.whole(0, 1) as u8) + swing.signum() * beyond;
        let branch = move |t: f64, off: f64| {
            let angle = ((Jet::time(t) * (1.0 + off) - back).cos() - 1.0) * swing + turn;
            Some(vec![angle, angle])
        };
        let before = (1.0 - beyond / swing.abs()).acos();
        let crossings = vec![back - before, back + before];
        let case = Case::new(Reversing { d, r, turn, swing, back }, branch, [vec![], crossings], String::new());
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys("cranks that turn back");
}

/// Random motions along the lemniscate of size s, past its double point. On the arc through it
///
/// ```text
/// u = ± v √((2 + 2z)/(1 − 2z + √(1 − 8z))),   z = v²/s²
/// ```
fn past_a_double_point<M: Kinematics + Sync + Clone + Debug>(family: &str, seed: u64, of: impl Fn([f64; 4]) -> M) {
    let (mut random, mut tally) = (Random::new(seed), Tally::default());
    for _ in 0..motions(0.1) {
        let end = random.sign() * random.between(0.6, 3.0);
        let times = random.grid(end);
        // An instant may be at the double point, but not so near to it that accelerations are rounding noise.
        let first = loop {
            let first = random.meeting(&times, 0.05, 0.9);
            if times.iter().all(|t| *t == first || (t - first).abs() > 1e-5) {
                break first;
            }
        };
        let (s, sign) = (random.between(0.5, 2.0), random.sign());
        let fold = s / 8.0_f64.sqrt();
        let start = random.sign() * random.between(0.1, 0.7) * fold;
        let speed = -start / first;
        let branch = move |t: f64, off: f64| {
            let v = Jet::time(t) * (speed * (1.0 + off)) + start;
            let z = v * v / (s * s);
            let inside = -(z * 8.0) + 1.0;
            if inside.x <= 0.0 {
                return None;
            }
            let square = (z * 2.0 + 2.0) / (-(z * 2.0) + inside.sqrt() + 1.0);
            Some(vec![v * square.sqrt() * sign, v])
        };
        let u = branch(0.0, 0.0).map_or(0.0, |at| at[0].x);
        let folds = [fold, -fold].map(|fold| (fold - start) / speed).into_iter().filter(|t| t * end > 0.0).collect();
        let mechanism = of([s, u, start, speed]);
        let case = Case::new(mechanism, branch, [folds, vec![first]], String::new());
        follow(&mut tally, &Group::new(times, vec![case]));
    }
    tally.obeys(family);
}

#[test]
fn a_curve_that_crosses_itself_in_numbers() {
    past_a_double_point("lemniscates", 2104, |[s, first, start, speed]| Numbers { s, first, start, speed });
}

#[test]
fn a_slot_that_crosses_itself() {
    past_a_double_point("slots like lemniscates", 2105, |[s, first, start, speed]| Slot { s, first, start, speed });
}
