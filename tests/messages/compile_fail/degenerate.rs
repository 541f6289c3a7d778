//! Geometry whose degeneracy shows only after names have been resolved and constants folded.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, slider)]
#[define(nothing = 1 - 1)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (nothing, 2 * nothing))]
#[point_on_line(slot: crank @ (0, 0), slider @ (1, 0), axis = (l - l, 0))]
#[distance(rod: crank @ (1, 0), slider @ (0, 0), length = nothing)]
#[distance(bar: crank @ (2, 0), slider @ (0, 1), length = 2 - 3)]
#[driver(turn: crank.phi = t / nothing)]
struct Folded {
    #[param(1)]
    l: f64,
}

#[mechanism]
#[bodies(p, q)]
#[distance(near: p @ (l, 0), q @ (0, 0), length = 0 * l)]
#[driver(far: distance(p @ (0, 0), q @ (0, 0)) = 0)]
#[driver(behind: distance(p @ (1, 0), q @ (1, 0)) = 0.1 - 1)]
#[angle(level: p = sqrt(l) / (l - l))]
struct Lengths {
    #[param(1)]
    l: f64,
}

#[mechanism]
#[bodies(a, b, c, wheel[3])]
#[coordinates(psi, chi[2])]
#[gear(A: a, b, radii = (0 * l, 1))]
#[belt(B: b, c, radii = (l, l - l))]
#[gear(C[i in 0..2]: wheel[i], wheel[i + 1], radii = (i, 1))]
#[rack_pinion(D: ground @ (0, 0), a @ (0, 0), axis = (1, 0), pinion = b, radius = nothing)]
#[rolling(E: ground @ (0, 0), a @ (0, 0), axis = (1, 0), radius = 0 * l)]
#[rolling(F: b @ (0, 0), c @ (0, 0), radii = (l, -l), along = psi)]
#[rolling(G[i in 0..2]: a @ (0, 0), wheel[i] @ (0, 0), radii = (i - 2, 1), along = chi[i])]
#[distance(H[i in 0..2]: a @ (0, 0), wheel[i] @ (0, 0), length = i - 1)]
#[x(I[i in 0..2]: wheel[i] @ (0, 0) = i)]
#[on_curve(J: ground @ (0, 0), c @ (0, 0), polar(theta) = 0 * l * cos(theta) - 1)]
#[on_curve(K: ground @ (0, 0), c @ (0, 0), parametric(psi) = (psi, 1), roller = 0 * l)]
#[define(nothing = l - l)]
struct Radii {
    #[param(1)]
    l: f64,
}

/// Conditions that are constant after constants have been folded.
#[mechanism]
#[bodies(c)]
#[revolute(O: ground @ (0, 0), c @ (0, 0))]
#[driver(turn: c.phi = t)]
#[unilateral(L[i in 0..3]: i * c.phi > 0)]
#[unilateral(M[i in 0..3]: (i - 1) * c.phi + l < 0)]
#[unilateral(N: c.phi - c.phi < l)]
#[unilateral(P[i in 1..3]: i * c.phi > 0)]
struct Still {
    #[param(1)]
    l: f64,
}

/// For a driven distance, the error is at its value.
#[mechanism]
#[bodies(p, q, r[2])]
#[driver(D: distance(p @ (0, 0), q @ (0, 0)) = 0 * l)]
#[driver(E[i in 0..2]: distance(p @ (0, 0), r[i] @ (0, 0)) = 1 - i)]
struct Driven {
    #[param(1)]
    l: f64,
}

/// Constants without a value.
#[mechanism]
#[bodies(crank)]
#[define(minus = 1 - 2)]
#[revolute(O: ground @ (0, 0), crank @ (asin(2), 0))]
#[driver(turn: crank.phi = sqrt(minus)*t + ln(0) + pow(0, -1) + exp(1e3))]
struct NoValue;

/// Masses, springs and ropes whose sizes have been folded.
#[mechanism]
#[bodies(crank, link[3])]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(P[i in 0..3]: ground @ (i, 0), link[i] @ (0, 0))]
#[rope(A: ground @ (1, 0), crank @ (1, 0), length = 1 - 3)]
#[rope(B: ground @ (1, 0), crank @ (2, 0), length = nothing)]
#[mass(crank @ (0, 0), mass = 1 - 3, inertia = -2 * 3)]
#[mass(M[i in 0..3]: link[i] @ (0, 0), mass = 1 - i)]
#[spring(S: ground @ (1, 0), crank @ (1, 0), stiffness = 1 - 1)]
#[torsion_spring(T: ground, crank, stiffness = 0 * l, damping = nothing)]
#[torsion_spring(U[i in 0..3]: ground, link[i], stiffness = l * i)]
#[define(nothing = l - l)]
struct Loads {
    #[param(1)]
    l: f64,
}

fn main() {
    let _ = (Folded::default(), Lengths::default(), Radii::default());
}
