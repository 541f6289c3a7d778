//! Many configurations of one mechanism at once: columns of numbers in, blocks of lanes out.
//!
//! Every operation is applied to four configurations at once ([`Lanes`](crate::Lanes)), or to eight where they are
//! solved; with the feature `parallel` large batches are distributed over the cores. Parameters, time, inputs, q and q̇
//! are [`Column`]s, each with a number per configuration or one for all. Results are blocks that the generated code
//! writes directly (for evaluations one workspace of lanes for every four configurations), and are read as columns. The
//! result for a configuration does not depend on its place in the batch: it is the same to the last bit, or within the
//! tolerance of the iteration if the plan has Newton steps.
//!
//! ```
//! use kin_runtime::batch::{Column, Configurations, Evaluations, Progress, evaluate};
//! use kin_runtime::{Mechanism, Subset, mechanism};
//! use std::ops::ControlFlow;
//!
//! #[mechanism]
//! #[bodies(arm)]
//! #[revolute(O: ground @ (0, 0), arm @ (-l, 0))]
//! #[driver(drive: arm.phi = omega * t)]
//! struct Arm {
//!     #[param(0.5)]
//!     l: f64,
//!     #[param(2)]
//!     omega: f64,
//! }
//!
//! // Six arms with different lengths, all at x = 0.5, y = 0, φ = 0.
//! let arm = Arm::default();
//! let lengths = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
//! let configurations = Configurations {
//!     parameters: &[Column::Each(&lengths), Column::Shared(arm.omega)],
//!     t: Column::Shared(0.0),
//!     inputs: &[],
//!     q: &[Column::Shared(0.5), Column::Shared(0.0), Column::Shared(0.0)],
//!     q_dot: &[Column::Shared(0.0); 3],
//! };
//! let mut out = Evaluations::<Arm>::new(lengths.len());
//! let watch = |progress: Progress| match progress.done {
//!     _ if progress.total > 1_000_000_000 => ControlFlow::Break(()),
//!     _ => ControlFlow::Continue(()),
//! };
//! evaluate(&arm, Subset::ALL, &configurations, &mut out, &watch)?;
//! // Φ of the row O.x is x − l cos φ.
//! for (phi, l) in out.phi(0).zip(lengths) {
//!     assert_eq!(0.5 - l, phi);
//! }
//! // ∂Φ/∂φ of the row O.y, an entry of the pattern: −l.
//! let entry = Arm::model().constraint_pattern.entries.iter().position(|entry| *entry == (1, 2));
//! let column: Vec<f64> = out.phi_q(entry.expect("φ is in the row y")).collect();
//! assert_eq!([-0.5, -0.6, -0.7, -0.8, -0.9, -1.0], *column);
//! # Ok::<(), kin_runtime::batch::BatchError>(())
//! ```
//!
//! [`solve`] gives q, q̇ and q̈ by the plan ([`crate::plan`]); for these [`forces()`] gives the efforts of drivers and
//! reactions of joints, and `sensitivities` the derivatives of any quantities with respect to the parameters. [`sweep`]
//! computes the whole motion of many sets of parameters over one time grid. It passes each instant to a closure and
//! keeps no states, so that millions of motions fit into memory.

mod block_solution;
mod checks;
mod column;
mod end;
mod evaluation;
mod forces;
mod modes;
mod motion;
mod run;
#[cfg(feature = "std")]
mod sensitivities;
mod solution;
mod sweep;
#[cfg(all(test, feature = "std"))]
mod tests;
mod text;

pub use column::{Column, Configurations};
pub use end::End;
pub use evaluation::{Evaluations, evaluate};
pub use forces::{ForceSolutions, forces};
pub use modes::Modes;
pub use run::{Progress, always};
#[cfg(feature = "std")]
pub use sensitivities::{SensitivitySolutions, sensitivities};
pub use solution::{Problems, Solutions, solve};
pub use sweep::{Moment, Motions, Sweeps, sweep};

use crate::mechanism::LengthError;

/// Why a batch has no results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BatchError {
    /// A list of columns, or a column, has the wrong length.
    Length(LengthError),
    /// The mechanism has no plan, with the reason: it can only be evaluated.
    NoPlan(&'static str),
    /// There are no forces in closed form, with the reason.
    NoForces(&'static str),
    /// There are no derivatives with respect to parameters in closed form, with the reason.
    NoSensitivities(&'static str),
    /// The mechanism has no parameter with this index.
    UnknownParameter {
        /// The index.
        index: usize,
        /// The number of parameters.
        parameters: usize,
    },
    /// The argument `watch` stopped the batch; results are incomplete.
    Stopped(Progress),
}

impl core::fmt::Display for BatchError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Length(error) => error.fmt(f),
            Self::NoPlan(why) => write!(f, "no plan because {why}"),
            Self::NoForces(why) => write!(f, "no forces because {why}"),
            Self::NoSensitivities(why) => write!(f, "no sensitivities because {why}"),
            Self::UnknownParameter { index, parameters } => write!(f, "no parameter {index} among {parameters}"),
            Self::Stopped(progress) => write!(f, "stopped after {progress}"),
        }
    }
}

/// The source is the [`LengthError`], if that is the reason; the message contains that of the source.
impl core::error::Error for BatchError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        if let Self::Length(error) = self { Some(error) } else { None }
    }
}

impl From<LengthError> for BatchError {
    fn from(error: LengthError) -> Self {
        Self::Length(error)
    }
}
