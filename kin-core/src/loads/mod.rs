//! Forces: the efforts of drivers and the reactions of joints, in closed form (inverse dynamics).
//!
//! The motion of a mechanism is prescribed by its drivers. With q, q̇, q̈ known,
//! ```text
//! M q̈ + Φ_qᵀ λ = Q
//! ```
//! is linear in the multipliers λ, and the constraints exert the generalized forces −Φ_qᵀ λ. Masses and loads are
//! written as forces along lengths and angles (see [`Mass`], [`Force`], [`Spring`], …). The forces of drivers and
//! joints follow from λ and the rows of Φ for free bodies. After Haug (1989), chapters 6 and 7.

mod dynamics;
mod elastic;
mod equilibrium;
mod force;
mod forces;
mod free_bodies;
mod gravity;
mod kinds;
mod load;
mod mass;
mod reactions;
mod spring;
mod torque;
mod torsion_spring;
mod transpose;

pub use dynamics::{PrintedDynamics, dynamics};
pub use force::Force;
pub use forces::{Forces, LoadForce, MassValues, SpringForce, forces};
pub use gravity::Gravity;
pub use kinds::forms;
pub use mass::Mass;
pub use reactions::{Effort, ReactionForce};
pub use spring::Spring;
pub use torque::Torque;
pub use torsion_spring::TorsionSpring;
