//! Following the solutions of Φ(q, t) = 0 along their arc, with t as one more unknown.
//!
//! The solutions z = (q, t) are a curve. Its tangent z′ satisfies Φ_q q′ + Φ_t t′ = 0 and |D⁻¹ z′| = 1 on the common
//! scale, so that a dead centre is a regular place: there t′ changes its sign and q′ does not vanish. A step predicts
//! along the tangent and corrects orthogonally to it,
//!
//! ```text
//! ⎡ Φ_q  Φ_t ⎤ δz = ⎡ −Φ ⎤
//! ⎣   z′ᵀ    ⎦      ⎣  0 ⎦
//! ```
//!
//! (H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems, 1977). The determinant of this
//! matrix, with the tangent at the same place, keeps its sign along the curve and changes it where another branch
//! crosses. Where several branches cross at one place it may change its sign twice, so the groups of the plan count one
//! by one, too: only the group that turns back at a dead centre may change the sign of its branch value. If signs differ
//! after a step, the step is halved. If it had jumped to another branch, a shorter step finds the right one; at a
//! crossing the steps shrink until the crossing is enclosed.
//!
//! `bordered` solves this system, `follow` takes the steps, `places` finds dead centres and cusps between two of them,
//! and `rows` gives states at equal distances.

mod bordered;
mod follow;
mod places;
mod rows;

pub(crate) use follow::{Window, solution_arc};
