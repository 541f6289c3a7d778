//! Ropes and screws: operands that are missing, too few, or at the same place.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(beam, load)]
#[rope(a: beam @ (1, 0), length = 2)]
#[rope(b: beam @ (1, 0), ground @ (1, 1))]
#[rope(c: beam @ (1, 0), beem, ground @ (1, 1), length = 2)]
#[rope(d: beam @ (1, 0), load @ (0, 0), length = load.x)]
#[screw(e: ground @ (0, 0), load @ (0, 0), axis = (1, 0), leed = 1, nut = beam)]
#[screw(f: ground @ (0, 0), load @ (0, 0), axis = (1, 0), lead = 1)]
struct Written;

#[mechanism]
#[bodies(beam, load)]
#[rope(a: beam @ (1, 0), ground @ (1, 1), length = -2)]
#[rope(b: load @ (0, 0), ground @ (1, 1), length = 0)]
#[screw(c: ground @ (0, 0), load @ (0, 0), axis = (0, 0), lead = 1, nut = ground)]
struct Placed;

#[mechanism]
#[bodies(beam)]
#[revolute(pin: ground @ (0, 0), beam @ (0, 0))]
#[rope(a: beam @ (1, 0), beam @ (1, 0), ground @ (1, 1), length = 2)]
struct Twice;

fn main() {}
