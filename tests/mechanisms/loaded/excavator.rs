//! Source: `tests/data/excavator.json`, with the loads of `tests/data/forces/excavator.json`.

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
#[gravity(0, -9.81)]
#[mass(boom @ (-0.35, -0.79), mass = 1.86, inertia = 0.615)]
#[mass(stick @ (-0.75, -0.6), mass = 1.33, inertia = 1.3)]
#[mass(lever @ (-0.69, 1.2), mass = 1.07, inertia = 0.407)]
#[mass(bucket @ (-0.81, -0.44), mass = 0.855, inertia = 0.792)]
#[force(pull: boom @ (0.93, -0.83), (-4.01, -7.73))]
#[force(thrust: lever @ (-0.82, -0.22), (-13.9, 4.66), frame = lever)]
#[torque(load: stick = -18.9)]
#[spring(spring: ground @ (-1.1, -2), lever @ (-0.42, 0.63), stiffness = 4.59, free_length = 4.79, damping = 0.176)]
#[torsion_spring(torsion: lever, stick, stiffness = 11.4, free_angle = 0.488, damping = 2.84)]
pub struct Excavator;
