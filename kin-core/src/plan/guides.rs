//! Guides whose direction is given by parameters: rows a x + b y + … = 0 in which either coefficient may be 0.

use crate::constraint::ConstraintSet;

/// How a reduction treats the rows of guides whose direction is given by parameters.
#[derive(Debug, Default)]
pub(super) struct Guides {
    /// The coordinates x and y of every origin that has both.
    pub(super) origins: Vec<[u32; 2]>,
    /// Whether the current reduction skips such rows and does not use them as pivots.
    pub(super) skipped: bool,
    /// Whether the current reduction has found such a row.
    pub(super) found: bool,
}

impl Guides {
    /// For the bodies of a mechanism; rows of guides are skipped.
    pub(super) fn new(set: &ConstraintSet) -> Self {
        let origins = set.bodies.iter().filter_map(|body| Some([body.coordinates[0]?, body.coordinates[1]?]));
        Self { origins: origins.collect(), skipped: true, found: false }
    }
}
