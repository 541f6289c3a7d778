//! Derivatives of the motion of any order: jerk and beyond.
//!
//! With q(t + τ) = Σ q_k τᵏ, q_k = q⁽ᵏ⁾/k!, comparing the coefficients of τᵏ in Φ(q, t) = 0 gives
//!
//! ```text
//! Φ_q q_k = −[τᵏ] Φ(q_0 + … + q_{k−1} τ^{k−1}, t + τ)
//! ```
//!
//! with one matrix, Φ_q at τ = 0, for every order: one factorisation, and a new right-hand side per order. For rows of
//! velocity level, η(q, q̇, t) = 0, the coefficient of τ^{k−1} has k B q_k in it:
//!
//! ```text
//! B q_k = −1/k [τ^{k−1}] η(q_0 + … + q_{k−1} τ^{k−1}, q_1 + … + (k−1) q_{k−1} τ^{k−2}, t + τ)
//! ```
//!
//! For k = 1, 2 these are the velocity and acceleration equations. Coefficients are found incrementally: the first run
//! of Φ's straight-line program carries four of everything, and every later one adds one, at a cost of O(k) for each
//! operation that is not linear and O(1) for all others (Griewank and Walther, *Evaluating Derivatives*, 2008, chapter
//! 13; Nedialkov and Pryce, *Solving Differential-Algebraic Equations by Taylor Series*, 2005).
//!
//! By the plan the first run begins with the sines and cosines that q was found with, and every order is solved with the
//! factors of q̇ and q̈ ([`HigherOrders::solve_by_plan`]).

mod arithmetic;
#[cfg(feature = "std")]
mod at_zero;
#[cfg(feature = "std")]
mod by_plan;
#[cfg(feature = "std")]
mod derivatives;
#[cfg(feature = "std")]
mod inputs;
#[cfg(feature = "std")]
mod motion;
#[cfg(feature = "std")]
mod news;
#[cfg(feature = "std")]
mod next;
#[cfg(feature = "std")]
mod orders;
#[cfg(feature = "std")]
mod recurrence;
#[cfg(feature = "std")]
mod start;
#[cfg(feature = "std")]
mod supplied;
#[cfg(feature = "std")]
mod tape;

pub use arithmetic::{Arithmetic, PowerSeries};
#[cfg(feature = "std")]
pub use derivatives::Derivatives;
#[cfg(feature = "std")]
pub use motion::MotionDerivatives;
#[cfg(feature = "std")]
pub use orders::HigherOrders;

/// The functions of an arithmetic by their recurrences, which it applies with `apply`.
#[cfg(feature = "std")]
macro_rules! functions {
    ($value:ty) => {
        super::functions!(@one $value, square Square, tan Tangent, atan ArcTangent, sqrt Root, exp Exponential,
            ln Logarithm, abs Absolute, signum Sign);
        super::functions!(@two $value, mul Product, div Quotient, atan2 ArcTangent2);

        #[inline(always)]
        fn asin(&mut self, a: $value) -> $value {
            let [y] = self.apply(&Arc { cosine: false }, [a]);
            y
        }

        #[inline(always)]
        fn acos(&mut self, a: $value) -> $value {
            let [y] = self.apply(&Arc { cosine: true }, [a]);
            y
        }

        #[inline(always)]
        fn powi(&mut self, a: $value, n: i32) -> $value {
            let [p] = self.apply(&Power { exponent: f64::from(n), integer: Some(n) }, [a]);
            p
        }

        #[inline(always)]
        fn powf(&mut self, a: $value, n: f64) -> $value {
            let [p] = self.apply(&Power { exponent: n, integer: None }, [a]);
            p
        }
    };
    (@one $value:ty, $($name:ident $function:ident),*) => { $(
        #[inline(always)]
        fn $name(&mut self, a: $value) -> $value {
            let [y] = self.apply(&$function, [a]);
            y
        }
    )* };
    (@two $value:ty, $($name:ident $function:ident),*) => { $(
        #[inline(always)]
        fn $name(&mut self, a: $value, b: $value) -> $value {
            let [y] = self.apply(&$function, [a, b]);
            y
        }
    )* };
}
#[cfg(feature = "std")]
use functions;
