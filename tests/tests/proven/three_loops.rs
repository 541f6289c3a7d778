//! All closures of structures of seven links that close in three loops at once, two with four ternary links and one
//! with a quaternary link. The real ones are compared with those of an [elimination](super::elimination), whose
//! function changes its sign at every real closure.

use super::complex_closures::{CHAIN, COUPLERS, STAR};
use super::elimination::{Elimination, chain, couplers, star};
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

/// The product of an elimination's misses at an angle.
fn miss(elimination: Elimination<Complex<f64>>, v: &[f64; 18], phi: f64) -> f64 {
    let pins = std::array::from_fn(|k| [v[2 * k], v[2 * k + 1]].map(Complex::from));
    elimination(&pins, [phi.cos(), phi.sin()].map(Complex::from)).re
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
fn compare<M: Kinematics>(
    make: impl Fn([f64; 18]) -> M,
    angle: usize,
    of: impl Fn(&M) -> &[f64; 18],
    elimination: Elimination<Complex<f64>>,
    complex: usize,
) {
    let count = if cfg!(debug_assertions) { 1 } else { 6 };
    let mut draw = Draw(complex as u64);
    let mut most = 0;
    for _ in 0..count {
        let mechanism = make(draw.pins());
        let all = mechanism.solver().assemblies(&Instant::at(0.0)).unwrap();
        let expected = roots(|phi| miss(elimination, of(&mechanism), phi));
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
    compare(|v| Star { v }, 2, |star| &star.v, star, STAR);
}

#[test]
fn four_ternary_links_as_a_chain() {
    compare(|v| Chain { v }, 8, |chain| &chain.v, chain, CHAIN);
}

#[test]
fn two_couplers_with_a_common_pin() {
    compare(|v| Couplers { v }, 8, |couplers| &couplers.v, couplers, COUPLERS);
}
