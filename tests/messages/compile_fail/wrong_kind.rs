//! Names of one kind where another kind is required.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, rod)]
#[coordinates(u)]
#[point(tip = rod @ (l, 0), corner = tip @ (0, 1), copy = crank, wheel = l @ (0, 0))]
#[define(stroke = tip.x - l, whole = crank, place = tip)]
#[body(slider, origin = rod)]
#[revolute(A: ground, crank @ (0, 0))]
#[revolute(B: crank, rod @ (0, 0))]
#[revolute(C: u, stroke)]
#[revolute(D: l @ (0, 0), tip @ (0, 0))]
#[revolute(E: crank.x, tip.x)]
#[angle(F: tip = 0)]
#[angle(G: crank.phi = 0)]
#[angle(H: crank @ (0, 0) = 0)]
#[relative_angle(I: u, l = 0)]
#[x(J: crank = 1)]
#[x(K: crank.x = 1)]
#[y(M: l = 1)]
#[driver(drive: crank = tip + ground)]
#[driver(push: l.x = stroke.y + u.x + t.x)]
#[driver(pull: tip.phi = sin.x + pi.y)]
#[constraint(call: u = l(3) + crank(t) + t(0))]
#[constraint(index: u[0] = l[1] + crank[2].x + t[0] + ground[1].x)]
#[guess(crank = 1, tip.x = 2, l = 3, stroke = 4, ground.x = 5, ground = 6)]
struct WrongKind {
    #[param(0.1)]
    l: f64,
}

fn main() {}
