//! Guides whose direction is given by parameters: rows a x + b y + … = 0 in which either coefficient may be 0.

use crate::constraint::ConstraintSet;

/// The rows of guides whose direction is given by parameters.
#[derive(Debug, Default)]
pub(super) struct Guides {
    /// The coordinates x and y of every origin that has both.
    pub(super) origins: Vec<[u32; 2]>,
    /// Whether such rows are no pivots.
    pub(super) left: bool,
    /// Whether such a row was met.
    pub(super) met: bool,
}

impl Guides {
    /// The guides of a mechanism, whose rows are left.
    pub(super) fn new(set: &ConstraintSet) -> Self {
        let origins = set.bodies.iter().filter_map(|body| Some([body.coordinates[0]?, body.coordinates[1]?]));
        Self { origins: origins.collect(), left: true, met: false }
    }
}
