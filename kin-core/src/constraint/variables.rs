//! The values of a curve's variables while its formulas are written.

use crate::expr::ExprId;
use crate::mechanism::CurveVariable;

/// The values of the variables of the current curve; all `None` outside a curve.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Variables {
    pub(crate) theta: Option<ExprId>,
    pub(crate) point: Option<[ExprId; 2]>,
    /// The scalar coordinate that is replaced by the free argument while the curve is written for drawings.
    pub(crate) parameter: Option<u32>,
}

impl Variables {
    /// True if coordinate `k` is the parameter of a curve that is written for drawings.
    pub(crate) fn is_parameter(&self, k: u32) -> bool {
        self.parameter == Some(k)
    }

    /// The value of `variable`.
    pub(crate) const fn get(&self, variable: CurveVariable) -> Option<ExprId> {
        match (variable, self.point) {
            (CurveVariable::Theta, _) => self.theta,
            (CurveVariable::X, Some([x, _])) => Some(x),
            (CurveVariable::Y, Some([_, y])) => Some(y),
            (_, None) => None,
        }
    }
}
