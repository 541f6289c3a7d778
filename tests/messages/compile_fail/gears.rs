//! Gears, belts, racks and rolling discs with syntax errors, or between bodies that they cannot couple.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(sun, planet, arm)]
#[coordinates(psi)]
#[gear(A: sun, planet)]
#[gear(B: sun, planet, radii = 2)]
#[gear(C: sun, planet, radii = (1, 2, 3))]
#[gear(D: sun, radii = (1, 2))]
#[gear(E: sun @ (0, 0), planet, radii = (1, 2))]
#[gear(F: sun, planet, radii = (1, t), carrier = amr)]
#[gear(G: sun, planet, radii = (1, 2), carrier = arm @ (0, 0))]
#[gear(H: sun, planet, radii = (1, 2), carrier = r)]
#[belt(I: sun, planet, radius = (1, 2))]
#[belt(J: sun, planet, radii = (1, 2), offset = psi)]
#[rack_pinion(K: ground @ (0, 0), arm @ (0, 0), axis = (1, 0), radius = 1)]
#[rack_pinion(L: ground @ (0, 0), arm @ (0, 0), pinion = sun)]
#[rack_pinion(M: ground @ (0, 0), arm @ (0, 0), axis = (1, 0), pinion = , radius = sun.phi)]
#[rolling(N: ground @ (0, 0), arm @ (0, 0))]
#[rolling(O: ground @ (0, 0), arm @ (0, 0), axis = (1, 0))]
#[rolling(P: ground @ (0, 0), arm @ (0, 0), axis = (1, 0), radii = (1, 2))]
#[rolling(Q: ground @ (0, 0), arm @ (0, 0), along = psi, radius = 1)]
#[rolling(V: ground @ (0, 0), arm @ (0, 0), radii = (1, 2))]
#[rolling(R: ground @ (0, 0), arm @ (0, 0), radii = (1, 2), along = arm.phi)]
#[rolling(S: ground @ (0, 0), arm @ (0, 0), radii = (1, 2), along = sun)]
#[rolling(T: ground @ (0, 0), arm @ (0, 0), radii = (1, 2), along = psy)]
#[rolling(U: ground @ (0, 0), arm @ (0, 0), radii = (1, 2), along = psi[0])]
struct Written {
    #[param(1)]
    r: f64,
}

#[mechanism]
#[bodies(sun, planet, arm)]
#[bodies(wheel[3])]
#[coordinates(psi)]
#[gear(A: sun, sun, radii = (1, 2))]
#[gear(B: ground, planet, radii = (1, 2))]
#[gear(C: sun, arm, radii = (1, 2), carrier = arm)]
#[gear(D[i in 0..2]: wheel[i], wheel[i + 1], radii = (1, 2), carrier = wheel[1])]
#[belt(E[i in 0..3]: wheel[i], wheel[2 - i], radii = (1, 2))]
#[gear(F: sun, planet, radii = (0, -0.0))]
#[belt(G: sun, planet, radii = (1, 0), carrier = arm)]
#[rack_pinion(H: ground @ (0, 0), arm @ (0, 0), axis = (0, 0), pinion = ground, radius = 0)]
#[rack_pinion(I: arm @ (0, 0), arm @ (1, 0), axis = (1, 0), pinion = sun, radius = 1)]
#[rolling(J: ground @ (0, 0), planet @ (0, 0), axis = (0, 0), radius = 0)]
#[rolling(K: sun @ (0, 0), planet @ (0, 0), radii = (-2, 2), along = psi)]
#[rolling(L: sun @ (0, 0), sun @ (1, 0), radii = (0, 1), along = psi)]
struct Coupled;

fn main() {}
