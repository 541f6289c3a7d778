//! Source: `tests/data/excavator.json`.

use kin_runtime::mechanism;

/// Excavator arm: boom, stick, lever and bucket moved by three hydraulic cylinders, which are distance drivers.
/// The bucket link is massless, a constant distance.
#[mechanism]
#[bodies(boom, stick, lever, bucket)]
#[point(tip = bucket @ (0.5, -0.2))]
#[revolute(O: ground @ (0, 0.2), boom @ (0, 0))]
#[revolute(S: boom @ (3.1, 0.2), stick @ (0, 0))]
#[revolute(L: stick @ (1.25, 0.1), lever @ (-0.21, 0))]
#[revolute(B: stick @ (1.6, 0), bucket @ (-0.4, -0.1))]
#[distance(bucket_link: lever @ (0.19, 0.05), bucket @ (-0.15, 0.1), length = 0.4)]
#[driver(cyl_boom: distance(ground @ (0.45, -0.05), boom @ (1.4, 0.35)) = 1.42 + 0.12 * sin(0.8 * t))]
#[driver(cyl_stick: distance(boom @ (1.5, 0.8), stick @ (-0.6, 0.15)) = 1.94 - 0.15 * t + 0.05 * pow(t, 2))]
#[driver(cyl_bucket: distance(stick @ (0.25, 0.3), lever @ (0.21, 0)) = 1.11 + 0.06 * cos(1.1 * t))]
#[guess(boom.phi = 0.6, stick.phi = -1.3, lever.phi = -0.1, bucket.phi = -0.7)]
pub struct Excavator;
