//! The state of an assembly: everything that is known while the rows of Φ are written.

use super::pose::Pose;
use super::set::{ConstraintSet, Observable, ObservableKind};
use super::variables::Variables;
use crate::error::{ModelError, Origin};
use crate::expr::{ExprId, Graph};
use crate::mechanism::{Mechanism, Range, Value};
use std::collections::{BTreeSet, HashMap};

/// The state of an assembly.
pub(crate) struct Assembly<'m> {
    pub(crate) mechanism: &'m Mechanism,
    pub(crate) graph: Graph,
    /// The index of the first member of every body family.
    pub(crate) first_body: Vec<usize>,
    /// The poses of all bodies, as far as they are known.
    pub(crate) poses: Vec<Pose>,
    /// The pose of the ground.
    pub(crate) ground: [ExprId; 3],
    pub(crate) coordinates_of: Vec<[Option<u32>; 3]>,
    pub(crate) first_scalar: Vec<u32>,
    pub(crate) first_parameter: Vec<u32>,
    pub(crate) first_input: Vec<u32>,
    pub(crate) first_function: Vec<u32>,
    /// The values of defines by family and index; `None` while a define is being built.
    pub(crate) defines: HashMap<(usize, i64), Option<ExprId>>,
    /// The value of the index variable in the range that is being laid out.
    pub(crate) index: i64,
    /// The name of the joint that is being written, if it is a member of a family.
    pub(crate) member: Option<String>,
    /// The values of the variables of the curve that is being written.
    pub(crate) variables: Variables,
    /// If set, every q̇ is 0, and the rates of formulas are their partial time derivatives.
    pub(crate) at_rest: bool,
    /// The curve of the joint that is being written, for drawings.
    pub(crate) outline: Option<[ExprId; 4]>,
    /// The distances of points that may coincide.
    pub(crate) distances: BTreeSet<ExprId>,
    pub(crate) errors: Vec<ModelError>,
}

impl Assembly<'_> {
    pub(crate) fn error(&mut self, origin: Origin, message: impl Into<String>) -> ExprId {
        self.errors.push(ModelError::new(origin, message));
        self.graph.zero()
    }

    /// Reports an error at most once for each origin, because all members of a family share an origin.
    pub(crate) fn error_once(&mut self, origin: Origin, message: impl Into<String>) {
        if self.errors.iter().all(|error| error.origin != origin) {
            self.error(origin, message);
        }
    }

    /// Reports that an operand of a joint is degenerate; the message names the member of a family.
    pub(crate) fn degenerate(&mut self, origin: Origin, quantity: &str, message: impl core::fmt::Display) {
        let member = self.member.as_ref().map_or(String::new(), |name| format!(" of `{name}`"));
        self.error_once(origin, format!("{quantity}{member} {message}"));
    }

    /// The radius of a disc or gear, which must not be 0. A literal 0 has been rejected by a rule before.
    pub(crate) fn radius(&mut self, radius: &Value) -> ExprId {
        let right = "a radius is positive, or negative for a disc or gear that the other runs inside of";
        self.nonzero(radius, "this radius", right)
    }

    /// A length, which must be positive. Literal ones have been checked by a rule before.
    pub(crate) fn length(&mut self, length: &Value) -> ExprId {
        let formula = self.formula(&length.value);
        let (origin, quantity) = (length.origin, "this length");
        match self.graph.literal(formula) {
            Some(0.0) => {
                let message = "is 0, whose row has no gradient; points that coincide are joined with `revolute`";
                self.degenerate(origin, quantity, message);
            }
            Some(value) if value < 0.0 => {
                self.degenerate(origin, quantity, format_args!("is {value}; a length is positive"));
            }
            _ => {}
        }
        formula
    }

    /// A value that must not be 0; the `quantity` and what is `right` are parts of the message.
    pub(crate) fn nonzero(&mut self, value: &Value, quantity: &str, right: &str) -> ExprId {
        let before = self.errors.len();
        let formula = self.formula(&value.value);
        if self.graph.is_zero(formula) && self.errors.len() == before {
            self.degenerate(value.origin, quantity, format_args!("is 0; {right}"));
        }
        formula
    }

    pub(crate) fn observe(&self, set: &mut ConstraintSet, kind: ObservableKind, value: ExprId) -> usize {
        set.observables.push(Observable { kind, value });
        set.observables.len() - 1
    }

    /// The instances of a range, as (index in the name, index): without a range a single instance, otherwise one for
    /// every index.
    pub(crate) fn instances(range: Option<Range>) -> Vec<(Option<i64>, i64)> {
        match range {
            None => vec![(None, 0)],
            Some(range) => range.indices().map(|i| (Some(i), i)).collect(),
        }
    }
}
