//! The functions of the language at numbers, and messages for functions of other languages.

use kin_core::mechanism::Function;

/// The value of `function` at `a`; NaN or infinite where it has none.
pub(crate) fn value(function: Function, a: f64) -> f64 {
    match function {
        Function::Sin => a.sin(),
        Function::Cos => a.cos(),
        Function::Tan => a.tan(),
        Function::Asin => a.asin(),
        Function::Acos => a.acos(),
        Function::Atan => a.atan(),
        Function::Sqrt => a.sqrt(),
        Function::Exp => a.exp(),
        Function::Ln => a.ln(),
        Function::Abs => a.abs(),
    }
}

/// The message for a function of other languages, which says how to write it.
pub(crate) fn other_function(name: &str) -> Option<String> {
    let jumps = "it jumps, and motions need formulas that have rates; angles need no remainder, and a function of your \
                 own is a field declared with `#[function(f)]`";
    let right = match name {
        "max" => "the larger of two numbers is `(a + b + abs(a - b))/2`",
        "min" => "the smaller of two numbers is `(a + b - abs(a - b))/2`",
        "sign" | "signum" | "sgn" => "the sign of a number other than 0 is `a/abs(a)`",
        "mod" | "fmod" | "rem" | "rem_euclid" | "floor" | "ceil" | "round" | "trunc" | "fract" | "step"
        | "heaviside" => jumps,
        "hypot" => "it is written `sqrt(a*a + b*b)`",
        "sinh" => "it is written `(exp(a) - exp(-a))/2`",
        "cosh" => "it is written `(exp(a) + exp(-a))/2`",
        "tanh" => "it is written `1 - 2/(exp(2*a) + 1)`",
        "cot" => "it is written `1/tan(a)`",
        "sec" => "it is written `1/cos(a)`",
        "csc" | "cosec" => "it is written `1/sin(a)`",
        "asinh" => "it is written `ln(a + sqrt(a*a + 1))`",
        "acosh" => "it is written `ln(a + sqrt(a*a - 1))`",
        "atanh" => "it is written `ln((1 + a)/(1 - a))/2`",
        "exp2" => "it is written `exp(a*ln(2))`",
        "expm1" | "exp_m1" => "it is written `exp(a) - 1`",
        "ln1p" | "ln_1p" | "log1p" => "it is written `ln(1 + a)`",
        "cbrt" => "for a positive number it is written `pow(a, 1/3)`",
        "log10" => "it is written `ln(a)/ln(10)`",
        "log2" => "it is written `ln(a)/ln(2)`",
        "sq" | "square" => "it is written `pow(a, 2)`",
        _ => return None,
    };
    Some(format!("there is no function `{name}`; {right}"))
}

/// The message for a function of other languages whose arguments are bodies or points.
pub(crate) fn function_of_places(name: &str) -> Option<String> {
    let right = match name {
        "angle" => "the angle from body `a` to body `b` is `b.phi - a.phi`",
        "norm" | "length" | "dist" | "len" => "the distance of two points is `distance(P, Q)`",
        _ => return None,
    };
    Some(format!("there is no function `{name}`; {right}"))
}
