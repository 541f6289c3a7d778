//! Functions that the caller supplies: cam tables, splines, motion laws.
//!
//! `#[function(lift)]` says that the field `lift` of the struct is a function; formulas then use it as `lift(e)`. Every
//! type that computes a value and two derivatives can implement [`ScalarFunction`]. The crate provides
//!
//! - [`CubicSpline`]: C² interpolation through a table, with natural, clamped or periodic ends;
//! - [`Sequence`]: rises, returns and dwells of a cam, each with a [`MotionLaw`], one after another;
//! - [`Polynomial`], which with a single coefficient is a constant;
//! - [`FromFn`]: a closure.
//!
//! The two derivatives enter Φ_q, Φ_t and γ without a check, so that a wrong derivative gives wrong velocities and
//! accelerations. The [cross-check](crate::cross_check) therefore compares f, f′ and f″ with one another.

#[cfg(feature = "alloc")]
mod error;
mod from_fn;
mod law;
mod polynomial;
#[cfg(feature = "alloc")]
mod sequence;
#[cfg(feature = "alloc")]
mod spline;
#[cfg(test)]
mod tests;

#[cfg(feature = "alloc")]
pub use error::FunctionError;
pub use from_fn::FromFn;
pub use law::MotionLaw;
pub use polynomial::Polynomial;
#[cfg(feature = "alloc")]
pub use sequence::{Sequence, SequenceBuilder};
#[cfg(feature = "alloc")]
pub use spline::CubicSpline;

use crate::scalar::Interval;

/// A scalar function with its first two derivatives, known at run time.
///
/// ```
/// use kin_runtime::ScalarFunction;
///
/// /// A bump of the given width.
/// struct Gauss { width: f64 }
///
/// impl ScalarFunction for Gauss {
///     fn evaluate(&self, x: f64) -> [f64; 3] {
///         let u = x / self.width;
///         let f = (-0.5 * u * u).exp();
///         [f, -u * f / self.width, (u * u - 1.0) * f / (self.width * self.width)]
///     }
/// }
/// assert_eq!(Gauss { width: 2.0 }.evaluate(0.0), [1.0, 0.0, -0.25]);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be used as a function of a mechanism",
    label = "this type gives no value with two derivatives",
    note = "implement `kin_runtime::ScalarFunction` for it; a closure is wrapped: `FromFn<F>`"
)]
pub trait ScalarFunction {
    /// (f, f′, f″) at `x`.
    ///
    /// Where the function has no value it returns NaN, which every analysis reports as an error.
    fn evaluate(&self, x: f64) -> [f64; 3];

    /// Writes f, f′, f″, f⃛, … at `x` to `out`, as many as are known and fit; returns their number.
    ///
    /// Derivatives of the motion above the second order (`Solver::derivatives`) use this method. The default
    /// implementation gives derivatives up to the second.
    fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
        let known = self.evaluate(x);
        out.iter_mut().zip(known).map(|(index, value)| *index = value).count()
    }

    /// An interval that holds all values of the function over an interval of its argument; undefined by default.
    ///
    /// A motion uses it to find peaks and gaps that are narrower than its steps. The values may be those of
    /// [`evaluate`](Self::evaluate), with its rounding errors.
    fn enclose(&self, x: Interval) -> Interval {
        let _ = x;
        Interval::UNDEFINED
    }
}

impl<F: ScalarFunction + ?Sized> ScalarFunction for &F {
    #[inline]
    fn evaluate(&self, x: f64) -> [f64; 3] {
        (**self).evaluate(x)
    }

    #[inline]
    fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
        (**self).derivatives(x, out)
    }

    fn enclose(&self, x: Interval) -> Interval {
        (**self).enclose(x)
    }
}

/// Implements [`ScalarFunction`] for a pointer to a function.
#[cfg(feature = "alloc")]
macro_rules! behind {
    ($($pointer:ty),*) => { $(
        impl<F: ScalarFunction + ?Sized> ScalarFunction for $pointer {
            #[inline]
            fn evaluate(&self, x: f64) -> [f64; 3] {
                (**self).evaluate(x)
            }

            #[inline]
            fn derivatives(&self, x: f64, out: &mut [f64]) -> usize {
                (**self).derivatives(x, out)
            }

            fn enclose(&self, x: Interval) -> Interval {
                (**self).enclose(x)
            }
        }
    )* };
}

#[cfg(feature = "alloc")]
behind!(alloc::boxed::Box<F>, alloc::rc::Rc<F>, alloc::sync::Arc<F>);

/// The values over an interval of a function that consists of pieces, of which those at both ends of the interval are
/// `first` and `last`: `start` gives where a piece begins, and `of_piece` encloses a piece over an interval within it.
#[cfg(feature = "alloc")]
fn enclose_pieces(
    x: Interval,
    [first, last]: [usize; 2],
    start: &dyn Fn(usize) -> f64,
    of_piece: &dyn Fn(usize, Interval) -> Interval,
) -> Interval {
    let enclosure = |piece: usize| {
        let lower = if piece == first { x.lower() } else { start(piece) };
        let upper = if piece == last { x.upper() } else { start(piece + 1) };
        of_piece(piece, Interval::new(lower, upper))
    };
    (first..=last).map(enclosure).reduce(Interval::hull).unwrap_or(Interval::UNDEFINED)
}

/// The values of a function over an interval, if it is straight before `start` and after `end`: `enclose` gives them over
/// an interval between these.
#[cfg(feature = "alloc")]
fn enclose_straight(
    x: Interval,
    [start, end]: [f64; 2],
    enclose: &dyn Fn(Interval) -> Interval,
    value: &dyn Fn(f64) -> f64,
) -> Interval {
    let outside = [(x.lower(), x.upper().min(start)), (x.lower().max(end), x.upper())];
    let beyond = outside.into_iter().filter(|(from, to)| from <= to);
    let straight = beyond.map(|(from, to)| Interval::from(value(from)).hull(Interval::from(value(to))));
    let inside = x.intersection(Interval::new(start, end)).map(enclose);
    straight.chain(inside).reduce(Interval::hull).unwrap_or(Interval::UNDEFINED)
}

/// The values of a function over an interval, if it repeats itself with a period from `start` to `end`: `enclose` gives
/// them over an interval within the period.
#[cfg(feature = "alloc")]
fn enclose_periodic(x: Interval, [start, end]: [f64; 2], enclose: &dyn Fn(Interval) -> Interval) -> Interval {
    let width = x.upper() - x.lower();
    if !x.is_bounded() || width >= end - start {
        return enclose(Interval::new(start, end));
    }
    let from = wrapped(x.lower(), start, end);
    let to = from + width;
    match to <= end {
        true => enclose(Interval::new(from, to)),
        false => enclose(Interval::new(from, end)).hull(enclose(Interval::new(start, to - (end - start)))),
    }
}

/// `x` shifted into the interval from `start` to `end` by a multiple of its length; the remainder is exact.
#[cfg(feature = "alloc")]
fn wrapped(x: f64, start: f64, end: f64) -> f64 {
    let period = end - start;
    let rest = (x - start) % period;
    start + if rest < 0.0 { rest + period } else { rest }
}
