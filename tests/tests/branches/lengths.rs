//! Motions in which nothing turns: carriages and struts that carry a pin, a trammel, a slot that is turned by time, and
//! quadratic equations. No rotation of a body limits the steps, so between two instants such a group could pass its
//! limit and come back.

use crate::case::{Case, Group};
use crate::draw::Draw;
use crate::jet::Jet;
use crate::tally::{Tally, motions};
use crate::ways::follow;
use kin_runtime::{Kinematics, mechanism};
use kin_tests::random::Random;
use std::fmt::Debug;

/// A pin on two links from carriages on a common rail.
#[mechanism]
#[body(a, y = 0, phi = 0)]
#[body(b, y = 0, phi = 0)]
#[body(pin, phi = 0)]
#[distance(left: a @ (0, 0), pin @ (0, 0), length = l[0])]
#[distance(right: b @ (0, 0), pin @ (0, 0), length = l[1])]
#[driver(pull: a.x = first[0] + first[1] * sin(first[2] * t + first[3]))]
#[driver(push: b.x = other[0] + other[1] * sin(other[2] * t + other[3]))]
#[derive(Clone, Debug)]
struct Carriages {
    l: [f64; 2],
    first: [f64; 4],
    other: [f64; 4],
}

/// The same with an unknown of an iteration beside it.
#[mechanism]
#[body(a, y = 0, phi = 0)]
#[body(b, y = 0, phi = 0)]
#[body(pin, phi = 0)]
#[coordinates(s)]
#[distance(left: a @ (0, 0), pin @ (0, 0), length = l[0])]
#[distance(right: b @ (0, 0), pin @ (0, 0), length = l[1])]
#[driver(pull: a.x = first[0] + first[1] * sin(first[2] * t + first[3]))]
#[driver(push: b.x = other[0] + other[1] * sin(other[2] * t + other[3]))]
#[constraint(beside: s + 0.3 * sin(s) = t)]
#[derive(Clone, Debug)]
struct Beside {
    l: [f64; 2],
    first: [f64; 4],
    other: [f64; 4],
}

/// A pin on two cylinders.
#[mechanism]
#[body(pin, phi = 0)]
#[distance(left: ground @ (0, 0), pin @ (0, 0), length = first[0] + first[1] * sin(first[2] * t + first[3]))]
#[distance(right: ground @ (d, 0), pin @ (0, 0), length = other[0] + other[1] * sin(other[2] * t + other[3]))]
#[derive(Clone, Debug)]
struct Struts {
    d: f64,
    first: [f64; 4],
    other: [f64; 4],
}

/// A link between two sliders.
#[mechanism]
#[body(a, y = 0, phi = 0)]
#[body(b, x = 0, phi = 0)]
#[distance(link: a @ (0, 0), b @ (0, 0), length = l)]
#[driver(pull: a.x = first[0] + first[1] * sin(first[2] * t + first[3]))]
#[derive(Clone, Debug)]
struct Trammel {
    l: f64,
    first: [f64; 4],
}

/// A pin on two lines, one of which is turned by time.
#[mechanism]
#[body(pin, phi = 0)]
#[constraint(turned: cos(first[0] + first[1] * sin(first[2] * t + first[3])) * pin.x + sin(first[0] + first[1] * sin(first[2] * t + first[3])) * pin.y = h)]
#[constraint(still: pin.y = k * pin.x + 1)]
#[derive(Clone, Debug)]
struct Lines {
    h: f64,
    k: f64,
    first: [f64; 4],
}

/// A quadratic equation, one root of which goes to infinity where the leading coefficient is 0.
#[mechanism]
#[body(pin, y = 0, phi = 0)]
#[constraint(root: (first[0] + first[1] * sin(first[2] * t + first[3])) * pin.x * pin.x + b * pin.x = 1)]
#[derive(Clone, Debug)]
struct Root {
    b: f64,
    first: [f64; 4],
}

