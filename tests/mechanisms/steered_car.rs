//! A car described by its two axles.

use kin_runtime::mechanism;

/// Rear wheels along the car, front wheels steered by a function of time, rear axle driven at a speed.
#[mechanism]
#[bodies(car)]
#[point(front = car @ (wheelbase, 0))]
#[knife_edge(rear_wheels: car @ (0, 0))]
#[knife_edge(front_wheels: front, angle = steer + swing * sin(2 * t))]
#[speed(engine: car @ (0, 0), value = v)]
#[guess(car.x = 0.5, car.phi = 0.3)]
pub struct SteeredCar {
    /// Distance of the axles
    #[param(2.5)]
    pub wheelbase: f64,
    /// Mean steering angle
    #[param(0.2)]
    pub steer: f64,
    /// Amplitude of the steering angle
    #[param(0.3)]
    pub swing: f64,
    /// Speed of the rear axle
    #[param(1.5)]
    pub v: f64,
}
