//! The rows and results that a joint contributes to the constraint set.

use super::assembly::Assembly;
use super::pose::PlacedPoint;
use super::set::{RowMeaning, VelocityRow};
use crate::expr::ExprId;
use crate::mechanism::Formula;
use crate::vocabulary::Frame;
use crate::vocabulary::Role;

/// The contribution of a joint: rows as (suffix of the name, meaning, residual), geometry and reported quantities.
#[derive(Default)]
pub(crate) struct JointRows {
    pub(crate) residuals: Vec<(&'static str, RowMeaning, ExprId)>,
    /// The row of velocity level; a joint with such a row has no other.
    pub(crate) velocity: Option<VelocityRow>,
    pub(crate) geometry: Vec<(Role, Frame, Vec<ExprId>)>,
    pub(crate) quantities: Vec<(&'static str, ExprId)>,
    pub(crate) frames: [Option<Frame>; 2],
}

impl JointRows {
    /// The geometry of a joint between two points, as yet without rows.
    pub(crate) fn between(p: &PlacedPoint, q: &PlacedPoint) -> Self {
        Self {
            frames: [Some(p.frame), Some(q.frame)],
            geometry: vec![(Role::P, p.frame, p.local.to_vec()), (Role::Q, q.frame, q.local.to_vec())],
            ..Self::default()
        }
    }

    /// The row left − right.
    pub(crate) fn equation(a: &mut Assembly<'_>, left: &Formula, right: &Formula) -> Self {
        let (left, right) = (a.formula(left), a.formula(right));
        Self { residuals: vec![("", RowMeaning::Other, a.graph.sub(left, right))], ..Self::default() }
    }
}
