//! Evaluation of constant expressions: defaults of parameters and exponents must be numbers at compile time.

use crate::ast::{Expr, ExprKind, Operator};
use crate::function;
use syn::{Error, Result};

/// The value of `expr`; an error at the first part that is not constant.
pub(super) fn constant(expr: &Expr, noun: &str) -> Result<f64> {
    let value = value(expr, noun)?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Error::new(expr.span, format!("{noun} is a finite number; this one is {value}")))
    }
}

fn value(expr: &Expr, noun: &str) -> Result<f64> {
    Ok(match &expr.kind {
        ExprKind::Number(value) => *value,
        ExprKind::Name(name) if name.index.is_none() && name.text() == "pi" => core::f64::consts::PI,
        ExprKind::Neg(a) => -value(a, noun)?,
        ExprKind::Binary(operator, a, b) => {
            let (a, b) = (value(a, noun)?, value(b, noun)?);
            match operator {
                Operator::Add => a + b,
                Operator::Sub => a - b,
                Operator::Mul => a * b,
                Operator::Div => a / b,
            }
        }
        ExprKind::Pow(a, n) => value(a, noun)?.powf(*n),
        ExprKind::Call(function, a) => function::value(*function, value(a, noun)?),
        // −0 + 0 is +0.
        ExprKind::Atan2(y, x) => (value(y, noun)? + 0.0).atan2(value(x, noun)?),
        ExprKind::Name(name) | ExprKind::Component(name, _) => {
            let message = format!("{noun} is a constant made of numbers and `pi`; `{}` has no value here", name.text());
            return Err(Error::new(name.ident.span(), message));
        }
        ExprKind::Apply(used, _) => {
            let name = &used.ident;
            return Err(Error::new(name.span(), format!("{noun} is a constant; there is no function `{name}`")));
        }
        ExprKind::Distance(..) | ExprKind::Dot(..) | ExprKind::Hole => {
            return Err(Error::new(expr.span, format!("{noun} is a constant made of numbers and `pi`")));
        }
    })
}
