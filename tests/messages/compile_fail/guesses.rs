//! What users guess: attributes, functions, units and forms of other tools.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, rod)]
#[pin(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (1, 0), rod @ (0, 0))]
#[slot(B: rod @ (1, 0), ground @ (0, 0))]
#[start(rod.phi = 0.2)]
#[driver(turn: A.angle = 50deg + 2t + max(t, 1))]
#[driver(push: angle(crank, rod) = mod(t, 1))]
#[point(tip = rod @ (5mm, 0.1 m))]
#[x(C: world @ (0, 0) = tip.speed)]
struct Words;

#[mechanism]
#[bodies(crank coupler)]
#[body(arm[2], x = 0.5*i, y = 0)]
#[revolute(O[i in 0..2][j in 0..2]: ground @ (0, 0), crank @ (0, 0))]
#[driver(turn[i in 3..0]: arm[i].phi = i)]
#[torque(F: crank, 3)]
struct Forms;

#[mechanism]
#[bodies(crank)]
#[output(height = crank.y)]
#[input(lift, value = 1.0, unit = "sec")]
#[units(m, s)]
struct Declarations;

/// A derived `Default` would discard the default of the field.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = l*t)]
#[derive(Clone, Default)]
struct Derived {
    #[param(0.1)]
    l: f64,
}

fn main() {
    let _ = Derived::default().clone();
}
