//! All closures of structures of seven links that close in three loops at once, two with four ternary links and one with a
//! quaternary link, which have 14, 16 and 18 complex closures. The real ones are compared with those of an elimination: at a given angle of one link all
//! others follow from intersections of circles, but for one length. The product of its miss over all intersections, complex
//! ones as well, is a real function of the angle without roots in it, and changes its sign at every real closure.

use kin_runtime::nalgebra::Complex;
use kin_runtime::{Instant, Kinematics, mechanism};
use std::f64::consts::{PI, TAU};

/// Four ternary links, one of which holds the other three by pins; these are connected by three binary ones. `v` has the
/// coordinates of nine pins in one closure, in which all angles are 0.
#[mechanism]
#[bodies(one, two, three, ab, bc, ca)]
#[revolute(G1: ground @ (v[0], v[1]), one @ (0, 0))]
#[revolute(G2: ground @ (v[2], v[3]), two @ (0, 0))]
#[revolute(G3: ground @ (v[4], v[5]), three @ (0, 0))]
#[revolute(A12: one @ (v[6] - v[0], v[7] - v[1]), ab @ (0, 0))]
#[revolute(B21: two @ (v[8] - v[2], v[9] - v[3]), ab @ (v[8] - v[6], v[9] - v[7]))]
#[revolute(B23: two @ (v[10] - v[2], v[11] - v[3]), bc @ (0, 0))]
#[revolute(C32: three @ (v[12] - v[4], v[13] - v[5]), bc @ (v[12] - v[10], v[13] - v[11]))]
#[revolute(C31: three @ (v[14] - v[4], v[15] - v[5]), ca @ (0, 0))]
#[revolute(A13: one @ (v[16] - v[0], v[17] - v[1]), ca @ (v[16] - v[14], v[17] - v[15]))]
struct Star {
    #[param(0)]
    v: [f64; 18],
}

/// Four ternary links in a row of pins, every other pair of which is connected by a binary one.
#[mechanism]
#[bodies(two, three, four, e, f, h)]
#[revolute(J13: ground @ (v[0], v[1]), three @ (0, 0))]
#[revolute(J14: ground @ (v[2], v[3]), four @ (0, 0))]
#[revolute(J24: four @ (v[4] - v[2], v[5] - v[3]), two @ (0, 0))]
#[revolute(E1: ground @ (v[6], v[7]), e @ (0, 0))]
#[revolute(E2: two @ (v[8] - v[4], v[9] - v[5]), e @ (v[8] - v[6], v[9] - v[7]))]
#[revolute(F2: two @ (v[10] - v[4], v[11] - v[5]), f @ (0, 0))]
#[revolute(F3: three @ (v[12] - v[0], v[13] - v[1]), f @ (v[12] - v[10], v[13] - v[11]))]
#[revolute(H3: three @ (v[14] - v[0], v[15] - v[1]), h @ (0, 0))]
#[revolute(H4: four @ (v[16] - v[2], v[17] - v[3]), h @ (v[16] - v[14], v[17] - v[15]))]
struct Chain {
    #[param(0)]
    v: [f64; 18],
}

/// A quaternary link, to which two ternary ones with a common pin are connected by two binary ones each: where the curves of
/// two couplers meet.
#[mechanism]
#[bodies(left, right, ba, bb, bc, bd)]
#[revolute(A: ground @ (v[0], v[1]), ba @ (0, 0))]
#[revolute(B: ground @ (v[2], v[3]), bb @ (0, 0))]
#[revolute(C: ground @ (v[4], v[5]), bc @ (0, 0))]
#[revolute(D: ground @ (v[6], v[7]), bd @ (0, 0))]
#[revolute(a: ba @ (v[8] - v[0], v[9] - v[1]), left @ (v[8] - v[16], v[9] - v[17]))]
#[revolute(b: bb @ (v[10] - v[2], v[11] - v[3]), left @ (v[10] - v[16], v[11] - v[17]))]
#[revolute(c: bc @ (v[12] - v[4], v[13] - v[5]), right @ (v[12] - v[16], v[13] - v[17]))]
#[revolute(d: bd @ (v[14] - v[6], v[15] - v[7]), right @ (v[14] - v[16], v[15] - v[17]))]
#[revolute(P: left @ (0, 0), right @ (0, 0))]
struct Couplers {
    #[param(0)]
    v: [f64; 18],
}

/// A place whose coordinates may be complex.
type Place = [Complex<f64>; 2];

fn place(v: &[f64; 18], k: usize) -> Place {
    [v[2 * k], v[2 * k + 1]].map(Complex::from)
}

fn square(p: Place, q: Place) -> Complex<f64> {
    let [x, y] = [0, 1].map(|k| q[k] - p[k]);
    x * x + y * y
}

/// Where a link with pins p, q and r in its closure has r when p and q are elsewhere.
fn carried([p0, q0, r0]: [Place; 3], p: Place, q: Place) -> Place {
    let size = square(p0, q0);
    let ([u0, v0], [u, v]) = ([0, 1].map(|k| q0[k] - p0[k]), [0, 1].map(|k| q[k] - p[k]));
    let (cos, sin) = ((u * u0 + v * v0) / size, (v * u0 - u * v0) / size);
    let [x, y] = [0, 1].map(|k| r0[k] - p0[k]);
    [p[0] + cos * x - sin * y, p[1] + sin * x + cos * y]
}

/// A square root.
fn root(z: Complex<f64>) -> Complex<f64> {
    let (half, turn) = (z.re.hypot(z.im).sqrt(), 0.5 * z.im.atan2(z.re));
    Complex::new(half * turn.cos(), half * turn.sin())
}

