//! What a joint hands to the constraint set.

use super::assembly::Assembly;
use super::pose::PlacedPoint;
use super::set::{RowMeaning, VelocityRow};
use crate::expr::ExprId;
use crate::mechanism::Formula;
use crate::vocabulary::Frame;
use crate::vocabulary::Role;

/// What a joint hands back: rows as (suffix of the name, what the row says, residual), and what it reports.
#[derive(Default)]
pub(crate) struct Rows {
    pub(crate) residuals: Vec<(&'static str, RowMeaning, ExprId)>,
    /// The row of velocity level; its joint has no other.
    pub(crate) velocity: Option<VelocityRow>,
    pub(crate) geometry: Vec<(Role, Frame, Vec<ExprId>)>,
    pub(crate) quantities: Vec<(&'static str, ExprId)>,
    pub(crate) frames: [Option<Frame>; 2],
}

impl Rows {
    /// The two points of a joint, with their geometry.
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
