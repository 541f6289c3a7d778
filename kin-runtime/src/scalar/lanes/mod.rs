//! Four numbers as one scalar, so that a mechanism is evaluated or solved for four configurations at once.

#[cfg(feature = "alloc")]
mod octet;
#[cfg(feature = "alloc")]
mod pack;
#[cfg(all(test, feature = "std"))]
mod tests;

use crate::scalar::Scalar;
use crate::scalar::trig::{self, arctangent};
use crate::text::numbers;
use core::f64::consts::TAU;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};
use wide::f64x4;

#[cfg(feature = "alloc")]
pub(crate) use octet::Octet;
#[cfg(feature = "alloc")]
pub(crate) use pack::Pack;

/// Four `f64` as SIMD lanes, on which every operation acts in parallel.
///
/// Parameters, time, inputs, q and q̇ may differ from lane to lane: four configurations of one mechanism, or four
/// mechanisms with different dimensions. The result in a lane does not depend on the other lanes, to the last bit.
///
/// ```
/// use kin_runtime::{Instant, Lanes, Mechanism, Subset, mechanism};
///
/// #[mechanism]
/// #[bodies(arm)]
/// #[revolute(O: ground @ (0, 0), arm @ (-l, 0))]
/// #[driver(drive: arm.phi = omega * t)]
/// struct Arm {
///     #[param(0.5)]
///     l: f64,
///     #[param(2)]
///     omega: f64,
/// }
///
/// let arm = Arm::default();
/// let mut workspace = Arm::workspace::<Lanes>();
/// let mut parameters = arm.parameters::<Lanes>();
/// parameters[0] = Lanes::new([0.5, 0.6, 0.7, 0.8]);
/// let at = Instant::at(Lanes::new([0.0, 0.1, 0.2, 0.3]));
/// let zero = Lanes::default();
/// let q = [parameters[0], zero, zero];
/// arm.evaluate_with(&parameters, Subset::ALL, &at, &q, &[zero; 3], &mut workspace)?;
/// assert_eq!([0.0; 4], workspace.phi()[0].to_array());
/// assert_eq!([0.0, -0.2, -0.4, -0.6], workspace.phi()[2].to_array());
/// # Ok::<(), kin_runtime::LengthError>(())
/// ```
///
/// # Accuracy
/// `+ - * /`, `sqrt`, `abs`, `signum`, `nearest`: as `f64`, bit for bit. `sin_cos`: 1 ulp from std, like `f64` with the
/// feature `simd`. `atan2`, `atan`: 2 ulp; `tan`, `asin`, `acos`: 3 ulp; `powi`: n/2 ulp, by repeated squaring. `exp`,
/// `ln`, `powf` and supplied functions are computed lane by lane, by std. Infinities, signed zeros, subnormal numbers
/// and NaN give the results of std. Angles beyond 1.6e6 and vectors longer than 2¹⁰²⁰ are computed by std, which is the
/// only branch. With fused multiply-add instructions the last bit of `sin_cos` may differ, within the same bounds; with
/// the feature `dispatch` this depends on the processor as well as on the build.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lanes(f64x4);

impl Lanes {
    /// The number of lanes.
    pub const COUNT: usize = 4;

    /// The lanes with these values.
    #[inline(always)]
    pub const fn new(values: [f64; Self::COUNT]) -> Self {
        Self(f64x4::new(values))
    }

    /// The lanes with the values `f(0)`, `f(1)`, `f(2)`, `f(3)`.
    #[inline(always)]
    pub fn generate(f: impl FnMut(usize) -> f64) -> Self {
        Self::new(core::array::from_fn(f))
    }

    /// The values of all lanes.
    #[inline(always)]
    pub fn to_array(self) -> [f64; Self::COUNT] {
        self.0.to_array()
    }

    /// Applies `f` to every lane, one after another.
    #[inline]
    pub fn map(self, f: impl FnMut(f64) -> f64) -> Self {
        Self::new(self.to_array().map(f))
    }
}

impl From<f64> for Lanes {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self(f64x4::splat(value))
    }
}

