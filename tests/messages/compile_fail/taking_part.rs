//! Bodies and coordinates without constraints, and mechanisms that cannot move.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, wheel)]
#[coordinates(u, v)]
#[point(tip = wheel @ (1, 0))]
#[define(s = v)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: u = t)]
struct Untouched;

#[mechanism]
struct Nothing {
    #[param(1)]
    l: f64,
}

#[mechanism]
#[body(frame, x = 0, y = 0, phi = 0)]
struct Held;

#[mechanism]
#[body(frame, x = 0, y = 0, phi = 0)]
#[body(table, origin = frame @ (1, 0), phi = 0)]
#[point(corner = table @ (1, 0))]
struct AllHeld;

/// The only row that would constrain the body has an error, which is the only error reported.
#[mechanism]
#[bodies(crank)]
#[body(c, phi = 0)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[angle(B: c = t)]
struct OnlyRow;

/// Everything that a joint could move is held.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(turn: crank.phi = t)]
struct HeldAlready;

/// A held coordinate is a cause of a redundant row.
#[mechanism]
#[body(crank, x = 0, y = 0, phi = t)]
#[bodies(rod)]
#[revolute(A: crank @ (1, 0), rod @ (0, 0))]
#[driver(push: rod.x = t)]
struct HeldAndDriven;

fn main() {
    let _ = (Untouched, Nothing::default(), Held, AllHeld::corner);
}
