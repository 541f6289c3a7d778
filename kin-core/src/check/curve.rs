//! Rules for curves.

use crate::error::ModelError;
use crate::mechanism::{Curve, CurveVariable, Formula, Mechanism, Member, nodes};

/// The curves of all joints.
fn curves(mechanism: &Mechanism) -> impl Iterator<Item = &Curve> {
    mechanism.joints.iter().filter_map(|joint| joint.operands.curve())
}

/// Rule: a literal polar radius is positive, an implicit curve contains X or Y, a parametric curve its parameter.
pub(super) fn curves_depend_on_their_variables(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for curve in curves(mechanism) {
        match curve {
            Curve::Polar { radius, origin } => match radius.literal() {
                Some(value) if value <= 0.0 => {
                    let message =
                        format!("the radius of a polar curve must be positive; this one is {value} everywhere");
                    errors.push(ModelError::new(*origin, message));
                }
                _ => {}
            },
            Curve::Implicit { value, origin } => {
                let is_variable = |node: &&Formula| matches!(node, Formula::Curve(CurveVariable::X | CurveVariable::Y));
                if !nodes(value).iter().any(is_variable) {
                    let message = "this holds neither `X` nor `Y`, so that it describes no curve; \
                                   a circle is `implicit(X, Y) = X*X + Y*Y - r*r`";
                    errors.push(ModelError::new(*origin, message));
                }
            }
            Curve::Parametric { parameter, x, y, origin, .. } => {
                if !holds(x, parameter) && !holds(y, parameter) {
                    let name = name(mechanism, parameter);
                    let message = format!(
                        "neither component holds `{name}`, so that this is a point and no curve; \
                         points are joined with `revolute`"
                    );
                    errors.push(ModelError::new(*origin, message));
                }
            }
        }
    }
}

/// Rule: a curve with a roller has a third derivative. The row contains the tangent c′, so γ contains c‴, but a
/// supplied function provides only two derivatives.
pub(super) fn roller_curves_have_derivatives(mechanism: &Mechanism, errors: &mut Vec<ModelError>) {
    for curve in curves(mechanism) {
        let Curve::Parametric { parameter, x, y, roller: Some(_), .. } = curve else { continue };
        for node in [x, y].into_iter().flat_map(nodes) {
            if let Formula::Supplied(function, argument) = node
                && holds(argument, parameter)
            {
                let (u, name) = (name(mechanism, parameter), function_name(mechanism, function));
                let message = format!(
                    "`{name}({u})` under a `roller` needs the third derivative of `{name}`, and a supplied function \
                     has two; write this curve with formulas, or give the path of the roller's centre without `roller`"
                );
                errors.push(ModelError::new(function.origin, message));
            }
        }
    }
}

/// True if the formula contains the parameter. Defines inside a curve contain no coordinates.
fn holds(formula: &Formula, parameter: &Member) -> bool {
    nodes(formula).into_iter().any(|node| matches!(node, Formula::Scalar(member) if member.family == parameter.family))
}

fn name<'m>(mechanism: &'m Mechanism, member: &Member) -> &'m str {
    mechanism.scalars.get(member.family).map_or("u", |scalar| &scalar.name)
}

fn function_name<'m>(mechanism: &'m Mechanism, member: &Member) -> &'m str {
    mechanism.functions.get(member.family).map_or("f", |function| &function.name)
}
