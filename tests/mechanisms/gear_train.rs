//! A train of gears in one line.

use kin_runtime::mechanism;

/// Five gears in one line, each in mesh with the next.
#[mechanism]
#[bodies(wheel[5])]
#[revolute(pin[i in 0..5]: ground @ (0.1 * i, 0), wheel[i] @ (0, 0))]
#[gear(mesh[i in 0..4]: wheel[i], wheel[i + 1], radii = (z[i], z[i + 1]))]
#[driver(drive: wheel[0].phi = 0.4 + 3 * t)]
pub struct GearTrain {
    /// Teeth
    #[param([20, 31, 17, 44, 25])]
    pub z: [f64; 5],
}
