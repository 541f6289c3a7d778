//! Forces: what drivers must supply and what joints carry, in closed form.
//!
//! A mechanism with masses and loads moves as its drivers say. With q, q̇, q̈ known,
//! ```text
//! M q̈ + Φ_qᵀ λ = Q
//! ```
//! is linear in the multipliers λ, and rows with their multipliers exert −Φ_qᵀ λ on the bodies. Masses and loads are
//! written as forces along quantities (see [`Mass`], [`Force`], [`Spring`], …); what drivers and joints exert follows from
//! λ and the rows of free bodies. After Haug (1989), chapters 6 and 7.

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

pub use dynamics::{Dynamics, dynamics};
pub use force::Force;
pub use forces::{Forces, LoadForce, SpringForce, forces};
pub use gravity::Gravity;
pub use kinds::forms;
pub use mass::Mass;
pub use reactions::{Effort, ReactionForce};
pub use spring::Spring;
pub use torque::Torque;
pub use torsion_spring::TorsionSpring;