/// A circle and a line of any size, in numbers without a unit.
#[mechanism]
#[coordinates(a, u, v)]
#[driver(shift: a = s * (first[0] + first[1] * sin(first[2] * t + first[3])))]
#[constraint(circle: u * u + v * v = s * s)]
#[constraint(line: u + v = a)]
#[derive(Clone, Debug)]
struct Numbers {
    s: f64,
    first: [f64; 4],
}

/// a0 + a1 sin(w t + p).
#[derive(Clone, Copy)]
struct Wave([f64; 4]);

impl Wave {
    fn random(random: &mut Random, middle: [f64; 2], most: f64) -> Self {
        let fast = if random.chance(0.3) { 40.0 } else { 6.0 };
        let mut of = |low: f64, high: f64| random.between(low, high);
        Self([of(middle[0], middle[1]), of(0.0, most), of(0.2, fast), of(0.0, 6.0)])
    }

    fn at(self, t: f64, off: f64) -> Jet {
        let Self([a0, a1, w, p]) = self;
        (Jet::time(t) * (w * (1.0 + off)) + p).sin() * a1 + a0 * (1.0 + off)
    }
}

/// The last instant.
const END: f64 = 2.0;

/// The first time at which a measure that is positive at the start becomes negative; `None` where it never does. Motions
/// that start near such a time, or only touch it, are not drawn: the outer `None`.
fn end(measure: impl Fn(f64) -> f64) -> Option<Option<f64>> {
    const PLACES: u32 = 20_000;
    let at = |k: u32| END * f64::from(k) / f64::from(PLACES);
    let first = (0..=PLACES).find(|k| measure(at(*k)) < 0.0);
    let until = first.unwrap_or(PLACES);
    let values: Vec<f64> = (0..=until).map(|k| measure(at(k))).collect();
    let touches = values.windows(3).any(|w| w[1] < 1e-2 && w[1] <= w[0] && w[1] <= w[2]);
    if values[0] < 0.05 || touches {
        return None;
    }
    let Some(first) = first else { return Some(None) };
    let (mut low, mut high) = (at(first - 1), at(first));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if measure(middle) > 0.0 { low = middle } else { high = middle }
    }
    Some(Some(low))
}

/// A mechanism, its motion, and the measure that is negative beyond its limit.
struct Drawn<M> {
    mechanism: M,
    branch: Box<dyn Fn(f64, f64) -> Option<Vec<Jet>>>,
    measure: Box<dyn Fn(f64) -> f64>,
}

/// The share of all sweeps for a family.
const SHARE: f64 = 0.15;

fn obeys<M: Kinematics + Sync + Clone + Debug>(family: &str, seed: u64, draw: impl Fn(&mut Random) -> Drawn<M>) {
    obey(family, (seed, SHARE), draw);
}

fn obey<M: Kinematics + Sync + Clone + Debug>(
    family: &str,
    (seed, share): (u64, f64),
    draw: impl Fn(&mut Random) -> Drawn<M>,
) {
    let (mut random, mut tally, mut limits) = (Random::new(seed), Tally::default(), 0);
    for _ in 0..motions(share) {
        let (drawn, fold) = loop {
            let drawn = draw(&mut random);
            if let Some(fold) = end(&*drawn.measure) {
                break (drawn, fold);
            }
        };
        let count = [1, 2, 3, 5, 8, 13, 21, 40, 80][random.whole(0, 8)];
        let times = (0..=count).map(|k| END * f64::from(k) / f64::from(count)).collect();
        let Drawn { mechanism, branch, .. } = drawn;
        let folds: Vec<f64> = fold.into_iter().collect();
        limits += folds.len();
        follow(&mut tally, &Group::new(times, vec![Case::new(mechanism, branch, [folds, vec![]], String::new())]));
    }
    assert!(limits > 0, "{family}: no motion has a limit");
    tally.obeys(family);
}

