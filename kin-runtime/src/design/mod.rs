//! Synthesis: the dimensions with which a mechanism does what is wanted.
//!
//! A [`Design`] consists of the parameters that may vary with their bounds, of objectives – a point through given
//! places, a quantity as a function of the drive, poses of a body – and of conditions. [`Design::search`] begins at
//! many random designs, on all cores, and from each descends to a design with the least sum of squared misses
//! (differences from what is wanted), by bounded nonlinear least squares with the exact derivatives of
//! [`Solver::sensitivities`](crate::Solver::sensitivities): by a bounded Levenberg–Marquardt method, and at the end by
//! the trust-region-reflective method of Branch, Coleman and Li (SIAM J. Sci. Comput. 21, 1999), both as implemented by
//! the crate `basin`.
//!
//! Every design is a motion that is followed in one assembly mode from the first instant to the last, so that no design
//! requires a change of branch, circuit or order. A step to a design that does not assemble all the way is refused.
//! Conditions are kept at every step, by terms τ/c² that keep the slack c positive and vanish with τ in the end.
//!
//! ```
//! use kin_runtime::design::{Design, Search};
//! use kin_runtime::mechanism;
//!
//! /// A crank with a pen.
//! #[mechanism]
//! #[bodies(crank)]
//! #[point(pen = crank @ (l, h))]
//! #[revolute(pin: ground @ (0, 0), crank @ (0, 0))]
//! #[driver(drive: crank.phi = t)]
//! struct Crank {
//!     #[param(0.2)]
//!     l: f64,
//!     #[param(0.0)]
//!     h: f64,
//! }
//!
//! # fn main() -> Result<(), kin_runtime::design::DesignError> {
//! let places = [(0.0, [0.3, 0.1]), (0.5, [0.2153, 0.2316])];
//! let found = Design::new(&Crank::default())
//!     .free("l", 0.1..=1.0)?
//!     .free("h", -1.0..=1.0)?
//!     .path_at("pen", &places)?
//!     .search(&Search { starts: 4, ..Search::default() })?;
//! assert!((found.mechanism.l - 0.3).abs() < 1e-3 && found.error < 1e-7);
//! # Ok(())
//! # }
//! ```

mod builder;
mod condition;
mod error;
mod evolution;
mod fit;
mod follow;
mod motion;
mod objective;
mod problem;
mod result;
mod search;
mod task;
mod text;
mod variables;
mod verify;

pub use crate::results::varied::Number;
pub use builder::Design;
pub use condition::Shortest;
pub use error::{DesignError, Missed};
#[cfg(feature = "cli")]
pub(crate) use objective::DesignQuantity;
pub use objective::Direction;
pub use result::{Designed, Slack};
pub use search::{Progress, Search};
#[cfg(feature = "cli")]
pub(crate) use {search::searched, task::Task};
