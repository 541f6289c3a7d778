//! Where the value of a quantity comes from, for code that evaluates many configurations together.

use crate::model::Geometry;
use core::fmt;

/// Where the value of a quantity comes from, in terms of what a [`Mechanism`](crate::Mechanism) evaluates. `order` is 0 for a
/// value, 1 for its rate and 2 for its acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Source {
    /// Time.
    Time,
    /// An entry of q, q̇ or q̈.
    Coordinate {
        /// Its index in [`Model::coordinates`](crate::model::Model::coordinates).
        place: usize,
        /// 0 for q, 1 for q̇, 2 for q̈.
        order: usize,
    },
    /// A row of the observables.
    Observable {
        /// Its index in [`Model::observables`](crate::model::Model::observables).
        row: usize,
        /// Its value, its rate or its acceleration.
        order: usize,
    },
    /// The length of the vector of the rates of two rows of the observables.
    Speed([usize; 2]),
    /// An input.
    Input {
        /// Its index in [`Model::inputs`](crate::model::Model::inputs).
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

/// `the rate of coordinate 2`.
impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let derivative_of = |order: usize| match order {
            0 => "",
            1 => "the rate of ",
            _ => "the acceleration of ",
        };
        match self {
            Self::Time => f.write_str("time"),
            Self::Coordinate { place, order } => write!(f, "{}coordinate {place}", derivative_of(*order)),
            Self::Observable { row, order } => write!(f, "{}observable {row}", derivative_of(*order)),
            Self::Speed([x, y]) => write!(f, "the speed of observables {x} and {y}"),
            Self::Input { place, order } => write!(f, "{}input {place}", derivative_of(*order)),
            Self::Transmission(_) => f.write_str("a transmission angle"),
            Self::Force(place) => write!(f, "number {place} of the forces"),
            Self::ForceLength(place) => write!(f, "the length of numbers {place} and {} of the forces", place + 1),
        }
    }
}
