//! Eight numbers as one scalar: two groups of lanes, whose operations are interleaved.
//!
//! A closed form is a long chain of operations, each of which depends on the one before. A processor executes two such
//! chains side by side in little more time than one, and both fit into its registers.

use super::Lanes;
use super::pack::Pack;
use crate::scalar::Scalar;
use crate::scalar::compare::Compare;
use crate::scalar::trig::arctangent;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Eight `f64`, for the blocks of batches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Octet([Lanes; Self::GROUPS]);

impl Octet {
    /// The number of groups of lanes.
    pub(crate) const GROUPS: usize = 2;

    /// The group of lanes with this index.
    #[inline(always)]
    pub(crate) const fn group(self, number: usize) -> Lanes {
        self.0[number]
    }

    #[inline(always)]
    fn both(self, f: impl Fn(Lanes) -> Lanes) -> Self {
        Self([f(self.0[0]), f(self.0[1])])
    }

    #[inline(always)]
    fn pairs(self, other: Self, f: impl Fn(Lanes, Lanes) -> Lanes) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
}

macro_rules! operators {
    ($($Operator:ident $operator:ident),*) => { $(
        impl $Operator for Octet {
            type Output = Self;
            #[inline(always)]
            fn $operator(self, other: Self) -> Self {
                self.pairs(other, $Operator::$operator)
            }
        }
    )* };
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Octet {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.both(Neg::neg)
    }
}

/// Implements functions group by group, by the functions of [`Lanes`].
macro_rules! group_by_group {
    ($($function:ident)*) => { $(
        #[inline(always)]
        fn $function(self) -> Self {
            self.both(Scalar::$function)
        }
    )* };
}

impl Scalar for Octet {
    group_by_group!(tan asin acos atan sqrt exp ln abs signum);

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self([value.into(); 2])
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let [a, b] = Lanes::sin_cos_all(self.0);
        (Self([a.0, b.0]), Self([a.1, b.1]))
    }

    // Index loops, here and below, because `map` would move vectors through memory.
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let mut out = [(Self::default(), Self::default()); N];
        for k in 0..N {
            out[k] = angles[k].sin_cos();
        }
        out
    }

    #[inline(always)]
    fn atan2_all<const N: usize>(vectors: [(Self, Self); N]) -> [Self; N] {
        let mut out = [Self::default(); N];
        for k in 0..N {
            out[k] = vectors[k].0.atan2(vectors[k].1);
        }
        out
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, x.0);
        let [a, b] = arctangent::atan2_of_two([a.0, b.0], [c.0, d.0]);
        Self([Lanes(a), Lanes(b)])
    }

    #[inline(always)]
    fn nearest(self, reference: Self) -> Self {
        self.pairs(reference, Scalar::nearest)
    }

    #[inline(always)]
    fn is_within(self, bound: f64) -> bool {
        self.0[0].is_within(bound) & self.0[1].is_within(bound)
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        self.both(|x| x.powi(n))
    }

    #[inline]
    fn powf(self, n: f64) -> Self {
        self.both(|x| x.powf(n))
    }

    #[inline]
    fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
        let [a, b] = self.0.map(|x| x.lift(&f));
        core::array::from_fn(|order| Self([a[order], b[order]]))
    }
}

impl Pack for Octet {
    const COUNT: usize = Self::GROUPS * Lanes::COUNT;
    type Each<X: Copy> = [X; Self::GROUPS * Lanes::COUNT];
    const ALL: [bool; Self::GROUPS * Lanes::COUNT] = [true; Self::GROUPS * Lanes::COUNT];

    #[inline(always)]
    fn each<X: Copy>(of: impl FnMut(usize) -> X) -> [X; Self::GROUPS * Lanes::COUNT] {
        core::array::from_fn(of)
    }

    #[inline(always)]
    fn read(numbers: &[f64], mut put: impl FnMut(usize, Self)) -> &[f64] {
        let (blocks, rest) = numbers.as_chunks();
        for (k, &[a, b, c, d, e, f, g, h]) in blocks.iter().enumerate() {
            put(k, Self([Lanes::new([a, b, c, d]), Lanes::new([e, f, g, h])]));
        }
        rest
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        self.0[lane / Lanes::COUNT].lane(lane % Lanes::COUNT)
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, value: f64) {
        self.0[lane / Lanes::COUNT].set(lane % Lanes::COUNT, value);
    }
}

impl Compare for Octet {
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        self.pairs(other, Compare::least)
    }

    #[inline(always)]
    fn greatest(self, other: Self) -> Self {
        self.pairs(other, Compare::greatest)
    }

    #[inline(always)]
    fn direction(self) -> Self {
        self.both(Compare::direction)
    }
}