macro_rules! operators {
    ($($Operator:ident $operator:ident),*) => { $(
        impl $Operator for Lanes {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $operator(self, other: Self) -> Self {
                Self($Operator::$operator(self.0, other.0))
            }
        }
    )* };
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Lanes {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Implements functions lane by lane, by the functions of `f64`.
macro_rules! one_by_one {
    ($($function:ident)*) => { $(
        #[inline]
        fn $function(self) -> Self {
            self.map(Scalar::$function)
        }
    )* };
}

impl Scalar for Lanes {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value.into()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let [(sin, cos)] = trig::sin_cos_lanes([self.0]);
        (Self(sin), Self(cos))
    }

    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        // Index loops, because `map` and iterators would move vectors through memory.
        let mut lanes = [f64x4::splat(0.0); N];
        for k in 0..N {
            lanes[k] = angles[k].0;
        }
        let pairs = trig::sin_cos_lanes(lanes);
        let mut out = [(Self::default(), Self::default()); N];
        for k in 0..N {
            out[k] = (Self(pairs[k].0), Self(pairs[k].1));
        }
        out
    }

    // Not inlined: this code is compiled once, in kin-runtime, and not again for every mechanism.
    fn sin_cos_in_place(angles: &mut [Self], cosines: &mut [Self]) {
        let count = angles.len().min(cosines.len());
        let (pairs, rest) = angles[..count].as_chunks_mut::<2>();
        let (cos_pairs, cos_rest) = cosines[..count].as_chunks_mut::<2>();
        for (angles, cosines) in pairs.iter_mut().zip(cos_pairs) {
            let [(s, c), (t, d)] = Self::sin_cos_all(*angles);
            (*angles, *cosines) = ([s, t], [c, d]);
        }
        for (angle, cosine) in rest.iter_mut().zip(cos_rest) {
            (*angle, *cosine) = angle.sin_cos();
        }
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
        self.atan2(1.0.into())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        Self(arctangent::atan2(self.0, x.0))
    }

    #[inline(always)]
    fn atan2_all<const N: usize>(vectors: [(Self, Self); N]) -> [Self; N] {
        let mut out = [Self::default(); N];
        let mut k = 0;
        while k + 1 < N {
            let [(y, x), (v, u)] = [vectors[k], vectors[k + 1]];
            let [first, second] = arctangent::atan2_of_two([y.0, v.0], [x.0, u.0]);
            (out[k], out[k + 1]) = (Self(first), Self(second));
            k += 2;
        }
        if k < N {
            out[k] = vectors[k].0.atan2(vectors[k].1);
        }
        out
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn nearest(self, reference: Self) -> Self {
        // Adding and subtracting 1.5·2⁵² rounds to an integer.
        let round = Self::from(1.5 / f64::EPSILON);
        let turns = ((reference - self) * Self::from(1.0 / TAU) + round) - round;
        self + turns * Self::from(TAU)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_within(self, bound: f64) -> bool {
        self.0.abs().simd_le(f64x4::splat(bound)).all()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    one_by_one!(exp ln);

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn signum(self) -> Self {
        let one = (self.0 & f64x4::splat(-0.0)) | f64x4::splat(1.0);
        Self(self.0.is_nan().select(self.0, one))
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
        let lifted = self.to_array().map(f);
        core::array::from_fn(|order| Self::generate(|lane| lifted[lane][order]))
    }
}

/// An integer power, by repeated squaring.
#[inline(always)]
fn power<T: Scalar>(x: T, n: i32) -> T {
    let (mut power, mut square, mut rest) = (T::from_f64(1.0), x, n.unsigned_abs());
    loop {
        if rest & 1 == 1 {
            power = power * square;
        }
        rest >>= 1;
        if rest == 0 {
            break;
        }
        square = square * square;
    }
    if n < 0 { T::from_f64(1.0) / power } else { power }
}

/// The other leg of a right triangle with leg x and hypotenuse 1, accurate also where x is nearly 1.
#[inline(always)]
fn complement<T: Scalar>(x: T) -> T {
    let one = T::from_f64(1.0);
    ((one - x) * (one + x)).sqrt()
}

/// For example `(1, 2, 3, 4)`.
impl fmt::Display for Lanes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        numbers(f, &self.to_array())
    }
}
