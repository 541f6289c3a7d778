//! Functions of the language, as calls and as methods.

use super::fold::constant;
use super::reject::{RADIANS, is_angle_word};
use crate::ast::{Expr, ExprKind, NameUse, text};
use crate::function::{function_of_places, other_function};
use crate::suggest::{did_you_mean, is_rate, nearest};
use kin_core::check::is_reserved;
use kin_core::mechanism::Function;
use proc_macro2::Span;
use syn::{Error, Ident, Result};

/// The function call `name(…)` with these arguments.
pub(super) fn function(name: Ident, arguments: Vec<Expr>, span: Span) -> Result<Expr> {
    match text(&name).as_str() {
        "dot" => {
            let [a] = take(&name, arguments, "dot(a)")?;
            dot(name, a, span)
        }
        "pow" => {
            let [base, exponent] = take(&name, arguments, "pow(a, n)")?;
            power(base, &exponent, "pow", span)
        }
        "atan2" => {
            let [y, x] = take(&name, arguments, "atan2(y, x)")?;
            atan2(y, x, span)
        }
        known => {
            let Some(function) = Function::from_name(known) else {
                return supplied(NameUse { ident: name, index: None }, arguments, span);
            };
            let [a] = take(&name, arguments, &format!("{known}(a)"))?;
            call(function, a, span)
        }
    }
}

/// A call of a supplied function with these arguments.
pub(super) fn supplied(name: NameUse, arguments: Vec<Expr>, span: Span) -> Result<Expr> {
    let heights: Vec<usize> = arguments.iter().map(|a| a.height).collect();
    Expr::over(ExprKind::Apply(Box::new(name), arguments), span, &heights)
}

/// An error if `name` is known not to be a function, whatever its arguments.
pub(super) fn is_function(name: &Ident) -> Result<()> {
    match text(name).as_str() {
        word if is_angle_word(word) => Err(Error::new(name.span(), RADIANS)),
        "powi" | "powf" => {
            let message = format!("`{name}` is a method, `a.{name}(n)`; as a function it is called `pow(a, n)`");
            Err(Error::new(name.span(), message))
        }
        _ => Ok(()),
    }
}

/// The error for a function of points that is meant as `distance`, if `name` is one.
pub(super) fn of_points(name: &Ident) -> Option<Error> {
    let word = text(name);
    let message = function_of_places(&word).or_else(|| {
        let nearest_name = nearest(&word, ["distance"])?;
        Some(format!("there is no function `{word}`; did you mean `{nearest_name}`?"))
    });
    message.map(|message| Error::new(name.span(), message))
}

/// An error if `name` is a function whose argument follows without parentheses.
pub(super) fn has_brackets(name: &Ident) -> Result<()> {
    let word = text(name);
    let is_function = is_reserved(&word) && !matches!(word.as_str(), "t" | "pi" | "ground");
    if !is_function {
        return Ok(());
    }
    Err(Error::new(name.span(), format!("`{word}` is a function; its argument stands in parentheses, `{word}(…)`")))
}

/// The method call `value.name(…)` with these arguments.
pub(super) fn method(value: Expr, name: Ident, arguments: Vec<Expr>, span: Span) -> Result<Expr> {
    match text(&name).as_str() {
        "atan2" => {
            let [x] = take(&name, arguments, "y.atan2(x)")?;
            atan2(value, x, span)
        }
        "powi" => {
            let [n] = take(&name, arguments, "a.powi(n)")?;
            power(value, &n, "powi", span)
        }
        "powf" => {
            let [n] = take(&name, arguments, "a.powf(n)")?;
            power(value, &n, "powf", span)
        }
        "dot" => {
            let [] = take(&name, arguments, "a.dot()")?;
            dot(name, value, span)
        }
        "pow" => Err(Error::new(name.span(), "powers are written `pow(a, n)`, `a.powi(n)` or `a.powf(n)`")),
        known => {
            let Some(function) = Function::from_name(known) else {
                return Err(unknown_method(&name, known));
            };
            let [] = take(&name, arguments, &format!("a.{known}()"))?;
            call(function, value, span)
        }
    }
}

fn unknown_method(name: &Ident, known: &str) -> Error {
    if matches!(known, "x" | "y" | "phi") {
        return Error::new(name.span(), format!("`{known}` is a coordinate, written without brackets: `.{known}`"));
    }
    if is_angle_word(known) {
        return Error::new(name.span(), RADIANS);
    }
    if let Some(message) = other_function(known) {
        return Error::new(name.span(), message);
    }
    const OTHERS: [&str; 3] = ["atan2", "powi", "powf"];
    let methods = Function::ALL.iter().map(|f| f.name()).chain(OTHERS);
    let suggestion = match known {
        rate if is_rate(rate) => {
            "; a rate is written `dot(…)`, in `nonholonomic`, `force` and `torque` only".to_owned()
        }
        _ => did_you_mean(known, methods),
    };
    let message = format!(
        "no function `{known}`; there are sin, cos, tan, asin, acos, atan, atan2, sqrt, exp, ln, abs, powi and powf{suggestion}"
    );
    Error::new(name.span(), message)
}

fn call(function: Function, a: Expr, span: Span) -> Result<Expr> {
    let height = a.height;
    Expr::over(ExprKind::Call(function, Box::new(a)), span, &[height])
}

fn dot(name: Ident, a: Expr, span: Span) -> Result<Expr> {
    let height = a.height;
    Expr::over(ExprKind::Dot(name, Box::new(a)), span, &[height])
}

fn atan2(y: Expr, x: Expr, span: Span) -> Result<Expr> {
    let heights = [y.height, x.height];
    Expr::over(ExprKind::Atan2(Box::new(y), Box::new(x)), span, &heights)
}

fn power(base: Expr, exponent: &Expr, name: &str, span: Span) -> Result<Expr> {
    let n = constant(exponent, "an exponent").map_err(|error| {
        let right = "where an exponent varies, write `exp(n*ln(a))`";
        if is_variable(exponent) { Error::new(error.span(), format!("{error}; {right}")) } else { error }
    })?;
    if name == "powi" && n.fract() != 0.0 {
        return Err(Error::new(exponent.span, "the exponent of `powi` is an integer; `powf` takes any number"));
    }
    let height = base.height;
    Expr::over(ExprKind::Pow(Box::new(base), n), span, &[height])
}

/// True for an expression that contains more than numbers.
fn is_variable(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Hole | ExprKind::Apply(..) => false,
        ExprKind::Name(used) => used.text() != "pi",
        ExprKind::Component(..) | ExprKind::Distance(..) | ExprKind::Dot(..) => true,
        ExprKind::Neg(a) | ExprKind::Pow(a, _) | ExprKind::Call(_, a) => is_variable(a),
        ExprKind::Binary(_, a, b) | ExprKind::Atan2(a, b) => is_variable(a) || is_variable(b),
    }
}

/// Exactly `N` arguments, or an error at the function's name that shows the right `form`.
fn take<const N: usize>(name: &Ident, arguments: Vec<Expr>, form: &str) -> Result<[Expr; N]> {
    let given = arguments.len();
    arguments.try_into().map_err(|_| {
        let values = match given {
            0 => "is nothing".to_owned(),
            1 => "is 1 value".to_owned(),
            n => format!("are {n} values"),
        };
        Error::new(name.span(), format!("`{}` is written `{form}`; here {values} in its brackets", text(name)))
    })
}
