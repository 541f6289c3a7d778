//! Structural analysis without numbers: the generic rank of Φ_q, redundant rows, degrees of freedom.
//!
//! Counting coordinates and rows is not enough: a loop of sliders has more degrees of freedom than Grübler's formula
//! gives, and an overconstrained part can be masked by a loop with additional freedom. The decisive quantity is the
//! rank of Φ_q at an assembled pose of a mechanism with this structure. It is computed exactly, by elimination modulo a
//! large prime, at a random pose of the most general mechanism that has the same
//! - directions, ratios and angle relations, where they are literal or the same expression (`turn`, `residue`);
//! - joints between the same points, where each distinct point of a body has an independent position (`place`).
//!
//! **What is proved.** The rotations and positions are drawn from an irreducible family of poses (angles are related
//! with coefficients ±1, positions by linear equations with constant coefficients) that contains every assembled pose
//! of every mechanism with these symbols. The rank is largest at a generic member of an irreducible family. Therefore
//! rows that are dependent there are dependent at every pose and for all dimensions. The converse does not hold:
//! special lengths can make rows redundant that are generically independent (a parallelogram with a fifth bar); such
//! redundancy is found from the actual rank at run time.

mod diagnosis;
pub(crate) mod field;
mod message;
mod partials;
mod place;
mod rank;
mod removable_rows;
pub(crate) mod residue;
pub(crate) mod turn;

pub use diagnosis::{Redundancy, Structure, diagnose};
pub use message::explain;
pub(crate) use removable_rows::RemovableRows;
