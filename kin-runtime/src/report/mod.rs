//! Reports on a solution: velocity ratios, transmission angles, motion, and quantities by name.

pub mod measure;
pub(crate) mod motion;
pub mod ratios;
pub mod transmission;
