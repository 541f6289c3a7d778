//! Time and coordinates where only parameters are allowed, and coordinates where only time is allowed.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, rod)]
#[coordinates(u)]
#[point(tip = rod @ (t, u), corner = ground @ (l, l))]
#[define(moving = crank.phi, driven = 2 * t, twice = driven + 1, size = 2 * l)]
#[body(slider, x = u, y = crank.y, phi = rod.phi)]
#[body(carried, origin = rod @ (crank.x, distance(crank @ (0, 0), rod @ (0, 0))))]
#[revolute(A: ground @ (t, 0), crank @ (moving, driven))]
#[revolute(B: crank @ (crank.phi, twice), rod @ (size, corner.x))]
#[translational(C: ground @ (0, 0), slider @ (0, 0), axis = (cos(t), sin(u)), angle = rod.phi)]
#[point_on_line(D: ground @ (0, 0), rod @ (0, 0), axis = (moving, 1), offset = moving)]
#[distance(E: ground @ (0, 0), rod @ (0, 0), length = u)]
#[fixed(F: slider @ (0, 0), carried @ (0, 0), angle = u)]
#[x(G: rod @ (0, 0) = crank.x)]
#[y(H: rod @ (0, 0) = distance(rod @ (1, 0), ground @ (0, 0)))]
#[angle(I: rod = crank.phi / 2)]
#[relative_angle(J: rod, crank = u)]
#[driver(drive: crank.phi + u + moving = driven + slider.y)]
#[guess(crank.phi = t, rod.phi = crank.phi, u = moving + driven + size)]
struct Places {
    #[param(0.1)]
    l: f64,
}

fn main() {}
