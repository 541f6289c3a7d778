//! Where the value of a quantity comes from, for code that evaluates many configurations together.

use crate::model::Geometry;

/// Where the value of a quantity comes from, in terms of what a [`Mechanism`](crate::Mechanism) evaluates. `order` is 0 for a
/// value, 1 for its rate and 2 for its acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Source {
    /// Time.
    Time,
    /// An entry of q, q̇ or q̈.
    Coordinate {
        /// Its place in [`Model::coordinates`](crate::model::Model::coordinates).
        place: usize,
        /// Of which of the three.
        order: usize,
    },
    /// A row of the observables.
    Observable {
        /// Its place in [`Model::observables`](crate::model::Model::observables).
        row: usize,
        /// Its value, its rate or its acceleration.
        order: usize,
    },
    /// The length of the vector of the rates of two rows of the observables.
    Speed([usize; 2]),
    /// An input.
    Input {
        /// Its place in [`Model::inputs`](crate::model::Model::inputs).
        place: usize,
        /// Its value, its rate or its acceleration.
        order: usize,
    },
    /// The angle at the first of three points of joints between the lines to the other two, in [0, π].
    Transmission([&'static Geometry; 3]),
    /// One of the numbers of forces ([`ForceModel`](crate::model::ForceModel)).
    Force(usize),
    /// The length of the vector of this number of forces and the next one.
    ForceLength(usize),
}
