//! The excavator of `tests/data/excavator.json` with measured cylinder lengths as inputs instead of prescribed ones.

use kin_runtime::{Signal, mechanism};

/// Excavator arm whose three cylinder lengths are known only at run time: two drivers and one `distance`.
#[mechanism]
#[bodies(boom, stick, lever, bucket)]
#[input(
    /// Length of the boom cylinder.
    boom_length,
    stick_length,
    bucket_length
)]
#[point(tip = bucket @ (0.5, -0.2))]
#[revolute(O: ground @ (0, 0.2), boom @ (0, 0))]
#[revolute(S: boom @ (3.1, 0.2), stick @ (0, 0))]
#[revolute(L: stick @ (1.25, 0.1), lever @ (-0.21, 0))]
#[revolute(B: stick @ (1.6, 0), bucket @ (-0.4, -0.1))]
#[distance(bucket_link: lever @ (0.19, 0.05), bucket @ (-0.15, 0.1), length = 0.4)]
#[driver(cyl_boom: distance(ground @ (0.45, -0.05), boom @ (1.4, 0.35)) = boom_length)]
#[distance(cyl_stick: boom @ (1.5, 0.8), stick @ (-0.6, 0.15), length = stick_length)]
#[driver(cyl_bucket: distance(stick @ (0.25, 0.3), lever @ (0.21, 0)) = bucket_length)]
#[guess(boom.phi = 0.6, stick.phi = -1.3, lever.phi = -0.1, bucket.phi = -0.7)]
pub struct MeasuredExcavator;

/// The lengths of the excavator with prescribed cylinders at time t.
pub(super) fn signals(t: f64) -> [Signal; 3] {
    let (a, b) = ((0.8 * t).sin_cos(), (1.1 * t).sin_cos());
    [
        Signal::new(1.42 + 0.12 * a.0, 0.096 * a.1, -0.0768 * a.0),
        Signal::new(1.94 - 0.15 * t + 0.05 * t * t, -0.15 + 0.1 * t, 0.1),
        Signal::new(1.11 + 0.06 * b.1, -0.066 * b.0, -0.0726 * b.1),
    ]
}
