//! Contacts with curves. A curve is fixed in body i, with its centre at P. The position of Q in the frame of the curve
//! is
//! ```text
//! w = A_iᵀ(r_Q − r_P)
//! ```
//! With u = A_i(1, 0) and d = r_Q − r_P, its components w_x = u·d and w_y = u×d are two nodes that are derivatives of
//! each other.

mod flat_follower;
mod implicit;
mod on_curve;
mod parametric;
mod polar;
mod relative;

pub use flat_follower::FlatFollower;
pub use on_curve::OnCurve;
