//! All closures of random groups of every class, compared with intersections of circles and lines.

use super::assemblies::Forward;
use kin_runtime::{Instant, Kinematics, mechanism};
use std::f64::consts::TAU;

/// Groups of every class.
const COUNT: usize = if cfg!(debug_assertions) { 100 } else { 10_000 };
/// Groups that are nearer to a limit than this are left out: whether they close is a matter of rounding.
const NEAR: f64 = 1e-9;

/// Two links, joined and held by pins.
#[mechanism]
#[bodies(left, right)]
#[revolute(A: ground @ (v[0], v[1]), left @ (0, 0))]
#[revolute(B: left @ (v[2], v[3]), right @ (0, 0))]
#[revolute(C: ground @ (v[4], v[5]), right @ (v[6], v[7]))]
struct Rrr {
    v: [f64; 8],
}

/// A link on a pin, and a slider on a guide.
#[mechanism]
#[bodies(rod, slider)]
#[revolute(A: ground @ (v[0], v[1]), rod @ (0, 0))]
#[revolute(B: rod @ (v[2], v[3]), slider @ (v[4], v[5]))]
#[translational(guide: ground @ (v[6], v[7]), slider @ (0, 0), axis = (cos(v[8]), sin(v[8])))]
struct Rrp {
    v: [f64; 9],
}

/// A guide that turns about a pin, with a slider that another pin holds.
#[mechanism]
#[bodies(guide, slider)]
#[revolute(A: ground @ (v[0], v[1]), guide @ (0, 0))]
#[translational(B: guide @ (v[2], v[3]), slider @ (0, 0), axis = (1, 0))]
#[revolute(C: ground @ (v[4], v[5]), slider @ (v[6], v[7]))]
struct Rpr {
    v: [f64; 8],
}

/// Sliders on two guides, joined by a pin.
#[mechanism]
#[bodies(left, right)]
#[translational(A: ground @ (v[0], v[1]), left @ (0, 0), axis = (cos(v[8]), sin(v[8])))]
#[revolute(B: left @ (v[2], v[3]), right @ (0, 0))]
#[translational(C: ground @ (v[4], v[5]), right @ (v[6], v[7]), axis = (cos(v[9]), sin(v[9])))]
struct Prp {
    v: [f64; 10],
}

/// A slider on a guide that is a slider itself, whose other end a pin holds.
#[mechanism]
#[bodies(first, second)]
#[translational(A: ground @ (v[0], v[1]), first @ (0, 0), axis = (cos(v[8]), sin(v[8])))]
#[translational(B: first @ (v[2], v[3]), second @ (0, 0), axis = (cos(v[9]), sin(v[9])))]
#[revolute(C: ground @ (v[4], v[5]), second @ (v[6], v[7]))]
struct Ppr {
    v: [f64; 10],
}

/// A generator of deterministic numbers.
struct Draw(u64);

impl Draw {
    /// Between −1 and 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn list<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.next())
    }
}

fn size(x: f64, y: f64) -> f64 {
    x.hypot(y)
}

/// Draws groups and compares their closures with what is expected of them: the places of a point of a body, and how near the
/// group is to a limit.
fn compare<M: Kinematics, const N: usize>(
    seed: u64,
    make: impl Fn([f64; N]) -> M,
    expected: impl Fn(&[f64; N]) -> (Vec<[f64; 2]>, f64),
    (body, point): (usize, impl Fn(&[f64; N]) -> [f64; 2]),
) {
    let (mut draw, mut counts) = (Draw(seed), [0; 3]);
    for _ in 0..COUNT {
        let v = draw.list();
        let (places, margin) = expected(&v);
        if margin.abs() < NEAR {
            continue;
        }
        let all = make(v).solver().assemblies(&Instant::at(0.0)).unwrap();
        assert!(all.is_complete(), "{v:?}: {all}");
        assert_eq!(all.found.len(), places.len(), "{v:?}: {all}");
        let [x, y] = point(&v);
        // Places are as uncertain as a root near 0 is.
        let bound = 1e-12 / margin.abs().min(1.0).sqrt();
        for place in &places {
            let is_there = |q: &[f64]| {
                let (sin, cos) = q[3 * body + 2].sin_cos();
                let [at_x, at_y] = [q[3 * body], q[3 * body + 1]];
                size(at_x + x * cos - y * sin - place[0], at_y + x * sin + y * cos - place[1]) < bound
            };
            let found = all.found.iter().filter(|closure| is_there(&closure.q)).count();
            assert_eq!(found, 1, "{v:?}: {place:?}: {all}");
        }
        counts[places.len()] += 1;
    }
    assert!(counts[2] > COUNT / 4 && counts[0] > COUNT / 20 || counts[1] > 9 * COUNT / 10, "{counts:?}");
}

