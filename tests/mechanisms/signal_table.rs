//! A mechanism with inputs at every place of the language where they are allowed.

use kin_runtime::{Signal, mechanism};

/// A shaken table with an arm and a slider on it, and a free equation.
#[mechanism]
#[body(table, x = 0.3 * shake, y = 0.1 + tilt * tilt, phi = 0.2 * sin(tilt))]
#[bodies(arm, slider, gauge, block)]
#[body(tail, origin = arm @ (0.5, 0.1))]
#[coordinates(c)]
#[input(shake, tilt, level[3])]
#[define(swell = level[0] * level[1])]
#[revolute(pin: table @ (0.2, 0.1), arm @ (-0.3, 0))]
#[relative_angle(turn: table, arm = 0.5 + tilt)]
#[translational(guide: arm @ (0.1, 0.2), slider @ (0, 0), axis = (1, 0.2), angle = 0.3 * level[2])]
#[distance(rod: table @ (0, 0), slider @ (0.1, 0), length = 1.2 + 0.2 * swell)]
#[point_on_line(edge: ground @ (0, 0), gauge @ (0.1, 0.1), axis = (1, 0.5), offset = 0.1 * level[0] + 0.02 * t)]
#[x(side: gauge @ (0.2, 0) = shake / 2)]
#[angle(lean: gauge = swell)]
#[angle(bend: tail = -level[1])]
#[fixed(weld: slider @ (0, 0.2), block @ (0.1, 0), angle = level[2] * level[2])]
#[constraint(equation: c + 0.1 * sin(c) = exp(0.3 * shake) + 0.2 * slider.x)]
#[guess(slider.x = 1.2, slider.y = 0.7)]
pub struct SignalTable;

/// Five independent signals.
pub(super) fn signals(t: f64) -> [Signal; 5] {
    let wave = |middle: f64, size: f64, pace: f64| {
        let (sin, cos) = (pace * t + size).sin_cos();
        Signal::new(middle + size * sin, size * pace * cos, -size * pace * pace * sin)
    };
    [wave(0.3, 0.2, 1.3), wave(-0.1, 0.3, 0.9), wave(0.2, 0.25, 1.7), wave(0.4, 0.15, 2.1), wave(0.0, 0.4, 1.1)]
}
