//! Source: constructed for the laws; there are no published numbers.

use kin_runtime::mechanism;

/// A carried chain of three bodies with a plate welded to its end, a floating body held in one coordinate, and free
/// equations with every function of the language: what the reference cases do not use.
#[mechanism]
#[body(upper, origin = ground @ (0.1, 0.2))]
#[body(middle, origin = upper @ (l, 0.05))]
#[body(lower, origin = middle @ (l, -0.02))]
#[bodies(plate)]
#[body(float, y = 0.3 + 0.1 * sin(t))]
#[coordinates(a, b, c)]
#[point(tip = plate @ (0.2, l/2))]
#[define(reach = distance(ground @ (0, 0), tip))]
#[define(height = tip.y - float.y)]
#[fixed(weld: lower @ (l, 0), plate @ (-0.1, 0.03), angle = 0.4)]
#[angle(first: upper = 0.3 + 0.5 * t)]
#[relative_angle(second: upper, middle = 0.2 * cos(2 * t))]
#[driver(third: lower.phi - middle.phi = -0.1 + exp(-t) / 5)]
#[x(track: float @ (0.02, -0.01) = 0.7 + 0.1 * t)]
#[relative_angle(hang: plate, float = tan(0.3 * sin(t)))]
#[constraint(free_a: a + 0.1 * a.powi(3) = reach + atan2(tip.y, 2 + tip.x))]
#[constraint(free_b: b.exp() + asin(b / 4) = 1.5 + sqrt(1 + a * a) + ln(2 + cos(a)))]
#[constraint(free_c: c + atan(c) + 0.1 * acos(c / 9) = pow(1 + b * b, 1.5) + abs(height) / pow(1 + t * t, 0.5))]
pub struct WeldedPendulums {
    /// Length of a link; its equations mix lengths and angles, and so it has no unit
    #[param(0.4)]
    pub l: f64,
}
