//! A mechanism with all arguments of `dot` and all operands of rows of velocity level.

use kin_runtime::function::{MotionLaw, Sequence};
use kin_runtime::{Signal, mechanism};

/// A skate trails behind a moving table; coordinates (`meter`) integrate rates that are given by formulas.
#[mechanism]
#[body(table, x = 0.5 * cos(t) + sway, y = 0.1 * t, phi = 0.3 * sway)]
#[body(arm, origin = table @ (1, 0.2))]
#[bodies(skate)]
#[coordinates(meter[3])]
#[function(profile)]
#[input(sway, pace)]
#[define(gap = distance(arm @ (-0.8, 0.1), ground @ (3, 3)))]
#[point(heel = skate @ (-0.4, 0.1))]
#[knife_edge(wheel: arm @ (-0.8, 0.1), angle = 0.2 + 0.1 * pace)]
#[knife_edge(blade: heel, angle = -0.1)]
#[speed(push: skate @ (0.3, 0), angle = 0.2 * sin(t), value = 0.7 + 0.1 * pace * pace)]
#[driver(turn: skate.phi = 0.4 + 0.2 * t + 0.1 * pace)]
#[nonholonomic(length: dot(meter[0]) = gap * dot(gap) + 0.3 * dot(sway) - dot(exp(0.2 * t)))]
#[nonholonomic(follower: (1 + heel.x * heel.x) * dot(meter[1]) - 2 * profile(heel.y) * dot(profile(meter[1])) = dot(heel.x) / (2 + sin(t)))]
#[nonholonomic(angle: -dot(meter[2]) = dot(atan2(heel.y - 4, arm.x + 5)) + pow(arm.phi, 2) * dot(pow(table.x, 3) * arm.y))]
#[guess(arm.phi = 0.3, skate.x = 0.6, meter[1] = 0.2)]
pub struct RateTable {
    /// Supplied
    pub profile: Sequence,
}

impl Default for RateTable {
    fn default() -> Self {
        let profile = Sequence::starting_at(-3.0, 0.0).rise(MotionLaw::Polynomial4567, 0.5, 8.0).build();
        Self { profile: profile.expect("a sound sequence") }
    }
}

/// Two independent signals.
pub(super) fn signals(t: f64) -> [Signal; 2] {
    let (sway, pace) = ((1.7 * t + 0.3).sin_cos(), (0.9 * t).sin_cos());
    [
        Signal::new(0.2 * sway.0, 0.34 * sway.1, -0.578 * sway.0),
        Signal::new(0.5 * pace.0, 0.45 * pace.1, -0.405 * pace.0),
    ]
}
