//! A configuration of numbers that carry their derivatives with respect to some of the parameters.

use crate::scalar::Tangents;
use crate::signal::Signal;

/// The number of parameters with respect to which one evaluation differentiates.
pub(crate) const WIDTH: usize = 8;

/// A number with its derivatives with respect to several parameters.
#[allow(unreachable_pub, reason = "only with the feature `design` is it public")]
pub type Number = Tangents<WIDTH>;

/// q, q̇ and q̈ with their derivatives, and what is reported of them.
#[derive(Clone, Debug)]
pub(crate) struct Varied<T = Number> {
    pub(crate) q: Vec<T>,
    pub(crate) q_dot: Vec<T>,
    pub(crate) q_ddot: Vec<T>,
    /// The margins of the plan; empty where it did not solve.
    pub(crate) margins: Vec<T>,
    /// The observables with their rates.
    pub(crate) observed: Vec<Signal<T>>,
    /// The numbers of the joints' geometry; empty where they are not needed.
    pub(crate) geometry: Vec<T>,
    /// The numbers of forces; empty where they are not needed.
    pub(crate) forces: Vec<T>,
}

impl<T> Default for Varied<T> {
    fn default() -> Self {
        let [q, q_dot, q_ddot, margins, geometry, forces] = core::array::from_fn(|_| Vec::new());
        Self { q, q_dot, q_ddot, margins, observed: Vec::new(), geometry, forces }
    }
}
