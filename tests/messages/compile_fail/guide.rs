//! The errors that the guide shows, with the same descriptions.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, rod)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crnk @ (lenght, 0), rod @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct Misspelt {
    #[param(0.2)]
    length: f64,
}

#[mechanism]
#[bodies(crank, rod)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2 + rod.phi, 0), rod @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct NotGeometry;

#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = 90 deg * t)]
struct Degrees;

#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(turn: crank.phi = t)]
#[driver(push: slider.x = 0.5 + t)]
struct DrivenTwice;

#[mechanism]
#[bodies(slider)]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[angle(level: slider = 0)]
struct SaidTwice;

#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (r + e, 0))]
struct Units {
    #[param(0.2, unit = "m")]
    r: f64,
    #[param(5, unit = "mm")]
    e: f64,
}

fn main() {}
