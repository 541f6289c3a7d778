//! A function of a coordinate in a constraint.

use kin_runtime::function::FromFn;
use kin_runtime::{ScalarFunction, mechanism};

/// The function e^(−x²/4) with its derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bell;

impl ScalarFunction for Bell {
    fn evaluate(&self, x: f64) -> [f64; 3] {
        let f = (-0.25 * x * x).exp();
        [f, -0.5 * x * f, (0.25 * x * x - 0.5) * f]
    }
}

/// A slider whose position is a function of a crank's angle, and a second one whose position is a function of the
/// first.
#[mechanism]
#[function(profile)]
#[function(wave)]
#[bodies(crank, slider)]
#[coordinates(s)]
#[revolute(O: ground @ (0, 0), crank @ (0, profile(offset) - profile(offset)))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[constraint(c: slider.x = scale * profile(crank.phi))]
#[constraint(d: s - 0.1 * wave(profile(crank.phi) + s) = 0)]
#[driver(drive: crank.phi = 0.4 + omega * t)]
#[guess(s = 0.05 * profile(0.4))]
pub struct ProfileSlider {
    /// Position over angle
    pub profile: Box<Bell>,
    /// Position of the second slider over that of the first
    pub wave: FromFn<fn(f64) -> [f64; 3]>,
    /// Amplitude
    pub scale: f64,
    /// Argument of a length
    pub offset: f64,
    /// Speed of the crank
    pub omega: f64,
}

impl Default for ProfileSlider {
    fn default() -> Self {
        let wave: fn(f64) -> [f64; 3] = |x| [x.sin(), x.cos(), -x.sin()];
        Self { profile: Box::new(Bell), wave: FromFn(wave), scale: 0.3, offset: 0.1, omega: 1.1 }
    }
}
