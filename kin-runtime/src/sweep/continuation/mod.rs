//! Following one branch of the motion through time.
//!
//! The position at t + h is predicted from the state at t,
//!
//! ```text
//! q(t + h) ≈ q + h q̇ + ½ h² q̈,
//! ```
//!
//! and corrected by full Newton steps. A step counts only if it was short, the correction small against the predicted
//! motion and contracting fast, the velocity where it was expected, the rank of Φ_q and the orientation of the branch (the
//! sign of its determinant) the same, and every group of the plan on its own branch; otherwise it is halved. So a motion
//! is followed to where it ends or crosses another, and never jumps there: what cannot be followed is an error with the
//! time and the joint.
//!
//! Where the mechanism has a plan it is asked first, by the same follower that [`Planned`](crate::Planned) has, which
//! judges its branch by itself. Its q, q̇ and q̈ at every instant are held against all rows. Full Newton takes over where
//! the plan has no answer or one that does not close.
//!
//! Where there are rows of velocity level, Φ does not determine the position. Then the velocities are integrated from
//! the first instant on, and every step is projected onto Φ; see `integrate`.

mod branch;
mod follow;
mod groups;
mod integrate;
mod kinematic;
mod nodes;
mod planned;
mod refusal;
mod step;

pub(crate) use follow::Follower;
pub(crate) use kinematic::{kinematic, kinematic_each};
