//! What is reported of a solution: degrees of freedom, velocity ratios, transmission angles, the motion of everything.

pub mod measure;
pub mod mobility;
pub(crate) mod motion;
pub mod ratios;
pub mod transmission;
