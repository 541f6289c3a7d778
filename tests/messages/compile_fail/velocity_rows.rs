//! Rows of velocity level must be linear in every `dot`, and `dot` is not allowed elsewhere.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(sleigh)]
#[coordinates(s, u)]
#[point(blade = sleigh @ (0.3, 0))]
#[nonholonomic(product: dot(s) * sleigh.phi.dot() = 1)]
#[nonholonomic(square: pow(dot(s), 2) = 1)]
#[nonholonomic(quotient: dot(s) / dot(u) = 2)]
#[nonholonomic(inverse: 1 / (2 * dot(u)) = 2)]
#[nonholonomic(sine: sin(dot(s)) = 0)]
#[nonholonomic(length: s = (dot(blade.x).powi(2) + dot(blade.y).powi(2)).sqrt())]
#[nonholonomic(angle: atan2(dot(blade.y), dot(blade.x)) = t)]
#[nonholonomic(position: s = t)]
#[nonholonomic(unmoved: dot(t * t) = s)]
#[nonholonomic(twice: dot(dot(s)) = 0)]
#[nonholonomic(fine: 2 * sin(s) * (dot(s) - 3 * dot(sleigh.phi)) / sleigh.x + t = -dot(u))]
#[driver(drive: dot(u) = 1)]
#[speed(engine: blade, angle = dot(s), value = dot(u))]
#[knife_edge(edge: blade, value = 0)]
#[knife_edge(held: ground @ (0, 0))]
#[define(rate = dot(s))]
pub struct Sleigh;

/// Notations for rates in other languages.
#[mechanism]
#[coordinates(u, v)]
#[nonholonomic(a: der(u) = 1)]
#[nonholonomic(b: ddt(u) + rate(v) = derivative(v) + d(u))]
#[nonholonomic(c: dt(u) = sgn(v))]
#[nonholonomic(e: u.der() = 1)]
#[constraint(f: der(u) = 1)]
struct Rates;

/// A constant has no rate; t and components that depend on it have one.
#[mechanism]
#[bodies(sleigh)]
#[body(table, x = 0, y = 0, phi = r)]
#[body(carrier, x = 0, y = sin(t), phi = 0)]
#[define(twice = 2 * r)]
#[nonholonomic(a: dot(sleigh.x) = dot(r))]
#[nonholonomic(b: dot(sleigh.y) = dot(twice) + dot(table.phi))]
#[nonholonomic(c: dot(sleigh.phi) = dot(carrier.y) + dot(t))]
struct Still {
    #[param(1)]
    r: f64,
}

fn main() {}
