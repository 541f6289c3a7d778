//! Following one branch of the motion through time.
//!
//! The position at t + h is predicted from the state at t,
//!
//! ```text
//! q(t + h) ≈ q + h q̇ + ½ h² q̈,
//! ```
//!
//! and corrected by full Newton steps. A step counts only if it was short, the correction small against the predicted
//! motion and contracting fast, the velocity where it was expected, and the orientation of the branch (the sign of the
//! determinant of Φ_q) the same; otherwise it is halved. So a motion is followed to where it ends or crosses another,
//! and never jumps there: what cannot be followed is an error with the time and the joint.
//!
//! Where the mechanism has a plan it is asked first, from the prediction and in the modes of the node, and its q, q̇ and q̈
//! are held against all rows and judged alike. A sign that is kept is no branch that is kept: where two branches cross, the
//! motion goes on with the other sign. So the prediction, which follows the motion smoothly, must have the signs of the
//! node; where it has not, and wherever the plan has no good answer, full Newton decides as if there were no plan, and
//! reads the modes anew.
//!
//! Rank, orientation and condition number of every instant, also of one by the plan, are those of Φ_q itself, as a rule by its
//! sparse elimination; see [`factorisation`](crate::factorisation).
//!
//! Where there are rows of velocity level, Φ does not determine the position. Then the velocities are integrated from
//! the first instant on, and every step is projected onto Φ; see `integrate`.

mod branch;
mod dormand_prince;
mod follow;
mod integrate;
mod kinematic;
mod refusal;
mod step;

pub(crate) use follow::Follower;
pub(crate) use kinematic::kinematic;
