//! Speed as ratios against a baseline of the same run: machines are shared and noisy, times alone say little.

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
