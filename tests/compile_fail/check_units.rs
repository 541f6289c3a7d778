//! Units that do not agree, where `check_units` asks for it.

use kin_runtime::mechanism;

/// Unknown units.
#[mechanism(check_units)]
#[coordinates(u)]
#[driver(drive: u = a + b + c + d)]
struct Unknown {
    #[param(1, unit = "metre")]
    a: f64,
    #[param(1, unit = "rad/sec")]
    b: f64,
    #[param(1, unit = "")]
    c: f64,
    #[param(1, unit = "m^n")]
    d: f64,
}

/// Sums, differences, arguments and scales.
#[mechanism(check_units)]
#[coordinates(u[9])]
#[constraint(sum: u[0] = l + omega)]
#[constraint(difference: u[1] = l - sin(omega*t))]
#[constraint(angle: u[2] = sin(l))]
#[constraint(growth: u[3] = exp(-t/l))]
#[constraint(root: u[4] = sqrt(l*l + l))]
#[constraint(scale: u[5] = l + wide)]
#[constraint(degrees: u[6] = cos(slope))]
#[constraint(quadrant: u[7] = atan2(l, omega))]
#[constraint(product: u[8] = pow(l, 2) + l*omega*t)]
struct Sums {
    #[param(1, unit = "m")]
    l: f64,
    #[param(1, unit = "rad/s")]
    omega: f64,
    #[param(1000, unit = "mm")]
    wide: f64,
    #[param(45, unit = "deg")]
    slope: f64,
}

/// Every part of every joint wants its unit.
#[mechanism(check_units)]
#[bodies(a, b, c, d, e, f, g, h)]
#[body(held, x = omega, y = 0, phi = l)]
#[coordinates(u, psi)]
#[point(tip = a @ (omega, 0))]
#[define(twice = tip.x + a.phi)]
#[revolute(A: ground @ (0, 0), a @ (slope, 0))]
#[translational(B: ground @ (0, 0), b @ (0, 0), axis = (l, omega), angle = l)]
#[fixed(C: a @ (0, 0), c @ (0, 0), angle = omega)]
#[point_on_line(D: a @ (0, 0), d @ (0, 0), axis = (1, 0), offset = omega)]
#[distance(E: a @ (0, 0), d @ (0, 0), length = omega)]
#[x(F: e @ (0, 0) = slope)]
#[y(G: e @ (0, 0) = omega)]
#[angle(H: e = l)]
#[relative_angle(I: e, f = l)]
#[gear(J: a, f, radii = (l, slope), offset = omega)]
#[belt(K: a, g, radii = (l, omega))]
#[rack_pinion(L: ground @ (0, 0), b @ (0, 0), axis = (1, 0), pinion = g, radius = omega, offset = slope)]
#[rolling(M: ground @ (0, 0), h @ (0, 0), axis = (1, 0), radius = omega, offset = slope)]
#[rolling(N: g @ (0, 0), h @ (0, 0), radii = (l, omega), along = psi, offset = slope)]
#[on_curve(O: ground @ (0, 0), c @ (0, 0), polar(theta) = l + theta)]
#[on_curve(P: ground @ (0, 0), c @ (0, 0), implicit(X, Y) = X*Y - l)]
#[on_curve(Q: ground @ (0, 0), f @ (0, 0), parametric(u) = (u + t, omega), roller = slope)]
#[flat_follower(R: a @ (0, 0), b @ (0, 0), axis = (1, 0), support(theta) = omega*sin(theta))]
#[knife_edge(S: h @ (0, 0), angle = l)]
#[gear(J2: c, g, radii = (omega, omega))]
#[gear(J3: c, g, radii = (1, l), offset = omega)]
#[belt(J4: c, g, radii = (2, omega))]
#[speed(T: h @ (0, 0), angle = l, value = l)]
#[nonholonomic(U: dot(h.x) = l*h.phi)]
#[driver(V: distance(tip, ground @ (0, 0)) = omega*t)]
#[driver(W: a.phi = omega)]
#[constraint(X: c.x = t)]
#[unilateral(Y: tip.y > omega)]
#[guess(b.x = omega, b.phi = l)]
struct Parts {
    #[param(1, unit = "m")]
    l: f64,
    #[param(1, unit = "rad/s")]
    omega: f64,
    #[param(1, unit = "rad")]
    slope: f64,
}

/// A place that carries an origin.
#[mechanism(check_units)]
#[bodies(horse)]
#[body(rider, origin = horse @ (0, turn))]
#[revolute(A: ground @ (0, 0), horse @ (r, 0))]
#[angle(B: rider = 0.1)]
struct Carried {
    #[param(1, unit = "m")]
    r: f64,
    #[param(1, unit = "rad")]
    turn: f64,
}

fn main() {}
