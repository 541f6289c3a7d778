//! Rolling without slipping, at velocity level.

use kin_runtime::mechanism;

/// A wheel rolls on a rail that turns; its lever pushes a slider, and a counter runs with the sine of its angle.
#[mechanism]
#[body(rail, x = 0, y = 0)]
#[bodies(wheel)]
#[coordinates(counter)]
#[point_on_line(contact: rail @ (0, 0), wheel @ (0, 0), axis = (1, 0), offset = radius)]
#[nonholonomic(roll: dot(wheel.x * cos(rail.phi) + wheel.y * sin(rail.phi)) = -radius * (dot(wheel.phi) - rail.phi.dot()))]
#[nonholonomic(count: dot(counter) / 2 - cos(wheel.phi) * dot(wheel.phi) = 0.1 * t)]
#[driver(tilt: rail.phi = 0.4 * sin(1.3 * t))]
#[driver(roll_on: wheel.phi = 0.2 - t * t)]
#[guess(wheel.x = 0.3, counter = 0.7)]
pub struct WheelByRates {
    /// Radius of the wheel
    #[param(0.25)]
    pub radius: f64,
}
