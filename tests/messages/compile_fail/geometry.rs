//! Impossible geometry, and rows that cannot be satisfied.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, rod)]
#[coordinates(u)]
#[body(held, phi = 1)]
#[body(carried, origin = rod @ (1, 0))]
#[revolute(A: crank @ (0, 0), crank @ (1, 0))]
#[revolute(B: ground @ (0, 0), ground @ (1, 0))]
#[relative_angle(C: rod, rod = 1)]
#[fixed(D: rod @ (0, 0), rod @ (0, 0))]
#[translational(E: ground @ (0, 0), rod @ (0, 0), axis = (0, -0.0))]
#[point_on_line(F: ground @ (0, 0), rod @ (0, 0), axis = (0, 0), offset = 1)]
#[distance(G: ground @ (0, 0), rod @ (0, 0), length = 0)]
#[distance(H: ground @ (0, 0), crank @ (0, 0), length = -2)]
#[x(I: ground @ (1, 0) = 2)]
#[angle(J: held = 1)]
#[angle(K: ground = 1)]
#[constraint(L: l = 2)]
#[driver(M: l = omega * t)]
#[driver(N: ground.x = t)]
#[x(O: held @ (1 / 0, 0) = 2)]
#[guess(held.phi = 1, crank.x = 0, crank.x = 1, rod.phi = 2, rod.phi = 2, u = 1, u = 2, carried.x = 1, carried.phi = 2)]
#[constraint(P: u = rod.x)]
struct Geometry {
    #[param(1)]
    l: f64,
    #[param(1)]
    omega: f64,
}

fn main() {}
