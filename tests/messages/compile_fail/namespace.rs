//! Names that are declared twice, and reserved words as names.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, rod, crank)]
#[coordinates(rod, u, u)]
#[body(crank, x = 0)]
#[point(tip = crank @ (0, 0), tip = crank @ (1, 0), length = crank @ (2, 0))]
#[define(stroke = u, u = 2, r#length = 3)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (1, 0), ground @ (0, 0))]
#[angle(A: crank = t)]
#[driver(drive: u = t)]
struct Twice {
    #[param(0.1)]
    length: f64,
    #[param(0.2)]
    stroke: f64,
}

#[mechanism]
#[bodies(ground, t)]
#[coordinates(pi, sqrt)]
#[point(distance = t @ (0, 0))]
#[define(atan2 = pi)]
#[driver(drive: pi = sqrt)]
struct Reserved {
    #[param(0.1)]
    dot: f64,
    #[param(0.1)]
    pow: f64,
}

#[mechanism]
#[bodies(loop, self, Self, crate, _, 3, "crank")]
#[coordinates(type)]
#[driver(match: type = in)]
struct Keywords;

#[mechanism]
#[body(arm[k in 0..3], x = k, y = 0)]
#[point(tip[arm in 0..3] = arm[arm] @ (l, 0))]
#[driver(drive[t in 0..3]: arm[t].phi = t)]
struct IndexVariables {
    #[param(0.1)]
    k: f64,
    #[param(0.1)]
    l: f64,
}

fn main() {
    let _ = Twice { length: 0.1, stroke: 0.2 };
    let _ = (Twice::crank, Twice::tip, Twice::u);
    let _ = Reserved::default();
}