/// The pin of two links from places on the x axis, and how far they are from their limits.
fn pin([a, b]: [Jet; 2], [l1, l2]: [f64; 2]) -> Option<[Jet; 2]> {
    let d = b - a;
    let along = (d * d + (l1 * l1 - l2 * l2)) / (d * 2.0);
    let square = -(along * along) + l1 * l1;
    (square.x > 0.0).then(|| [a + along, square.sqrt()])
}

fn carriages(random: &mut Random) -> Drawn<Carriages> {
    let l @ [l1, l2] = [(); 2].map(|()| random.between(0.5, 1.5));
    let waves @ [Wave(first), Wave(other)] =
        [Wave::random(random, [0.0, 0.0], 0.8), Wave::random(random, [0.3, 2.0], 0.8)];
    let measure = move |t: f64| {
        let [a, b] = waves.map(|wave| wave.at(t, 0.0).x);
        f64::min(l1 + l2 - (b - a).abs(), (b - a).abs() - (l1 - l2).abs())
    };
    let branch = move |t: f64, off: f64| {
        let [a, b] = waves.map(|wave| wave.at(t, off));
        let [x, y] = pin([a, b], l)?;
        Some(vec![a, b, x, y])
    };
    let mechanism = Carriages { l, first, other };
    Drawn { mechanism, branch: Box::new(branch), measure: Box::new(measure) }
}

#[test]
fn pins_on_links_from_carriages() {
    obeys("carriages", 2001, carriages);
}

#[test]
fn an_iteration_beside_carriages_changes_nothing() {
    obeys("carriages beside an iteration", 2002, |random| {
        let Drawn { mechanism, branch, measure } = carriages(random);
        let Carriages { l, first, other } = mechanism;
        let beside = move |t: f64, off: f64| {
            let mut q = branch(t, off)?;
            let s = (0..60).fold(t, |s, _| s - (s + 0.3 * s.sin() - t) / (1.0 + 0.3 * s.cos()));
            let slope = 1.0 / (1.0 + 0.3 * s.cos());
            q.push(Jet::new(s, slope, 0.3 * s.sin() * slope * slope * slope));
            Some(q)
        };
        let mechanism = Beside { l, first, other };
        Drawn { mechanism, branch: Box::new(beside), measure }
    });
}

#[test]
fn pins_on_cylinders() {
    obeys("struts", 2003, |random| {
        let waves @ [Wave(first), Wave(other)] = [(); 2].map(|()| Wave::random(random, [1.0, 1.0], 0.9));
        let d = 1.0;
        let measure = move |t: f64| {
            let [a, b] = waves.map(|wave| wave.at(t, 0.0).x);
            f64::min(a + b - d, d - (a - b).abs())
        };
        let branch = move |t: f64, off: f64| {
            let [a, b] = waves.map(|wave| wave.at(t, off));
            let x = (a * a - b * b + d * d) / (2.0 * d);
            let square = a * a - x * x;
            (square.x > 0.0).then(|| vec![x, square.sqrt()])
        };
        let mechanism = Struts { d, first, other };
        Drawn { mechanism, branch: Box::new(branch), measure: Box::new(measure) }
    });
}

#[test]
fn trammels() {
    obeys("trammels", 2004, |random| {
        let wave @ Wave(first) = Wave::random(random, [-0.5, 0.5], 0.9);
        let l = 1.0;
        let branch = move |t: f64, off: f64| {
            let a = wave.at(t, off);
            let square = -(a * a) + l * l;
            (square.x > 0.0).then(|| vec![a, square.sqrt()])
        };
        let measure = move |t: f64| l - wave.at(t, 0.0).x.abs();
        let mechanism = Trammel { l, first };
        Drawn { mechanism, branch: Box::new(branch), measure: Box::new(measure) }
    });
}

