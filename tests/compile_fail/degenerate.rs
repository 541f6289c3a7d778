//! Geometry that is degenerate only after names have been followed and numbers folded.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, slider)]
#[define(nothing = 1 - 1)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (nothing, 2 * nothing))]
#[point_on_line(slot: crank @ (0, 0), slider @ (1, 0), axis = (l - l, 0))]
#[distance(rod: crank @ (1, 0), slider @ (0, 0), length = nothing)]
#[distance(bar: crank @ (2, 0), slider @ (0, 1), length = 2 - 3)]
#[driver(turn: crank.phi = t / nothing)]
struct Folded {
    #[param(1)]
    l: f64,
}

#[mechanism]
#[bodies(p, q)]
#[distance(near: p @ (l, 0), q @ (0, 0), length = 0 * l)]
#[driver(far: distance(p @ (0, 0), q @ (0, 0)) = 0)]
#[angle(level: p = sqrt(l) / (l - l))]
struct Lengths {
    #[param(1)]
    l: f64,
}

fn main() {
    let _ = (Folded::default(), Lengths::default());
}
