//! Benchmarks that report ratios to a baseline of the same run, because absolute times on a shared, noisy machine say
//! little.

pub mod chain;
pub mod dual;
pub mod four_bar;
pub mod library;
pub mod loaded;
pub mod paired;
pub mod placed;
pub mod random;
pub mod robot;
pub mod ten;
