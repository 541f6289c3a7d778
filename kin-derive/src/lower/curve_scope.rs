//! Names that are known inside the formula of a curve only.

use kin_core::mechanism::{CurveVariable, Index};

/// The names that the curve which is being lowered defines.
#[derive(Clone, Debug, Default)]
pub(super) struct Inside {
    pub(super) variables: &'static [CurveVariable],
    /// Family and index of the parameter of a parametric curve, and its text.
    pub(super) parameter: Option<(usize, Index, String)>,
}

impl Inside {
    /// The variable called `name`.
    pub(super) fn variable(&self, name: &str) -> Option<CurveVariable> {
        self.variables.iter().copied().find(|variable| variable.name() == name)
    }

    /// True for the parameter of the curve.
    pub(super) fn is_parameter(&self, family: usize, index: Index) -> bool {
        self.parameter.as_ref().is_some_and(|(parameter_family, at, _)| (*parameter_family, *at) == (family, index))
    }

    /// The words that the formula of the curve may contain besides numbers, parameters and `t`; empty outside of
    /// curves.
    pub(super) fn words(&self) -> Vec<&str> {
        let variables = self.variables.iter().map(|variable| variable.name());
        variables.chain(self.parameter.as_ref().map(|(_, _, word)| word.as_str())).collect()
    }
}
