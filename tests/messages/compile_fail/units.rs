//! Units that do not agree: units are checked as soon as one is written.

use kin_runtime::mechanism;

/// Unknown units.
#[mechanism]
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

/// Units of sums, differences, arguments of functions, and scale factors.
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

/// The required unit of every part of every joint.
#[mechanism]
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
#[constraint(X: c.x = l*t)]
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

/// A point that is the origin of a body.
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

/// Units of the same kind with different scales: the error names both and the conversion factor.
#[mechanism]
#[bodies(crank, rod, disc)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (l, 0))]
#[revolute(B: ground @ (r, 0), disc @ (l/1000, 0))]
#[driver(drive: crank.phi = omega*t)]
#[driver(turn: disc.phi = n*t)]
#[driver(rest: rod.phi = cos(turns) + cos(turns*2*pi) + sin(omega*pi/180*t))]
struct Scales {
    #[param(0.2, unit = "m")]
    r: f64,
    #[param(700, unit = "mm")]
    l: f64,
    #[param(60, unit = "deg/s")]
    omega: f64,
    #[param(60, unit = "rpm")]
    n: f64,
    #[param(1, unit = "rev")]
    turns: f64,
}

/// Radii are lengths or numbers of teeth, but not both.
#[mechanism]
#[bodies(a, b, c, d)]
#[gear(J: a, b, radii = (z1, 2*z1))]
#[belt(K: a, c, radii = (z1, z1))]
#[gear(L: a, d, radii = (z3, z4))]
struct Teeth {
    #[param(20, unit = "rad")]
    z1: f64,
    #[param(20, unit = "1")]
    z3: f64,
    #[param(20)]
    z4: f64,
}

/// Units of coordinates, inputs and defines.
#[mechanism]
#[bodies(a)]
#[coordinates(u, unit = "mm")]
#[coordinates(w, unit = "metre")]
#[input(lift, default = 0.3, unit = "m")]
#[input(turn, default = l, units = "rad")]
#[input(late, unit = "m", later)]
#[input(twice, default = 1, default = 2)]
#[define(bare = a.x, unit = m)]
#[define(none = a.x, default = 3)]
#[driver(x: a.x = lift)]
struct Options {
    #[param(1, unit = "m")]
    l: f64,
}

/// The given units of coordinates, inputs and defines are checked where these are used.
#[mechanism]
#[bodies(a)]
#[coordinates(u, unit = "mm")]
#[coordinates(free)]
#[input(lift, turn, unit = "m")]
#[define(reach = a.x + l, unit = "rad")]
#[define(fine = 2*a.phi, unit = "rad")]
#[driver(x: a.x = lift)]
#[driver(y: a.y = u)]
#[driver(phi: a.phi = turn)]
#[constraint(c: u = l)]
#[constraint(d: free = l)]
#[guess(u = l, free = 3)]
struct Named {
    #[param(1, unit = "m")]
    l: f64,
}

/// Nothing else says in which unit masses are.
#[mechanism]
#[bodies(crank)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[driver(drive: crank.phi = t)]
#[mass(crank @ (l, 0), mass = l)]
struct Masses {
    #[param(1, unit = "m")]
    l: f64,
}

fn main() {}
