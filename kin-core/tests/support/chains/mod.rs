//! Kinematic chains: all simple-revolute ones of one degree of freedom, and dyads of every kind put together at random,
//! with a pose that is known, and positions, velocities and accelerations from a dense Newton iteration.
//!
//! Nothing here knows of a solution plan: what a chain decomposes into follows from its graph alone.

mod assur;
mod compare;
mod draft;
mod dyads;
mod enumerate;
mod labelled;
mod limits;
mod oracle;
mod planned;
mod revolute;

pub use assur::*;
pub use compare::*;
pub use draft::*;
pub use dyads::*;
pub use enumerate::*;
pub use labelled::*;
pub use limits::{Limit, near, on as on_limit};
pub use oracle::*;
pub use planned::*;
pub use revolute::*;
