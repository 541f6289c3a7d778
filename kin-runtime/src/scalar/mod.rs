//! The scalar that generated code computes with.
//!
//! A trait of our own, because no existing one covers floats, dual numbers, SIMD lanes and intervals at once: plain
//! arithmetic through the operators, and the functions of the user's language. For `f64` every method compiles to
//! the instruction or library call that hand-written code would use.

mod chain_rule;
pub(crate) mod compare;
#[cfg(feature = "std")]
mod dual;
pub(crate) mod expansion;
mod interval;
#[cfg(feature = "simd")]
pub(crate) mod lanes;
#[cfg(feature = "std")]
pub(crate) mod recorded;
pub(crate) mod recurrence;
pub(crate) mod standard;
mod tangents;
mod taylor;
#[cfg(feature = "simd")]
pub(crate) mod trig;

pub use interval::Interval;
pub use tangents::Tangents;
pub use taylor::Taylor;

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number that the equations of a mechanism can be evaluated with.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The distance from 1 to the next larger number, to which tolerances inside generated code are proportional.
    const EPSILON: f64 = f64::EPSILON;
    /// Largest number of corrections of an iteration inside generated code.
    const CORRECTIONS: usize = 12;
    /// Runs generated code. A type whose operations are faster with instructions that not every processor of the build
    /// has overrides it: `work` is compiled for several instruction sets, and the best one is chosen at run time.
    #[inline(always)]
    fn dispatch<R>(work: impl FnOnce() -> R) -> R {
        work()
    }
    /// The constant `value`.
    fn from_f64(value: f64) -> Self;
    /// Sine and cosine together.
    fn sin_cos(self) -> (Self, Self);
    /// Sine and cosine of several angles at once; a type that can do better than one by one overrides it.
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        angles.map(Self::sin_cos)
    }
    /// Replaces angles by their sines and writes their cosines, up to the end of the shorter list; a type that can do
    /// better than one by one overrides it.
    #[inline]
    fn sin_cos_in_place(angles: &mut [Self], cosines: &mut [Self]) {
        for (angle, cosine) in angles.iter_mut().zip(cosines) {
            (*angle, *cosine) = angle.sin_cos();
        }
    }
    /// Tangent.
    fn tan(self) -> Self;
    /// Inverse sine.
    fn asin(self) -> Self;
    /// Inverse cosine.
    fn acos(self) -> Self;
    /// Inverse tangent.
    fn atan(self) -> Self;
    /// Angle of the vector (x, y) = (`x`, `self`), in (−π, π].
    fn atan2(self, x: Self) -> Self;
    /// The angles of several vectors (y, x) at once; a type that can do better than one by one overrides it.
    #[inline(always)]
    fn atan2_all<const N: usize>(vectors: [(Self, Self); N]) -> [Self; N] {
        vectors.map(|(y, x)| y.atan2(x))
    }
    /// The angle `self` + 2πn that is nearest to `reference`.
    #[inline(always)]
    fn nearest(self, reference: Self) -> Self {
        let (sin, cos) = (self - reference).sin_cos();
        reference + sin.atan2(cos)
    }
    /// True when |`self`| is at most `bound`, in all lanes; ends iterations. A scalar that cannot decide this returns
    /// false, and iterations make all of their corrections.
    #[inline(always)]
    fn is_within(self, bound: f64) -> bool {
        let _ = bound;
        false
    }
    /// Square root.
    fn sqrt(self) -> Self;
    /// The length of the vector (`self`, `other`). A scalar that carries derivatives has none at a vector of length 0 that
    /// moves, which those of the squares do not show.
    #[inline]
    fn hypot(self, other: Self) -> Self {
        (self * self + other * other).sqrt()
    }
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// 1 with the sign of `self`: the derivative of [`abs`](Self::abs).
    fn signum(self) -> Self;
    /// The square; of an interval, the squares of its numbers, so that none is negative.
    #[inline(always)]
    fn square(self) -> Self {
        self * self
    }
    /// Integer power.
    fn powi(self, n: i32) -> Self;
    /// Real constant power.
    fn powf(self, n: f64) -> Self;
    /// Lifts a function given by its value and first two derivatives, (f, f′, f″), to this scalar: the three of them
    /// at `self`. A scalar that carries derivatives applies the chain rule to f and f′; f″ has no known derivative
    /// and its derivative parts are NaN.
    fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3];
    /// [`lift`](Self::lift) for a scalar that carries higher derivatives: `derivatives` writes f, f′, f″, … as far as
    /// they are known and returns how many, and `number` is the index of the function in the mechanism.
    #[inline(always)]
    fn compose(
        self,
        number: usize,
        f: impl Fn(f64) -> [f64; 3],
        derivatives: impl Fn(f64, &mut [f64]) -> usize,
    ) -> [Self; 3] {
        let _ = (number, derivatives);
        self.lift(f)
    }
}

