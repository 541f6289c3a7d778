//! Derivatives of the motion of any order: jerk and beyond.
//!
//! With q(t + τ) = Σ q_k τᵏ, q_k = q⁽ᵏ⁾/k!, comparing the coefficients of τᵏ in Φ(q, t) = 0 gives
//!
//! ```text
//! Φ_q q_k = −[τᵏ] Φ(q_0 + … + q_{k−1} τ^{k−1}, t + τ)
//! ```
//!
//! with one matrix, Φ_q at τ = 0, for every order: one factorisation, and a new right-hand side per order. For rows of
//! velocity level, η(q, q̇, t) = 0, the coefficient of τ^{k−1} contains k B q_k with B = ∂η/∂q̇:
//!
//! ```text
//! B q_k = −1/k [τ^{k−1}] η(q_0 + … + q_{k−1} τ^{k−1}, q_1 + … + (k−1) q_{k−1} τ^{k−2}, t + τ)
//! ```
//!
//! For k = 1, 2 these are the velocity and acceleration equations. Nothing is differentiated for this: the generated
//! code that evaluates Φ runs over truncated power series ([`Scalar`](crate::Scalar)s, each operation by its
//! recurrence: Griewank and Walther, *Evaluating Derivatives*, 2nd edition, 2008, chapter 13; Nedialkov and Pryce,
//! *Solving Differential-Algebraic Equations by Taylor Series*, 2005). Coefficients are computed order by order and
//! kept for the next run, so that one more order costs O(k) for each nonlinear operation.
//!
//! A plan is itself a formula for q(t). Its generated code, evaluated over series, gives all orders in one pass, which
//! is faster (see `by_plan`).

mod by_plan;
mod derivatives;
mod inputs;
mod motion;
mod orders;
mod tape;

pub use derivatives::Derivatives;
pub use motion::MotionDerivatives;
pub use orders::HigherOrders;