/// Both places at these squared distances from two others.
fn meet(p: Place, from_p: Complex<f64>, q: Place, from_q: Complex<f64>) -> [Place; 2] {
    let size = square(p, q);
    let along = (size + from_p - from_q) / (size * 2.0);
    let across = root(from_p / size - along * along);
    let [u, v] = [0, 1].map(|k| q[k] - p[k]);
    [across, -across].map(|h| [p[0] + along * u - h * v, p[1] + along * v + h * u])
}

/// A pin of a link, turned about another by an angle.
fn turned(centre: Place, pin: Place, phi: f64) -> Place {
    let [x, y] = [0, 1].map(|k| pin[k] - centre[k]);
    [centre[0] + x * phi.cos() - y * phi.sin(), centre[1] + x * phi.sin() + y * phi.cos()]
}

impl Star {
    /// The product of the misses at an angle of `one`.
    fn miss(&self, phi: f64) -> f64 {
        let [g1, g2, g3, a12, b21, b23, c32, c31, a13] = std::array::from_fn(|k| place(&self.v, k));
        let [a, c] = [a12, a13].map(|pin| turned(g1, pin, phi));
        let mut product = Complex::from(1.0);
        for two in meet(g2, square(g2, b21), a, square(a12, b21)) {
            let end = carried([g2, b21, b23], g2, two);
            for three in meet(g3, square(g3, c31), c, square(a13, c31)) {
                product *= square(end, carried([g3, c31, c32], g3, three)) - square(b23, c32);
            }
        }
        product.re
    }
}

impl Chain {
    /// The product of the misses at an angle of `four`.
    fn miss(&self, phi: f64) -> f64 {
        let [j13, j14, j24, e1, e2, f2, f3, h3, h4] = std::array::from_fn(|k| place(&self.v, k));
        let [j, h] = [j24, h4].map(|pin| turned(j14, pin, phi));
        let mut product = Complex::from(1.0);
        for two in meet(j, square(j24, e2), e1, square(e1, e2)) {
            let end = carried([j24, e2, f2], j, two);
            for three in meet(j13, square(j13, h3), h, square(h3, h4)) {
                product *= square(end, carried([j13, h3, f3], j13, three)) - square(f2, f3);
            }
        }
        product.re
    }
}

impl Couplers {
    /// The product of the misses at an angle of `ba`.
    fn miss(&self, phi: f64) -> f64 {
        let [a0, b0, c0, d0, a, b, c, d, p] = std::array::from_fn(|k| place(&self.v, k));
        let first = turned(a0, a, phi);
        let mut product = Complex::from(1.0);
        for second in meet(first, square(a, b), b0, square(b0, b)) {
            let pin = carried([a, b, p], first, second);
            for third in meet(pin, square(p, c), c0, square(c0, c)) {
                product *= square(carried([p, c, d], pin, third), d0) - square(d, d0);
            }
        }
        product.re
    }
}

/// The angles at which a function with a period of a turn changes its sign.
fn roots(miss: impl Fn(f64) -> f64) -> Vec<f64> {
    let steps = if cfg!(debug_assertions) { 5_000 } else { 50_000 };
    let at = |k: i32| PI * (2.0 * f64::from(k) / f64::from(steps) - 1.0) + 1e-6;
    let (mut found, mut before) = (Vec::new(), miss(at(0)));
    for k in 0..steps {
        let after = miss(at(k + 1));
        if before * after < 0.0 {
            let (mut low, mut high) = (at(k), at(k + 1));
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if miss(low) * miss(middle) <= 0.0 { high = middle } else { low = middle }
            }
            found.push(0.5 * (low + high));
        }
        before = after;
    }
    found
}

/// Deterministic pins in a square.
struct Draw(u64);

impl Draw {
    fn pins(&mut self) -> [f64; 18] {
        [(); 18].map(|()| {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        })
    }
}

/// Compares all closures of structures with the roots by the angle at a place in q; none has more than there are complex ones.
fn compare<M: Kinematics>(make: impl Fn([f64; 18]) -> M, angle: usize, miss: impl Fn(&M, f64) -> f64, complex: usize) {
    let count = if cfg!(debug_assertions) { 1 } else { 6 };
    let mut draw = Draw(complex as u64);
    let mut most = 0;
    for _ in 0..count {
        let mechanism = make(draw.pins());
        let all = mechanism.solver().assemblies(&Instant::at(0.0)).unwrap();
        let expected = roots(|phi| miss(&mechanism, phi));
        assert!(all.is_complete(), "{all}");
        assert!(expected.len() <= complex, "{expected:?}");
        assert_eq!(all.found.len(), expected.len(), "{all}: {expected:?}");
        for phi in &expected {
            let off = |q: &[f64]| (phi - q[angle]) / TAU;
            let near = all.found.iter().filter(|found| (off(&found.q) - off(&found.q).round()).abs() < 1e-8);
            assert_eq!(near.count(), 1, "{phi}: {all}");
        }
        most = most.max(expected.len());
    }
    assert!(most >= 2, "{most}");
}

#[test]
fn four_ternary_links_as_a_star() {
    compare(|v| Star { v }, 2, Star::miss, 16);
}

#[test]
fn four_ternary_links_as_a_chain() {
    compare(|v| Chain { v }, 8, Chain::miss, 16);
}

#[test]
fn two_couplers_with_a_common_pin() {
    compare(|v| Couplers { v }, 8, Couplers::miss, 18);
}
