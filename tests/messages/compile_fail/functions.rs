//! Unknown functions, and functions with wrong arguments.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank)]
#[coordinates(u, v)]
#[revolute(A: crank @ (0, 0), ground @ (0, 0))]
#[constraint(two: sin(u, v) = 0)]
#[constraint(none: cos() = 0)]
#[constraint(one: atan2(u) = 0)]
#[constraint(bare: sqrt = 0)]
#[constraint(no_exponent: pow(u) = 0)]
#[constraint(variable_exponent: pow(u, v) = 0)]
#[constraint(parameter_exponent: pow(u, n) = 0)]
#[constraint(infinite_exponent: pow(u, 1/0) = 0)]
#[constraint(fraction: u.powi(0.5) = 0)]
#[constraint(powi_call: powi(u, 2) = 0)]
#[constraint(pow_method: u.pow(2) = 0)]
#[constraint(squared: u.powi() = 0)]
#[constraint(argument: u.sin(v) = 0)]
#[constraint(no_brackets: u.sin = 0)]
#[constraint(no_brackets_of_body: crank.phi.cos = 0)]
#[constraint(called: crank.phi() = 0)]
#[constraint(derivative: crank.phi_dot = 0)]
#[constraint(hyperbolic: cosh(u) = 0)]
#[constraint(logarithm: log(u) = 0)]
#[constraint(arc: arctan(u) + arccos(v) + asine(u) = 0)]
#[constraint(maximum: max(u, sinus(v)) = 0)]
#[constraint(unknown_method: u.signum() + u.sinus() + u.square() = 0)]
#[constraint(rate: dot(u) = 0)]
#[constraint(one_point: distance(crank @ (0, 0)) = 1)]
#[constraint(three_points: distance(crank @ (0, 0), ground @ (0, 0), crank @ (1, 0)) = 1)]
#[constraint(no_points: distance() = 1)]
#[constraint(numbers: distance(u, v) = 1)]
#[constraint(bodies: distance(crank, ground) = 1)]
#[constraint(missing_comma: distance(crank @ (0, 0) ground @ (0, 0)) = 1)]
#[constraint(equation: sin(u = v) = 1)]
#[constraint(degrees: rad(90) = deg(u))]
struct Functions {
    #[param(2)]
    n: f64,
}

/// Function arguments without parentheses.
#[mechanism]
#[bodies(crank)]
#[constraint(sine: crank.phi = sin t)]
#[constraint(root: crank.x = 2 * sqrt 2 + atan2 t)]
#[constraint(inside: crank.y = pow(cos t, 2))]
#[constraint(product: crank.y = 2 t)]
struct NoBrackets;

fn main() {}
