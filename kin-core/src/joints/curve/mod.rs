//! Contacts with curves: a curve is fixed in body i with its centre at P. Where Q stands as seen from it is
//! ```text
//! w = A_iᵀ(r_Q − r_P)
//! ```
//! w_x = u·d and w_y = u×d for u = A_i(1, 0), d = r_Q − r_P: two atoms that are each other's derivative.

mod flat_follower;
mod implicit;
mod on_curve;
mod parametric;
mod polar;
mod relative;

pub use flat_follower::FlatFollower;
pub use on_curve::OnCurve;
