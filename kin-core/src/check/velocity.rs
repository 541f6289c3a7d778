//! Rules for rows of velocity level.
//!
//! The degree of a formula in q̇ is determined recursively: 0 without a rate, 1 for `dot(…)` of something that depends
//! on coordinates; a higher degree is an error.

use super::mention::{changes, moves};
use crate::error::{ModelError, Origin};
use crate::mechanism::{Formula, Mechanism, OperandType};

/// Rule: a row of velocity level is linear in the rates of coordinates and contains at least one.
pub(super) fn velocity_rows_are_linear(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for joint in &mechanism.joints {
        let sides: Vec<&Formula> = (joint.operands.iter())
            .filter(|(slot, _)| slot.takes == OperandType::SideOfRates)
            .flat_map(|(_, operand)| operand.formulas())
            .collect();
        if sides.is_empty() {
            continue;
        }
        let i = joint.range.map_or(0, |range| range.start);
        let before = errors.len();
        let mut walk = Walk { mechanism, i, errors, dots: 0 };
        let rates: Vec<Option<Origin>> = sides.into_iter().map(|side| walk.rate(side)).collect();
        if walk.dots == 0 {
            let message = format!(
                "nonholonomic `{}` contains no `dot(…)`, so that it does not constrain velocities; an equation of \
                 positions is a `constraint`",
                joint.name
            );
            errors.push(ModelError::new(joint.keyword, message));
        } else if rates.iter().all(Option::is_none) && errors.len() == before {
            let message = format!(
                "no `dot(…)` in nonholonomic `{}` contains a coordinate, so that no motion can satisfy it",
                joint.name
            );
            errors.push(ModelError::new(joint.keyword, message));
        }
    }
}

struct Walk<'a> {
    mechanism: &'a Mechanism,
    /// The value of the index variable.
    i: i64,
    errors: &'a mut Vec<ModelError>,
    /// The number of `dot` calls found.
    dots: usize,
}

impl Walk<'_> {
    fn error(&mut self, origin: Origin, fault: &str) -> Option<Origin> {
        let right = "a row of velocity level is linear in every `dot(…)`: each stands by itself or times a factor \
                     without `dot`";
        self.errors.push(ModelError::new(origin, format!("{fault}; {right}")));
        None
    }

    /// The origin of the last `dot` that contributes to the degree 1; `None` if the formula is free of q̇ or has been
    /// reported as an error.
    fn rate(&mut self, formula: &Formula) -> Option<Origin> {
        // A long sum or product is deeply nested on the left, so the left operands are visited in a loop.
        let (mut operations, mut left) = (Vec::new(), formula);
        while let Formula::Add(a, _) | Formula::Sub(a, _) | Formula::Mul(a, _) | Formula::Div(a, ..) = left {
            operations.push(left);
            left = a;
        }
        let mut rate = self.leaf(left);
        for operation in operations.into_iter().rev() {
            rate = match operation {
                Formula::Mul(_, b) => match (rate, self.rate(b)) {
                    (Some(_), Some(second)) => self.error(second, "here a `dot(…)` is multiplied by another"),
                    (first, second) => first.or(second),
                },
                Formula::Div(_, b, _) => match self.rate(b) {
                    Some(divisor) => self.error(divisor, "here something is divided by a `dot(…)`"),
                    None => rate,
                },
                Formula::Add(_, b) | Formula::Sub(_, b) => self.rate(b).or(rate),
                _ => rate,
            };
        }
        rate
    }

    fn leaf(&mut self, formula: &Formula) -> Option<Origin> {
        match formula {
            Formula::Dot(a, origin) => {
                self.dots += 1;
                if !changes(self.mechanism, &[a], self.i) {
                    let message = "what stands in this `dot(…)` does not change; its rate is 0";
                    self.errors.push(ModelError::new(*origin, message));
                }
                moves(self.mechanism, a, self.i).then_some(*origin)
            }
            Formula::Neg(a) => self.rate(a),
            Formula::Pow(a, n) => match self.rate(a) {
                Some(origin) if *n != 1.0 => self.error(origin, &format!("here a `dot(…)` is raised to the power {n}")),
                rate => rate,
            },
            Formula::Call(function, a) => {
                let rate = self.rate(a)?;
                self.error(rate, &format!("here a `dot(…)` stands inside `{}`", function.name()))
            }
            Formula::Supplied(_, a) => {
                let rate = self.rate(a)?;
                self.error(rate, "here a `dot(…)` is the argument of a function")
            }
            Formula::Atan2(y, x) => {
                let rate = self.rate(y).or(self.rate(x))?;
                self.error(rate, "here a `dot(…)` stands inside `atan2`")
            }
            _ => None,
        }
    }
}
