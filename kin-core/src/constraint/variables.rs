//! What the variables of a curve stand for while its formulas are written.

use crate::expr::ExprId;
use crate::mechanism::CurveVariable;

/// What the variables of the curve at hand stand for; nothing outside of a curve.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Variables {
    pub(crate) theta: Option<ExprId>,
    pub(crate) point: Option<[ExprId; 2]>,
    /// The parameter that stands for the argument of a curve that is drawn.
    pub(crate) parameter: Option<u32>,
}

impl Variables {
    /// True for the parameter of a curve that is drawn.
    pub(crate) fn is_parameter(&self, k: u32) -> bool {
        self.parameter == Some(k)
    }

    /// What `variable` stands for.
    pub(crate) const fn get(&self, variable: CurveVariable) -> Option<ExprId> {
        match (variable, self.point) {
            (CurveVariable::Theta, _) => self.theta,
            (CurveVariable::X, Some([x, _])) => Some(x),
            (CurveVariable::Y, Some([_, y])) => Some(y),
            (_, None) => None,
        }
    }
}
