//! Eight numbers as one scalar, for the blocks of batches.
//!
//! Operations are written number by number. The compiler combines those of a kernel into vectors of the widest
//! instruction set that it may use, and keeps enough of them in flight to hide their latency. With the feature
//! `dispatch` kernels are compiled a second time for AVX2, and one of the two versions is chosen at run time.

use super::pack::Pack;
use super::{Lanes, complement, power};
use crate::scalar::Scalar;
use crate::scalar::compare::Compare;
use crate::scalar::trig;
use core::f64::consts::TAU;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Eight `f64`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub(crate) struct Octet([f64; Self::COUNT]);

impl Octet {
    /// How many numbers there are.
    pub(crate) const COUNT: usize = 8;

    /// The number of groups of lanes.
    pub(crate) const GROUPS: usize = Self::COUNT / Lanes::COUNT;

    /// The numbers `of(lane)`.
    pub(crate) fn generate(element: impl FnMut(usize) -> f64) -> Self {
        Self(core::array::from_fn(element))
    }

    /// The values of all lanes.
    pub(crate) const fn to_array(self) -> [f64; Self::COUNT] {
        self.0
    }

    /// The value of a lane.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    /// Sets the value of one lane and leaves the others unchanged.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }

    /// The group of lanes with this index.
    #[inline(always)]
    pub(crate) fn group(self, number: usize) -> Lanes {
        Lanes::new(core::array::from_fn(|lane| self.0[number * Lanes::COUNT + lane]))
    }

    // Index loops, here and below, because `map` would move vectors through memory.
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = self;
        for k in 0..Self::COUNT {
            out.0[k] = f(self.0[k]);
        }
        out
    }

    #[inline(always)]
    fn pairs(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = self;
        for k in 0..Self::COUNT {
            out.0[k] = f(self.0[k], other.0[k]);
        }
        out
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
        self.map(Neg::neg)
    }
}

/// Implements functions number by number, by the functions of `f64`.
macro_rules! one_by_one {
    ($($function:ident)*) => { $(
        #[inline(always)]
        fn $function(self) -> Self {
            self.map(Scalar::$function)
        }
    )* };
}

impl Scalar for Octet {
    one_by_one!(sqrt exp ln abs signum);

    #[inline(always)]
    fn dispatch<R>(work: impl FnOnce() -> R) -> R {
        trig::by_processor(work)
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self([value; Self::COUNT])
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let [pair] = Self::sin_cos_all([self]);
        pair
    }

    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let mut x = [[0.0; Self::COUNT]; N];
        for k in 0..N {
            x[k] = angles[k].0;
        }
        let (sin, cos) = trig::sin_cos_eights(&x);
        let mut out = [(Self::default(), Self::default()); N];
        for k in 0..N {
            out[k] = (Self(sin[k]), Self(cos[k]));
        }
        out
    }

    #[inline(always)]
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }

    #[inline(always)]
    fn asin(self) -> Self {
        self.atan2(complement(self))
    }

    #[inline(always)]
    fn acos(self) -> Self {
        complement(self).atan2(self)
    }

    #[inline(always)]
    fn atan(self) -> Self {
        self.atan2(Self::from_f64(1.0))
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let [angle] = Self::atan2_all([(self, x)]);
        angle
    }

    #[inline(always)]
    fn atan2_all<const N: usize>(vectors: [(Self, Self); N]) -> [Self; N] {
        let [mut y, mut x] = [[[0.0; Self::COUNT]; N]; 2];
        for k in 0..N {
            (y[k], x[k]) = (vectors[k].0.0, vectors[k].1.0);
        }
        let angles = trig::atan2_eights(&y, &x);
        let mut out = [Self::default(); N];
        for k in 0..N {
            out[k] = Self(angles[k]);
        }
        out
    }

    #[inline(always)]
    fn nearest(self, reference: Self) -> Self {
        // Adding and subtracting 1.5·2⁵² rounds to an integer.
        let round = Self::from_f64(1.5 / f64::EPSILON);
        let turns = ((reference - self) * Self::from_f64(1.0 / TAU) + round) - round;
        self + turns * Self::from_f64(TAU)
    }

    #[inline(always)]
    fn is_within(self, bound: f64) -> bool {
        // The loop has no early exit, so that it vectorises.
        self.0.iter().fold(true, |all, x| all & (x.abs() <= bound))
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        power(self, n)
    }

    #[inline]
    fn powf(self, n: f64) -> Self {
        self.map(|x| Scalar::powf(x, n))
    }

    #[inline]
    fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
        let lifted = self.0.map(f);
        core::array::from_fn(|order| Self(lifted.map(|derivatives| derivatives[order])))
    }
}

impl Pack for Octet {
    const COUNT: usize = Self::COUNT;

    #[inline(always)]
    fn read(numbers: &[f64], mut put: impl FnMut(usize, Self)) -> &[f64] {
        let (blocks, rest) = numbers.as_chunks();
        for (k, block) in blocks.iter().enumerate() {
            put(k, Self(*block));
        }
        rest
    }

    fn generate(element: impl FnMut(usize) -> f64) -> Self {
        Self::generate(element)
    }
}

impl Compare for Octet {
    const LANES: usize = Self::COUNT;

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
        self.map(Compare::direction)
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        Self::lane(self, lane)
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        self.set(lane, value);
    }
}
