//! Reports on a solution: degrees of freedom, velocity ratios, transmission angles, motion, and quantities by name.

pub mod measure;
pub mod mobility;
pub(crate) mod motion;
pub mod ratios;
pub mod transmission;
