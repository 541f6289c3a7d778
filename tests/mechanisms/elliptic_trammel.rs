//! Source: `tests/data/elliptic_trammel.json`.

use kin_runtime::mechanism;

/// Elliptic trammel: a bar with two points kept on a vertical and a horizontal line; the tracer `C` draws an ellipse.
#[mechanism]
#[bodies(bar)]
#[point(C = bar @ (0.5, 0.1))]
#[x(vertical: bar @ (-0.21, 0.03) = 0.02)]
#[y(horizontal: bar @ (0.34, -0.05) = -0.03)]
#[driver(drive: bar.phi = 0.4 + 1.7 * t - 0.3 * cos(2.1 * t))]
pub struct EllipticTrammel;