/// The points at distances r and s from two centres.
fn circles(centre: [f64; 2], r: f64, other: [f64; 2], s: f64) -> (Vec<[f64; 2]>, f64) {
    let [x, y] = [other[0] - centre[0], other[1] - centre[1]];
    let square = x * x + y * y;
    let along = (square + r * r - s * s) / (2.0 * square);
    let across = r * r / square - along * along;
    let at = |h: f64| [centre[0] + along * x - h * y, centre[1] + along * y + h * x];
    (if across < 0.0 { vec![] } else { vec![at(across.sqrt()), at(-across.sqrt())] }, across)
}

#[test]
fn three_pins() {
    let at = |v: &[f64; 8]| circles([v[0], v[1]], size(v[2], v[3]), [v[4], v[5]], size(v[6], v[7]));
    compare(1, |v| Rrr { v }, at, (1, |_| [0.0; 2]));
}

#[test]
fn two_pins_and_a_slider() {
    let at = |v: &[f64; 9]| {
        // The slider does not turn, so that its pin is on a line parallel to the guide.
        let (sin, cos) = v[8].sin_cos();
        let pin = [v[6] + v[4] - v[0], v[7] + v[5] - v[1]];
        let (along, off) = (pin[0] * cos + pin[1] * sin, pin[1] * cos - pin[0] * sin);
        let square = v[2] * v[2] + v[3] * v[3] - off * off;
        let at = |h: f64| [v[0] + pin[0] + (h - along) * cos, v[1] + pin[1] + (h - along) * sin];
        (if square < 0.0 { vec![] } else { vec![at(square.sqrt()), at(-square.sqrt())] }, square)
    };
    compare(2, |v| Rrp { v }, at, (1, |v| [v[4], v[5]]));
}

/// The pin C in the frame of the guide is on a line parallel to its axis.
#[test]
fn a_slider_between_two_pins() {
    let at = |v: &[f64; 8]| {
        let [x, y] = [v[4] - v[0], v[5] - v[1]];
        let off = v[3] + v[7];
        let square = x * x + y * y - off * off;
        // The slider's origin is the pin less its place on the slider, turned like the guide.
        let at = |h: f64| {
            let turn = y.atan2(x) - off.atan2(h);
            let (sin, cos) = turn.sin_cos();
            [v[4] - v[6] * cos + v[7] * sin, v[5] - v[6] * sin - v[7] * cos]
        };
        (if square < 0.0 { vec![] } else { vec![at(square.sqrt()), at(-square.sqrt())] }, square)
    };
    compare(3, |v| Rpr { v }, at, (1, |_| [0.0; 2]));
}

/// Where a line through a point, by the angle of its direction, meets another one.
fn lines(p: [f64; 2], a: f64, q: [f64; 2], b: f64) -> (Vec<[f64; 2]>, f64) {
    let across = (b - a).sin();
    let along = ((q[0] - p[0]) * b.sin() - (q[1] - p[1]) * b.cos()) / across;
    (vec![[p[0] + along * a.cos(), p[1] + along * a.sin()]], across * across)
}

#[test]
fn a_pin_between_two_sliders() {
    let at = |v: &[f64; 10]| lines([v[0] + v[2], v[1] + v[3]], v[8], [v[4] - v[6], v[5] - v[7]], v[9]);
    compare(4, |v| Prp { v }, at, (1, |_| [0.0; 2]));
}

#[test]
fn two_sliders_and_a_pin() {
    let at = |v: &[f64; 10]| lines([v[0], v[1]], v[8], [v[4] - v[6] - v[2], v[5] - v[7] - v[3]], v[9]);
    compare(5, |v| Ppr { v }, at, (0, |_| [0.0; 2]));
}

/// Triads.
#[test]
fn platforms_on_three_legs() {
    let mut draw = Draw(6);
    let mut most = 0;
    for _ in 0..COUNT / 33 {
        let [a, b, c, size, l] = draw.list();
        let angle = [a, b, c].map(|x| x * TAU);
        let robot = Forward { angle, size: 0.3 + 0.2 * size, l: 0.45 + 0.15 * l, base: 0.5 };
        let all = robot.solver().assemblies(&Instant::at(0.0)).unwrap();
        let expected = robot.platform_angles();
        assert!(all.is_complete() && all.found.len() == expected.len(), "{angle:?} {size} {l}: {all} {expected:?}");
        for phi in expected {
            let near = |q: &[f64]| (((q[2] - phi) / TAU).round() * TAU + phi - q[2]).abs() < 1e-9;
            assert_eq!(all.found.iter().filter(|closure| near(&closure.q)).count(), 1, "{angle:?} {size} {l}: {phi}");
        }
        most = most.max(all.found.len());
    }
    assert!(most >= if cfg!(debug_assertions) { 2 } else { 6 }, "{most}");
}
