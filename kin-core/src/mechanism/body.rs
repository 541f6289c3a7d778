//! Bodies, scalar coordinates, points and the other named parts of a mechanism.

use super::{Component, Formula, Place};
use crate::error::Origin;

/// How the origin of a body is determined.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyOrigin {
    /// x and y are generalized coordinates unless they are held, that is, prescribed by a formula (lecture, solutions 1
    /// and 2).
    Free {
        /// The held value of x, a formula of parameters, t, inputs and scalar coordinates.
        x: Option<Formula>,
        /// The held value of y, a formula of the same kind.
        y: Option<Formula>,
    },
    /// The origin is a point of another body, its carrier, or of the ground (lecture, solution 3).
    Carried(Place),
}

/// A body, or a family of bodies `link[0] … link[len − 1]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The name without index.
    pub name: String,
    /// The number of members; `None` for a single body.
    pub len: Option<usize>,
    /// How the origin is determined.
    pub origin_at: BodyOrigin,
    /// The held value of the angle.
    pub phi: Option<Formula>,
    /// The token that declares the body.
    pub origin: Origin,
}

/// How a component of a body's pose is determined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source<'m> {
    /// A generalized coordinate.
    Free,
    /// Held: prescribed by a formula of parameters, t, inputs and scalar coordinates.
    Held(&'m Formula),
    /// Carried: the coordinate of a point of another body.
    Carried(&'m Place),
}

impl Body {
    /// How a component of the pose is determined.
    pub fn source(&self, component: Component) -> Source<'_> {
        let held = match (component, &self.origin_at) {
            (Component::Phi, _) => &self.phi,
            (_, BodyOrigin::Carried(place)) => return Source::Carried(place),
            (Component::X, BodyOrigin::Free { x, .. }) => x,
            (Component::Y, BodyOrigin::Free { y, .. }) => y,
        };
        held.as_ref().map_or(Source::Free, Source::Held)
    }

    /// True if the component is a generalized coordinate.
    pub fn is_free(&self, component: Component) -> bool {
        matches!(self.source(component), Source::Free)
    }
}

/// Scalar generalized coordinates (global method, curve parameters).
#[derive(Clone, Debug, PartialEq)]
pub struct Scalar {
    /// The name without index.
    pub name: String,
    /// The number of members; `None` for a single coordinate.
    pub len: Option<usize>,
    /// The unit as the user wrote it.
    pub unit: Option<String>,
    /// The token that declares the coordinate.
    pub origin: Origin,
}

/// A parameter, which is a field of the struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name of the field.
    pub name: String,
    /// The number of elements of an array field.
    pub len: Option<usize>,
    /// The unit as the user wrote it.
    pub unit: Option<String>,
    /// The default value of every element, if all elements have one.
    pub default: Option<Vec<f64>>,
    /// The first paragraph of the field's doc comment.
    pub doc: String,
    /// The token that declares the parameter.
    pub origin: Origin,
}

/// An input: a signal known only at run time, with its rate and acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// The name without index.
    pub name: String,
    /// The number of members; `None` for a single input.
    pub len: Option<usize>,
    /// The unit as the user wrote it.
    pub unit: Option<String>,
    /// The value that is used if the caller gives none, on the command line and in examples.
    pub default: Option<f64>,
    /// The token that declares the input.
    pub origin: Origin,
}

/// A scalar function that the user supplies as a field of the struct, or an array of such functions.
#[derive(Clone, Debug, PartialEq)]
pub struct SuppliedFunction {
    /// The name of the field.
    pub name: String,
    /// The number of elements of an array field.
    pub len: Option<usize>,
    /// The token that declares the function.
    pub origin: Origin,
}

/// A named point, or a family of points; its velocity and acceleration are reported, too.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// The name without index.
    pub name: String,
    /// The range of a family.
    pub range: Option<Range>,
    /// The point.
    pub place: Place,
    /// The token that declares the point.
    pub origin: Origin,
}

/// A named expression, or a family of them; its rate and acceleration are reported, too.
#[derive(Clone, Debug, PartialEq)]
pub struct Define {
    /// The name without index.
    pub name: String,
    /// The range of a family.
    pub range: Option<Range>,
    /// The formula.
    pub formula: Formula,
    /// The unit as the user wrote it.
    pub unit: Option<String>,
    /// The token that declares the expression.
    pub origin: Origin,
}

/// The range of a family, `N[i in start..end]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Range {
    /// The first index.
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