/// The pin goes to infinity where the lines become parallel.
#[test]
fn lines_that_time_turns() {
    obeys("lines", 2005, |random| {
        let wave @ Wave(first) = Wave::random(random, [-1.0, 1.0], 1.0);
        let (h, k) = (random.between(-0.8, 0.8), random.between(-1.0, 1.0));
        let across = move |angle: Jet| angle.cos() + angle.sin() * k;
        let sign = across(wave.at(0.0, 0.0)).x.signum();
        let branch = move |t: f64, off: f64| {
            let angle = wave.at(t, off);
            let x = (-angle.sin() + h) / across(angle);
            Some(vec![x, x * k + 1.0])
        };
        let measure = move |t: f64| sign * across(wave.at(t, 0.0)).x;
        let mechanism = Lines { h, k, first };
        Drawn { mechanism, branch: Box::new(branch), measure: Box::new(measure) }
    });
}

fn root(random: &mut Random, is_finite: bool) -> Drawn<Root> {
    let wave @ Wave(first) = Wave::random(random, [0.1, 0.5], if is_finite { 0.8 } else { 1.5 });
    let b = random.between(0.5, 1.5);
    let branch = move |t: f64, off: f64| {
        let a = wave.at(t, off);
        let square = a * 4.0 + b * b;
        let sum = (square.x > 0.0).then(|| square.sqrt() + b)?;
        Some(vec![if is_finite { Jet::from(2.0) / sum } else { sum / (a * -2.0) }])
    };
    let measure = move |t: f64| {
        let a = wave.at(t, 0.0).x;
        if is_finite { b * b + 4.0 * a } else { a }
    };
    Drawn { mechanism: Root { b, first }, branch: Box::new(branch), measure: Box::new(measure) }
}

#[test]
fn roots_of_quadratic_equations() {
    obeys("roots", 2006, |random| root(random, true));
}

/// The steps become smaller and smaller towards infinity, so that there are fewer of these motions.
#[test]
fn roots_that_go_to_infinity() {
    obey("roots at infinity", (2007, 0.3 * SHARE), |random| root(random, false));
}

#[test]
fn numbers_of_any_size() {
    obeys("numbers", 2008, |random| {
        let wave @ Wave(first) = Wave::random(random, [-1.0, 1.0], 1.5);
        let s = [1e-4, 1e-3, 1e-2, 0.1, 1.0][random.whole(0, 4)];
        let branch = move |t: f64, off: f64| {
            let a = wave.at(t, off) * s;
            let square = -(a * a) + 2.0 * s * s;
            let root = (square.x > 0.0).then(|| square.sqrt())?;
            Some(vec![a, (a + root) * 0.5, (a - root) * 0.5])
        };
        let measure = move |t: f64| f64::sqrt(2.0) - wave.at(t, 0.0).x.abs();
        Drawn { mechanism: Numbers { s, first }, branch: Box::new(branch), measure: Box::new(measure) }
    });
}

/// A motion of small numbers, with an instant just before its dead centre: it is no crossing of branches there.
#[test]
fn small_numbers_reach_the_last_instant() {
    let wave = Wave([0.2712754150001564, 1.2617043274459947, 0.46991206456215373, 1.0490086646955121]);
    let Wave(first @ [a0, a1, w, p]) = wave;
    let fold = (((f64::sqrt(2.0) - a0) / a1).asin() - p) / w;
    let mechanism = Numbers { s: 1e-4, first };
    let times: Vec<f64> = (0..=80).map(|k| END * f64::from(k) / 80.0).collect();
    let before = times.iter().take_while(|t| **t < fold).count();
    assert!(fold - times[before - 1] < 0.005);
    let error = mechanism.solver().sweep(&times).expect_err("a dead centre");
    let at = error.source.limit().and_then(kin_runtime::Limit::at).expect("located");
    assert!(error.trajectory.states.len() == before && (at - fold).abs() < 1e-9, "{}: {at} {fold}", error.source);
}
