//! Bodies, coordinates, points, defines and guesses with syntax errors.

use kin_runtime::mechanism;

#[mechanism]
#[bodies]
#[bodies()]
#[bodies(a b)]
#[bodies(c = 1, d(0, 0), e.x)]
#[bodies[f]]
#[coordinates()]
#[coordinates(u = 0)]
#[point(P)]
#[point(Q: f @ (0, 0))]
#[point(R == f @ (0, 0), S = , T = (0, 0), V = f @ (0, 0) + 1)]
#[define(s)]
#[define(r = , w: 1, z == 2)]
#[define(#[cfg(test)] k = 1)]
#[guess()]
#[guess(f.phi, u: 1, f.x == 1, f. = 1, 3 = u, u = 1 = 2)]
#[body]
#[body()]
#[body(g, h)]
#[body(i, z = 1, x = 1, x = 2, origin = f @ (0, 0), origin = f @ (1, 0))]
#[body(j, x, phi = )]
#[body(m: x = 1)]
#[body(n, origin = (0, 0), x == 1)]
#[angle(A: f = t)]
struct Declarations;

#[mechanism]
#[bodies(crank)]
#[body(rod, origin = crank @ (1, 0), x = 1, y = 2, phi = 0)]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
struct Carried;

#[mechanism]
#[revolute(A: ground @ (0, 0), crank @ (0, 0))]
#[revolute(B: crank @ (1, 0), rod @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct Undeclared;

fn main() {
    let _ = (Declarations::P, Declarations::s, Carried::rod);
}
