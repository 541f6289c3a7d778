//! Residues modulo the prime p = 2⁶¹ − 1 with square roots, and rational functions over them.

use super::elimination::{Field, Which};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The prime. −1 has no square root modulo p.
pub(crate) const P: u64 = (1 << 61) - 1;

pub(crate) fn plus(a: u64, b: u64) -> u64 {
    (a + b) % P
}

pub(crate) fn minus(a: u64, b: u64) -> u64 {
    (a + P - b) % P
}

pub(crate) fn times(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(P)) as u64
}

pub(crate) fn inverse(a: u64) -> u64 {
    assert_ne!(a, 0, "a division by 0, which random numbers never have");
    let (mut power, mut square, mut exponent) = (1, a, P - 2);
    while exponent > 0 {
        power = if exponent & 1 == 1 { times(power, square) } else { power };
        (square, exponent) = (times(square, square), exponent >> 1);
    }
    power
}

/// a₀ + a₁ r, where r² is a residue.
type Pair = [u64; 2];

fn pair_plus(a: Pair, b: Pair) -> Pair {
    [plus(a[0], b[0]), plus(a[1], b[1])]
}

fn pair_minus(a: Pair, b: Pair) -> Pair {
    [minus(a[0], b[0]), minus(a[1], b[1])]
}

fn pair_times(a: Pair, b: Pair, square: u64) -> Pair {
    let rooted = times(times(a[1], b[1]), square);
    [plus(times(a[0], b[0]), rooted), plus(times(a[0], b[1]), times(a[1], b[0]))]
}

/// a + b s, where r² is a residue and s² = c₀ + c₁ r.
#[derive(Clone, Copy)]
pub(crate) struct Number {
    a: Pair,
    b: Pair,
    first: u64,
    second: Pair,
}

impl From<u64> for Number {
    fn from(residue: u64) -> Self {
        Self { a: [residue % P, 0], b: [0; 2], first: 0, second: [0; 2] }
    }
}

impl Number {
    /// The residue, if it has no roots in it.
    pub(crate) fn residue(self) -> Option<u64> {
        (self.a[1] == 0 && self.b == [0; 2]).then_some(self.a[0])
    }

    /// The squares of the roots in either of two numbers.
    fn roots(self, other: Self) -> (u64, Pair) {
        let first = if self.first == 0 { other.first } else { self.first };
        (first, if self.b == [0; 2] { other.second } else { self.second })
    }

    fn with(self, other: Self, a: Pair, b: Pair) -> Self {
        let (first, second) = self.roots(other);
        Self { a, b, first, second }
    }
}

impl Add for Number {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.with(other, pair_plus(self.a, other.a), pair_plus(self.b, other.b))
    }
}

impl Sub for Number {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.with(other, pair_minus(self.a, other.a), pair_minus(self.b, other.b))
    }
}

impl Neg for Number {
    type Output = Self;

    fn neg(self) -> Self {
        Self::from(0) - self
    }
}

impl Mul for Number {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (first, second) = self.roots(other);
        let product = |x: Pair, y: Pair| pair_times(x, y, first);
        let rooted = product(product(self.b, other.b), second);
        let a = pair_plus(product(self.a, other.a), rooted);
        self.with(other, a, pair_plus(product(self.a, other.b), product(self.b, other.a)))
    }
}

impl Div for Number {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        // Times the conjugates, which leave a residue.
        let across = Self { b: pair_minus([0; 2], other.b), ..other };
        let norm = other * across;
        let conjugate = Self { a: [norm.a[0], minus(0, norm.a[1])], b: [0; 2], ..norm };
        let residue = (norm * conjugate).a[0];
        self * across * conjugate * Self::from(inverse(residue))
    }
}

impl Field for Number {
    const ZERO: Self = Self { a: [0; 2], b: [0; 2], first: 0, second: [0; 2] };
    const ONE: Self = Self { a: [1, 0], b: [0; 2], first: 0, second: [0; 2] };

    /// A root that is there is not looked for: both roots are new numbers.
    fn root(self, which: Which) -> Self {
        assert!(self.b == [0; 2] && (self.a[1] == 0 || matches!(which, Which::Second)), "a root of a root");
        match which {
            Which::First => Self { a: [0, 1], b: [0; 2], first: self.a[0], second: [0; 2] },
            Which::Second => Self { a: [0; 2], b: [1, 0], first: self.first, second: self.a },
        }
    }
}

/// A polynomial by its coefficients, the one of the highest power last and not 0; none for 0.
pub(crate) type Polynomial = Vec<u64>;

fn trimmed(mut f: Polynomial) -> Polynomial {
    while f.last() == Some(&0) {
        f.pop();
    }
    f
}

/// f − factor · x^shift · g.
fn reduced(mut f: Polynomial, factor: u64, shift: usize, g: &Polynomial) -> Polynomial {
    f.resize(f.len().max(g.len() + shift), 0);
    for (k, &g) in g.iter().enumerate() {
        f[k + shift] = minus(f[k + shift], times(factor, g));
    }
    f
}

/// The quotient and the rest.
pub(crate) fn divided(mut f: Polynomial, g: &Polynomial) -> (Polynomial, Polynomial) {
    let leading = inverse(g[g.len() - 1]);
    let mut quotient = vec![0; (f.len() + 1).saturating_sub(g.len())];
    while f.len() >= g.len() {
        let (shift, factor) = (f.len() - g.len(), times(f[f.len() - 1], leading));
        quotient[shift] = factor;
        f = trimmed(reduced(f, factor, shift, g));
    }
    (trimmed(quotient), f)
}

/// Whether a polynomial has no zero twice: it has no factor in common with its derivative.
pub(crate) fn is_simple(f: &Polynomial) -> bool {
    let derivative = f.iter().enumerate().skip(1).map(|(k, &c)| times(k as u64, c)).collect();
    let (mut a, mut b) = (f.clone(), trimmed(derivative));
    while !b.is_empty() {
        (a, b) = (b.clone(), divided(a, &b).1);
    }
    a.len() == 1
}

/// The numerator and the denominator of a rational function, from its values at 1, 2, 3, …: the fraction in the algorithm of
/// Euclid at which the degrees are halved.
pub(crate) fn fraction(values: &[u64]) -> (Polynomial, Polynomial) {
    // Newton's interpolation: f has the values so far, and `all` is 0 at all places so far.
    let at = |f: &Polynomial, x: u64| f.iter().rev().fold(0, |sum, &c| plus(times(sum, x), c));
    let (mut f, mut all) = (Vec::new(), vec![1]);
    for (x, &value) in (1..).zip(values) {
        let factor = times(minus(value, at(&f, x)), inverse(at(&all, x)));
        f = trimmed(reduced(f, minus(0, factor), 0, &all));
        let shifted = [vec![0], all.clone()].concat();
        all = reduced(shifted, x, 0, &all);
    }
    let (mut before, mut now) = ((all, vec![]), (f, vec![1]));
    while now.0.len() > values.len() / 2 {
        let (quotient, rest) = divided(before.0, &now.0);
        let factors = quotient.iter().enumerate();
        let factor = factors.fold(before.1, |sum, (shift, &factor)| reduced(sum, factor, shift, &now.1));
        (before, now) = (now, (rest, trimmed(factor)));
    }
    now
}
