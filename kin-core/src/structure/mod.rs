//! What the equations say before any number is known: generic rank of Φ_q, redundant rows, degrees of freedom.
//!
//! Numbers of coordinates and rows say little: a loop of sliders has fewer degrees of freedom missing than Grübler's
//! formula counts, and a rigid part can hide behind a loop that moves freely. The rank of Φ_q at an assembled pose of
//! a mechanism *of this structure* says it all. It is found exactly, by elimination modulo a large prime at a random
//! pose of the most general mechanism that has the same
//! - directions, ratios and angle relations, as far as they are literal or shared (`turn`, `residue`);
//! - joints between the same points, where every distinct point of a body is an independent position (`place`).
//!
//! **What is proved.** Rotations and places are drawn from a family of poses that is irreducible (angles are tied by
//! ±1, places by linear equations with constant coefficients) and that contains every assembled pose of every mechanism
//! with these symbols. Rank is largest at the general member of such a family. So rows that depend on one another here
//! do so at every pose, whatever the dimensions. The converse does not hold: lengths can make a mechanism redundant that
//! is not so generically (a parallelogram with a fifth bar); that is for the actual rank at run time.

mod diagnosis;
pub(crate) mod field;
mod message;
mod partials;
mod place;
mod rank;
pub(crate) mod residue;
mod spare;
pub(crate) mod turn;

pub use diagnosis::{Redundancy, Structure, diagnose};
pub use message::explain;
pub(crate) use spare::Spare;
