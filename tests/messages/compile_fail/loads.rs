//! Masses and loads: every error is at its own token.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[gravity(0, -9.81)]
#[gravity(0, -1)]
#[mass(ground @ (0, 0), mass = 1)]
#[mass(crank @ (0.5, 0), mass = 1)]
#[mass(crank @ (0.5, 0), mass = 2)]
#[mass(crank @ (0.2, 0), mass = -1)]
#[mass(crank @ (0.1, 0), mass = 1, inertia = -2)]
#[mass(crank @ (0.3, 0), mass = t)]
#[mass(crank @ (0.4, 0))]
#[mass(crank @ (0.6, 0), weight = 3)]
#[force(pull: ground @ (0, 0), (1, 0))]
#[force(push: crank @ (0, 0), 1, 0)]
#[force(turned: crank @ (0, 0), (1, 0), frame = crnk)]
#[force(crank @ (0, 0), (1, 0))]
#[torque(nobody: ground = 1)]
#[torque(own: crank, crank = 1)]
#[torque(three: crank, crank, ground = 1)]
#[torque(none = 1)]
#[spring(S: crank @ (0, 0), crank @ (1, 0), stiffness = 1)]
#[spring(idle: ground @ (0, 0), crank @ (1, 0), free_length = 1)]
#[spring(stiff: ground @ (0, 0), crank @ (1, 0), stifness = 1)]
#[spring(pull: ground @ (0, 0), crank @ (1, 0), stiffness = 1)]
#[torsion_spring(T: crank @ (0, 0), ground, stiffness = 1)]
#[torque(fast: crank = -crank.phi_dot)]
#[torsion_spring(rate: ground, crank, damping = dot(crank.phi))]
struct Loads;

#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[gravity(0, -9.81)]
struct NothingToPull;

#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[inertia(crank = 3)]
#[masses(crank @ (0, 0), mass = 1)]
struct Slips;

/// A point is declared in one place, and wrong in another.
#[mechanism]
#[bodies(crank)]
#[point(pivot = ground @ (0, 0), tip = crank @ (1, 0))]
#[revolute(O: pivot, crank @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[mass(pivot, mass = 1)]
#[spring(S: crank @ (0, 0), tip, stiffness = 1)]
#[rope(R: crank @ (0, 0), tip, length = 1)]
struct Named;

fn main() {}
