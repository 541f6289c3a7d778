//! A closed loop whose crank is driven by its angular velocity.

use kin_runtime::mechanism;

/// Slider-crank; the motor is a row of velocity level, so that the loop is closed by projection all the way.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (0.3, 0), rod @ (0, 0))]
#[revolute(C: rod @ (0.8, 0.05), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0.1), slider @ (0, 0), axis = (1, 0))]
#[nonholonomic(motor: dot(crank.phi) = omega * (1 + 0.5 * sin(3 * t)))]
#[guess(crank.phi = 0.4, rod.phi = -0.1, slider.x = 1)]
pub struct RateDrivenSliderCrank {
    /// Mean angular velocity of the crank
    #[param(2.0)]
    pub omega: f64,
}