/// Sine and cosine of one angle, by the code for lanes with the feature `simd`.
#[inline(always)]
fn sin_cos(angle: f64) -> (f64, f64) {
    #[cfg(feature = "simd")]
    return trig::sin_cos_one(angle);
    #[cfg(not(feature = "simd"))]
    return standard::sin_cos(angle);
}

/// `std`'s functions where there is a std, `libm`'s where there is none.
macro_rules! float {
    ($t:ty, $($std:ident $libm:ident),*; $pow:ident $sin_cos:path, $atan2:path; $($more:item)*) => {
        impl Scalar for $t {
            $($more)*
            const EPSILON: f64 = <$t>::EPSILON as f64;
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $t
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
            $(
                #[inline(always)]
                fn $std(self) -> Self {
                    #[cfg(feature = "std")]
                    return <$t>::$std(self);
                    #[cfg(not(feature = "std"))]
                    return libm::$libm(self);
                }
            )*
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $atan2(self, x)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                <$t>::abs(self)
            }
            #[inline(always)]
            fn signum(self) -> Self {
                <$t>::signum(self)
            }
            #[inline(always)]
            fn powi(self, n: i32) -> Self {
                #[cfg(feature = "std")]
                return <$t>::powi(self, n);
                #[cfg(not(feature = "std"))]
                return libm::$pow(self, n as $t);
            }
            #[inline(always)]
            fn powf(self, n: f64) -> Self {
                #[cfg(feature = "std")]
                return <$t>::powf(self, n as $t);
                #[cfg(not(feature = "std"))]
                return libm::$pow(self, n as $t);
            }
            #[inline(always)]
            fn nearest(self, reference: Self) -> Self {
                const TURN: $t = core::f64::consts::TAU as $t;
                // Adding and subtracting 1.5·2ᵐ, m the bits of a mantissa, rounds to an integer without a call.
                const ROUND: $t = 1.5 / <$t>::EPSILON;
                let turns = ((reference - self) * (1.0 / TURN) + ROUND) - ROUND;
                self + turns * TURN
            }
            #[inline(always)]
            fn is_within(self, bound: f64) -> bool {
                f64::from(<$t>::abs(self)) <= bound
            }
            #[inline(always)]
            fn lift(self, f: impl Fn(f64) -> [f64; 3]) -> [Self; 3] {
                f(f64::from(self)).map(|v| v as $t)
            }
        }
    };
}

float!(
    f64, tan tan, asin asin, acos acos, atan atan, sqrt sqrt, exp exp, ln log; pow sin_cos, standard::atan2;
    #[cfg(feature = "simd")]
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        trig::sin_cos_all(angles)
    }
    #[cfg(feature = "simd")]
    #[inline(always)]
    fn sin_cos_in_place(angles: &mut [Self], cosines: &mut [Self]) {
        trig::sin_cos_in_place(angles, cosines);
    }
    #[cfg(feature = "simd")]
    #[inline(always)]
    fn atan2_all<const N: usize>(vectors: [(Self, Self); N]) -> [Self; N] {
        trig::atan2_all(vectors)
    }
);
float!(f32, tan tanf, asin asinf, acos acosf, atan atanf, sqrt sqrtf, exp expf, ln logf; powf standard::sin_cos_single, standard::atan2_single;);
