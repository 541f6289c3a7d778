//! Items that cannot be a mechanism; they stay in the program, so that no further errors follow.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank)]
#[derive(Clone, Copy)]
enum Enumeration {
    #[param(1)]
    A,
}

#[mechanism]
#[bodies(crank)]
union Union {
    a: f64,
}

#[mechanism]
#[coordinates(u)]
fn function() {}

#[mechanism]
#[coordinates(u)]
#[driver(drive: u = t)]
struct Tuple(#[param(1)] f64, f64);

#[mechanism]
struct Empty;

#[mechanism]
#[bodies(crank)]
#[mechanism]
#[param(1)]
#[angle(A: crank = t)]
struct Misplaced;

fn main() {
    let _ = (Enumeration::A, Union { a: 1.0 }, Tuple(1.0, 2.0), Generic { a: 1.0 }, Scalar::<1>, Empty, Misplaced);
    function();
}
