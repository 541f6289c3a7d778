//! The rule for constant parts of a formula: they have a value.

use super::lowerer::Lowerer;
use super::range::IndexRange;
use super::substitute;
use crate::ast::text;
use crate::function::value;
use kin_core::mechanism::{Formula, Function, Index};
use proc_macro2::Span;

impl Lowerer<'_> {
    /// The formula, unless it is a constant without a finite value, which is reported.
    pub(super) fn with_value(&self, formula: Formula, span: Span) -> Option<Formula> {
        match self.constant(&formula) {
            Some(value) if !value.is_finite() => self.refuse(span, self.why(&formula)),
            _ => Some(formula),
        }
    }

    /// The same for every index of a range.
    pub(super) fn with_values(&self, formula: Formula, span: Span, range: &IndexRange) -> Option<Formula> {
        if let (IndexRange::Over(range), None) = (range, self.constant(&formula)) {
            let members = (range.start..range.end).map(|i| (i, substitute::formula(&formula, Index::constant(i))));
            // Without a value at one index, the formula contains more than numbers and the index variable.
            let mut values = members.map_while(|(i, member)| Some((i, self.constant(&member)?, member)));
            if let Some((i, _, member)) = values.find(|(_, value, _)| !value.is_finite()) {
                let message = format!("{} (where `{}` is {i})", self.why(&member), text(&range.variable));
                return self.refuse(span, message);
            }
        }
        self.with_value(formula, span)
    }

    /// The value of a formula of numbers, `pi` and constant defines.
    pub(super) fn constant(&self, formula: &Formula) -> Option<f64> {
        Some(match formula {
            Formula::Number(value) => *value,
            Formula::Pi => core::f64::consts::PI,
            Formula::Neg(a) => -self.constant(a)?,
            Formula::Add(a, b) => self.constant(a)? + self.constant(b)?,
            Formula::Sub(a, b) => self.constant(a)? - self.constant(b)?,
            Formula::Mul(a, b) => self.constant(a)? * self.constant(b)?,
            Formula::Div(a, b, _) => {
                // A division by 0 is reported at the divisor.
                let divisor = self.constant(b).filter(|divisor| *divisor != 0.0)?;
                self.constant(a)? / divisor
            }
            Formula::Pow(a, n) => self.constant(a)?.powf(*n),
            Formula::Call(function, a) => value(*function, self.constant(a)?),
            // −0 + 0 is +0.
            Formula::Atan2(y, x) => (self.constant(y)? + 0.0).atan2(self.constant(x)?),
            Formula::Define(member) => (*self.constants.get(member.family)?)?,
            Formula::Index(index) if index.scale == 0 => index.offset as f64,
            Formula::Index(_)
            | Formula::Time
            | Formula::Parameter(_)
            | Formula::Input(_)
            | Formula::Pose(..)
            | Formula::Scalar(_)
            | Formula::PointCoordinate(..)
            | Formula::Distance(..)
            | Formula::Curve(_)
            | Formula::Supplied(..)
            | Formula::Dot(..) => return None,
        })
    }

    /// Why a constant has no value.
    fn why(&self, formula: &Formula) -> String {
        let argument = |a: &Formula| self.constant(a).unwrap_or(f64::NAN);
        let domain = match formula {
            Formula::Call(Function::Sqrt, _) => "0 or a positive number",
            Formula::Call(Function::Ln, _) => "a positive number",
            Formula::Call(Function::Asin | Function::Acos, _) => "a number from -1 to 1",
            _ => "",
        };
        match formula {
            Formula::Call(function, a) if !domain.is_empty() => {
                format!("this has no value: `{function}` takes {domain}, not {}", argument(a))
            }
            Formula::Pow(a, n) if argument(a) == 0.0 => {
                format!("this has no value: 0 to the power of {n} divides by 0")
            }
            Formula::Pow(a, n) if argument(a) < 0.0 && n.fract() != 0.0 => {
                format!(
                    "this has no value: {} is negative, and its power with the exponent {n} is no real number",
                    argument(a)
                )
            }
            _ => "the value of this is too large; the largest number is about 1.8e308".to_owned(),
        }
    }
}
