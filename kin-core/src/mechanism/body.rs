//! Bodies, scalar coordinates, points and the other named parts of a mechanism.

use super::{Component, Formula, Place};
use crate::error::Origin;

/// How the origin of a body is given.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyOrigin {
    /// x and y are generalized coordinates unless held at a value (lecture, solutions 1 and 2).
    Free {
        /// Held x, a formula of parameters, t, inputs and scalar coordinates.
        x: Option<Formula>,
        /// Held y, likewise.
        y: Option<Formula>,
    },
    /// The origin is a point of another body (lecture, solution 3).
    Carried(Place),
}

/// A body, or a family of equal bodies `link[0] … link[len − 1]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name without index.
    pub name: String,
    /// Number of members; `None` for a single body.
    pub len: Option<usize>,
    /// Where the origin comes from.
    pub origin_at: BodyOrigin,
    /// Held rotation, likewise.
    pub phi: Option<Formula>,
    /// The token that declared it.
    pub origin: Origin,
}

/// Where a component of a body's pose comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source<'m> {
    /// It is a generalized coordinate.
    Free,
    /// It is held at a value.
    Held(&'m Formula),
    /// It is that of a point of another body.
    Carried(&'m Place),
}

impl Body {
    /// Where a component of the pose comes from.
    pub fn source(&self, component: Component) -> Source<'_> {
        let held = match (component, &self.origin_at) {
            (Component::Phi, _) => &self.phi,
            (_, BodyOrigin::Carried(place)) => return Source::Carried(place),
            (Component::X, BodyOrigin::Free { x, .. }) => x,
            (Component::Y, BodyOrigin::Free { y, .. }) => y,
        };
        held.as_ref().map_or(Source::Free, Source::Held)
    }

    /// True for a component that is a generalized coordinate.
    pub fn is_free(&self, component: Component) -> bool {
        matches!(self.source(component), Source::Free)
    }
}

/// Scalar generalized coordinates (global method, curve parameters).
#[derive(Clone, Debug, PartialEq)]
pub struct Scalar {
    /// Name without index.
    pub name: String,
    /// Number of members; `None` for a single one.
    pub len: Option<usize>,
    /// Its unit, as written.
    pub unit: Option<String>,
    /// The token that declared it.
    pub origin: Origin,
}

/// A parameter: a field of the struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Field name.
    pub name: String,
    /// Number of elements of an array field.
    pub len: Option<usize>,
    /// Unit for people, as written.
    pub unit: Option<String>,
    /// Default value of every element, when all have one.
    pub default: Option<Vec<f64>>,
    /// The field's doc comment, first paragraph.
    pub doc: String,
    /// The token that declared it.
    pub origin: Origin,
}

/// A signal known only at run time, with its rate and acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name without index.
    pub name: String,
    /// Number of members; `None` for a single one.
    pub len: Option<usize>,
    /// Its unit, as written.
    pub unit: Option<String>,
    /// Its value where nobody gives one: on the command line, and in examples.
    pub default: Option<f64>,
    /// The token that declared it.
    pub origin: Origin,
}

/// A scalar function that the caller supplies as a field of the struct, or an array of them.
#[derive(Clone, Debug, PartialEq)]
pub struct SuppliedFunction {
    /// Field name.
    pub name: String,
    /// Number of elements of an array field.
    pub len: Option<usize>,
    /// The token that declared it.
    pub origin: Origin,
}

/// A named point, reported with velocity and acceleration; `range` when repeated.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Name without index.
    pub name: String,
    /// Range of the family, when repeated.
    pub range: Option<Range>,
    /// Where it is.
    pub place: Place,
    /// The token that declared it.
    pub origin: Origin,
}

/// A named expression, reported with rate and acceleration when it holds coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Define {
    /// Name without index.
    pub name: String,
    /// Range of the family, when repeated.
    pub range: Option<Range>,
    /// Its formula.
    pub formula: Formula,
    /// Its unit, as written.
    pub unit: Option<String>,
    /// The token that declared it.
    pub origin: Origin,
}

/// The range of a repeated row, point or define: `N[i in start..end]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Range {
    /// First index.
    pub start: i64,
    /// One past the last index.
    pub end: i64,
}

impl Range {
    /// The indices in order.
    pub fn indices(self) -> core::ops::Range<i64> {
        self.start..self.end
    }
}
