//! Rows of velocity level: linear in every `dot`, and `dot` nowhere else.

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

fn main() {}
