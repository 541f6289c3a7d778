//! Following one branch of the motion through time.
//!
//! The position at t + h is predicted from the state at t,
//!
//! ```text
//! q(t + h) ≈ q + h q̇ + ½ h² q̈,
//! ```
//!
//! and corrected by full Newton steps. A step is accepted only if all of this is true:
//!
//! - the motion in it is short;
//! - the correction is small compared with the predicted motion and converges fast;
//! - the velocity is near its prediction;
//! - the rank of Φ_q and the orientation of the branch (the sign of the determinant) are unchanged;
//! - every group of the plan is on its own branch; where there are no groups, no other solution is as near as the
//!   prediction, and no eigenvalue of Φ_q(before)⁻¹ Φ_q changes its sign.
//!
//! Otherwise a shorter step is tried. A motion is thus followed to its end or to a crossing with another branch, and never
//! jumps: where it cannot be followed, the error names the time and the joint.
//!
//! Where the mechanism has a plan, it is tried first by the follower that [`Planned`](crate::Planned) uses, which
//! checks its branch itself. Its q, q̇ and q̈ are checked with all rows at every instant. Where the plan has no
//! solution, or one that does not satisfy all rows, full Newton takes over up to the requested instant; on the way to
//! the next one the plan is tried again.
//!
//! ```text
//! kinematic     from one instant of the grid to the next
//!   follow      step control: the steps between two instants, by the plan or by full Newton
//!     checked_plan   one step by the plan, compared with Φ
//!     step           one full Newton step, judged (orientation, groups)
//!   refusal     the error where no step is certain
//! ```
//!
//! Where there are rows of velocity level, Φ does not determine the position. The velocities are then integrated from
//! the first instant on, and every step is projected onto Φ = 0; see `integrate`. The motion ends where the accumulated
//! error dominates the rates; see `global_error`.

mod between;
mod checked_plan;
mod follow;
mod global_error;
mod groups;
mod hidden_motion;
mod integrate;
mod kinematic;
mod nodes;
mod orientation;
mod refusal;
mod step;

pub(crate) use follow::Continuation;
pub(crate) use kinematic::{Visit, kinematic};
