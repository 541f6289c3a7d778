//! Inputs: errors in their declarations and uses.

use kin_runtime::mechanism;

/// Geometry may depend on parameters only.
#[mechanism]
#[bodies(arm, slider)]
#[input(u, w[2])]
#[point(tip = arm @ (u, 0))]
#[revolute(A: ground @ (0, 0), arm @ (w[0], 0))]
#[translational(B: arm @ (0, 0), slider @ (0, 0), axis = (1, u))]
#[driver(C: arm.phi = u)]
#[driver(D: distance(tip, slider @ (0, 0)) = w[1])]
#[guess(arm.phi = u)]
struct Places;

/// A define may only be used where everything in it may be used.
#[mechanism]
#[bodies(arm)]
#[input(u)]
#[define(s = 2 * u)]
#[revolute(A: ground @ (0, 0), arm @ (s, 0))]
#[driver(C: arm.phi = s)]
struct Defined;

/// Members of a family need an index, other inputs take none.
#[mechanism]
#[bodies(arm)]
#[input(u, w[2])]
#[revolute(A: ground @ (0, 0), arm @ (0, 0))]
#[driver(B: arm.phi = w)]
#[driver(C: arm.phi = w[2])]
#[driver(D: arm.phi = u[0])]
#[driver(E: arm.phi = u(t))]
#[driver(F: arm.phi = u.rate)]
#[driver(G[i in 0..3]: arm.phi = w[i])]
struct Indices;

/// An input is declared by a name that is not in use.
#[mechanism]
#[bodies(arm)]
#[input(arm, l, t)]
#[input(lift = 0.5)]
#[input()]
#[input]
#[inputs(reach)]
#[revolute(A: ground @ (0, 0), arm @ (l, 0))]
#[driver(B: arm.phi = lift)]
struct Names {
    l: f64,
}

/// A misspelt input, with a suggestion.
#[mechanism]
#[bodies(arm)]
#[input(boom_length, bucket_length)]
#[revolute(A: ground @ (0, 0), arm @ (0, 0))]
#[driver(B: arm.phi = boom_lenght)]
struct Misspelt;

/// A row with inputs alone moves nothing.
#[mechanism]
#[bodies(arm)]
#[input(u)]
#[revolute(A: ground @ (0, 0), arm @ (0, 0))]
#[constraint(B: u = 1)]
struct Alone;

fn main() {
    let _ = (Places::u, Defined::u, Indices::w[1], Names::lift, Misspelt::boom_length, Alone::u);
}
