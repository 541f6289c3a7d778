//! Observers follow the progress of an analysis and may end it early.
//!
//! ```
//! # use kin_runtime::{mechanism, SolveError, Solver};
//! use std::ops::ControlFlow;
//!
//! #[mechanism]
//! #[coordinates(phi)]
//! #[driver(drive: phi = 2*t)]
//! #[derive(Default)]
//! struct Crank {}
//!
//! let enough = |reached: kin_runtime::Reached<'_>| match reached.state {
//!     Some(state) if state.q[0] > 1.0 => ControlFlow::Break(()),
//!     _ => ControlFlow::Continue(()),
//! };
//! let crank = Crank::default();
//! let ended = Solver::new(&crank).with_observer(&enough).sweep(&[0.0, 0.4, 0.8, 1.2]).unwrap_err();
//! assert_eq!(ended.trajectory.len(), 3);
//! assert!(matches!(ended.source, SolveError::Stopped { done: 3, total: 4, .. }));
//! ```

use crate::error::SolveError;
use crate::state::State;
use core::fmt;
use core::ops::ControlFlow;

/// The progress of an analysis.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Reached<'a> {
    /// Instants of a sweep, or configurations of a check, that are finished.
    pub done: usize,
    /// Their total number.
    pub total: usize,
    /// The time that was reached; in a sweep it may be between two of its instants.
    pub t: f64,
    /// The state at the instant that was just finished; none between two instants, and in checks.
    pub state: Option<&'a State>,
}

impl fmt::Display for Reached<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} at t = {}", self.done, self.total, self.t)
    }
}

/// A function that is called with the progress of an analysis and decides whether it goes on.
///
/// A sweep calls it after every instant and after every internal step between two instants, a check after every
/// configuration. It should be quick: a step takes microseconds.
#[doc(hidden)]
pub type Observer<'a> = &'a dyn Fn(Reached<'_>) -> ControlFlow<()>;

/// An analysis with its observer, if it has one.
#[derive(Clone, Copy)]
pub(crate) struct Observed<'a> {
    observer: Option<Observer<'a>>,
    done: usize,
    total: usize,
}

impl<'a> Observed<'a> {
    pub(crate) const fn new(observer: Option<Observer<'a>>, total: usize) -> Self {
        Self { observer, done: 0, total }
    }

    /// True if there is an observer.
    pub(crate) const fn is_there(&self) -> bool {
        self.observer.is_some()
    }

    /// Counts one more as finished; an error if the observer ends the analysis before the last one.
    pub(crate) fn finish(&mut self, t: f64, state: Option<&State>) -> Result<(), SolveError> {
        self.done += 1;
        self.call(t, state)
    }

    /// Reports an internal step; an error if the observer ends the analysis.
    pub(crate) fn pass(&self, t: f64) -> Result<(), SolveError> {
        self.call(t, None)
    }

    fn call(&self, t: f64, state: Option<&State>) -> Result<(), SolveError> {
        let Self { observer: Some(observer), done, total } = *self else { return Ok(()) };
        match observer(Reached { done, total, t, state }) {
            // An observer that stops after the last one changes nothing: all are finished.
            ControlFlow::Break(()) if done < total => Err(SolveError::Stopped { t, done, total }),
            _ => Ok(()),
        }
    }
}
