//! Source: `tests/data/chain10.json`, with the loads of `tests/data/forces/chain10.json`.

use kin_runtime::mechanism;

/// An open chain of ten links: the first angle driven, the others relative to the link before.
/// Frames alternate between the joint and the middle of the link.
#[mechanism]
#[bodies(link1, link2, link3, link4, link5, link6, link7, link8, link9, link10)]
#[point(E = link10 @ (0.18, 0))]
#[revolute(J1: ground @ (0.1, -0.2), link1 @ (-0.31/2, 0.01))]
#[revolute(J2: link1 @ (0.31/2, 0.01), link2 @ (0, 0))]
#[revolute(J3: link2 @ (0.29, 0), link3 @ (-0.27/2, 0.01))]
#[revolute(J4: link3 @ (0.27/2, 0.01), link4 @ (0, 0))]
#[revolute(J5: link4 @ (0.33, 0), link5 @ (-0.24/2, 0.01))]
#[revolute(J6: link5 @ (0.24/2, 0.01), link6 @ (0, 0))]
#[revolute(J7: link6 @ (0.22, 0), link7 @ (-0.3/2, 0.01))]
#[revolute(J8: link7 @ (0.3/2, 0.01), link8 @ (0, 0))]
#[revolute(J9: link8 @ (0.26, 0), link9 @ (-0.21/2, 0.01))]
#[revolute(J10: link9 @ (0.21/2, 0.01), link10 @ (0, 0))]
#[driver(d1: link1.phi = 0.3 + 0.7 * t)]
#[driver(d2: link2.phi - link1.phi = 0.2 * sin(1.1 * t))]
#[relative_angle(d3: link2, link3 = -0.4 + 0.3 * pow(t, 2))]
#[relative_angle(d4: link3, link4 = 0.25)]
#[relative_angle(d5: link4, link5 = 0.5 * cos(2 * t))]
#[driver(d6: link6.phi - link5.phi = 0.1 * t + 0.2 * sin(3 * t))]
#[relative_angle(d7: link6, link7 = -0.6 * t)]
#[driver(d8: link8.phi - link7.phi = 0.3 * sin(t) * cos(2 * t))]
#[relative_angle(d9: link8, link9 = 0.2 + 0.05 * pow(t, 3))]
#[driver(d10: link10.phi - link9.phi = -0.35 * sin(1.7 * t) - 0.1 * t)]
#[guess(
    link2.phi = 0.3, link3.phi = -0.1, link4.phi = 0.1, link5.phi = 0.7, link6.phi = 0.7,
    link7.phi = 0.7, link8.phi = 0.7, link9.phi = 0.8, link10.phi = 0.8
)]
#[gravity(0, -9.81)]
#[mass(link1 @ (-0.12, 0.017), mass = 1.8, inertia = 0.0118)]
#[mass(link2 @ (0.072, 0.036), mass = 0.407, inertia = 0.00425)]
#[mass(link3 @ (0.099, 0.054), mass = 2, inertia = 0.0111)]
#[mass(link4 @ (0.073, 0.046), mass = 1.12, inertia = 0.0133)]
#[mass(link5 @ (-0.058, 0.1), mass = 1.49, inertia = 0.015)]
#[mass(link6 @ (-0.097, -0.071), mass = 1.17, inertia = 0.0134)]
#[mass(link7 @ (0.07, -0.067), mass = 0.823, inertia = 0.0061)]
#[mass(link8 @ (-0.072, -0.11), mass = 0.413, inertia = 0.00294)]
#[mass(link9 @ (0.061, -0.029), mass = 2.2, inertia = 0.0144)]
#[mass(link10 @ (-0.093, 0.068), mass = 0.926, inertia = 0.0121)]
#[force(pull: link8 @ (0.098, -0.019), (-6.64, 14.9))]
#[force(thrust: link1 @ (-0.041, 0.067), (9.63, -7.06), frame = link1)]
#[torque(load: link10 = -0.985)]
#[spring(spring: link6 @ (-0.099, 0.079), link8 @ (0.11, 0.12), stiffness = 76.6, free_length = 0.636, damping = 10.6)]
#[torsion_spring(torsion: link3, link1, stiffness = 2.29, free_angle = 0.384, damping = 0.212)]
pub struct Chain10;
