//! The number of complex closures of groups, counted exactly: modulo a large prime, the function of an elimination is a
//! fraction of polynomials in x = tan(φ/2), whose numerator has one zero for every closure.

use super::elimination::{Elimination, chain, couplers, dyad, star, triad};
use super::residues::{Number, P, divided, fraction, inverse, is_simple, minus, plus, times};

/// Known counts of the three structures of seven links: see N. Rojas, F. Thomas, Distance-based position analysis of the three
/// seven-link Assur kinematic chains, Mechanism and Machine Theory 46 (2011).
pub(crate) const STAR: usize = 14;
pub(crate) const CHAIN: usize = 16;
pub(crate) const COUPLERS: usize = 18;

/// More than the sum of all degrees.
const VALUES: u64 = 200;

/// The number of complex closures with random pins.
fn count(elimination: Elimination<Number>, seed: u64) -> usize {
    let mut state = seed;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Number::from((state >> 2) % P)
    };
    let pins = std::array::from_fn(|_| [draw(), draw()]);
    // cos φ = (1 − x²)/(1 + x²), sin φ = 2x/(1 + x²).
    let value = |x: u64| {
        let size = inverse(plus(1, times(x, x)));
        let angle = [times(minus(1, times(x, x)), size), times(plus(x, x), size)].map(Number::from);
        elimination(&pins, angle).residue().expect("the product over all roots has none of them")
    };
    let values: Vec<u64> = (1..=VALUES).map(value).collect();
    let (mut zeros, poles) = fraction(&values);
    // There are values to spare, so that it is the fraction; and it is finite at φ = π.
    assert!(zeros.len() + poles.len() < values.len() - 4, "{} {}", zeros.len(), poles.len());
    assert_eq!(zeros.len(), poles.len());
    // At x = ±i cosine and sine are infinite: no angle.
    loop {
        let (quotient, rest) = divided(zeros.clone(), &vec![1, 0, 1]);
        if !rest.is_empty() {
            break;
        }
        zeros = quotient;
    }
    assert!(is_simple(&zeros), "closures that coincide");
    zeros.len() - 1
}

#[test]
fn groups_have_as_many_complex_closures_as_is_known() {
    for seed in [3, 4] {
        let counts = [dyad as Elimination<Number>, triad, star, chain, couplers].map(|group| count(group, seed));
        assert_eq!(counts, [2, 6, STAR, CHAIN, COUPLERS]);
    }
}
