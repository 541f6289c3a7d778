//! Contacts with curves: wrong options, and wrong names of the variables of a curve.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(cam, arm)]
#[coordinates(u, v)]
#[define(turned = cam.phi)]
#[on_curve(A: cam @ (0, 0), arm @ (0, 0))]
#[on_curve(B: cam @ (0, 0), arm @ (0, 0), polar(phi) = r)]
#[on_curve(C: cam @ (0, 0), arm @ (0, 0), polar = r)]
#[on_curve(D: cam @ (0, 0), arm @ (0, 0), polar(theta) r)]
#[on_curve(E: cam @ (0, 0), arm @ (0, 0), polr(theta) = r)]
#[on_curve(F: cam @ (0, 0), arm @ (0, 0), implicit(x, y) = x*x + y*y - r*r)]
#[on_curve(G: cam @ (0, 0), arm @ (0, 0), implicit(X) = X - r)]
#[on_curve(H: cam @ (0, 0), arm @ (0, 0), parametric() = (r, r))]
#[on_curve(I: cam @ (0, 0), arm @ (0, 0), parametric(u) = r*cos(u))]
#[on_curve(J: cam @ (0, 0), arm @ (0, 0), parametric(u) = (r*cos(u), r*sin(u)), polar(theta) = r)]
#[on_curve(K: cam @ (0, 0), arm @ (0, 0), polar(theta) = r, roller = 0.1)]
#[on_curve(L: cam @ (0, 0), arm @ (0, 0), implicit(X, Y) = X - r, roller = 0.1)]
#[on_curve(M: cam @ (0, 0), polar(theta) = r)]
#[on_curve(N: cam @ (0, 0), arm @ (0, 0), polar(theta) = r, polar(theta) = r)]
#[flat_follower(O: cam @ (0, 0), arm @ (0, 0), support(theta) = r)]
#[flat_follower(P: cam @ (0, 0), arm @ (0, 0), axis = (1, 0))]
#[flat_follower(Q: cam @ (0, 0), arm @ (0, 0), axis = (1, 0), support(t) = r)]
#[flat_follower(R: cam @ (0, 0), arm @ (0, 0), axis = (0, 0), support(theta) = r)]
#[revolute(S: cam @ (0, 0), arm @ (0, 0), polar(theta) = r)]
struct Written {
    #[param(1)]
    r: f64,
}

#[mechanism]
#[bodies(cam, arm)]
#[coordinates(u, v, w[3])]
#[define(turned = cam.phi)]
#[on_curve(A: cam @ (0, 0), arm @ (0, 0), polar(theta) = r + 0.1*cos(thta))]
#[on_curve(B: cam @ (0, 0), arm @ (0, 0), polar(theta) = r + arm.x)]
#[on_curve(C: cam @ (0, 0), arm @ (0, 0), polar(theta) = r + turned*u)]
#[on_curve(D: cam @ (0, 0), arm @ (0, 0), polar(theta) = r + theta[2])]
#[on_curve(E: cam @ (0, 0), arm @ (0, 0), implicit(X, Y) = x*X + Y - theta)]
#[on_curve(F: cam @ (0, 0), arm @ (0, 0), parametric(r) = (r, r))]
#[on_curve(G: cam @ (0, 0), arm @ (0, 0), parametric(z) = (z, r))]
#[on_curve(H: cam @ (0, 0), arm @ (0, 0), parametric(u) = (u, v))]
#[on_curve(I[i in 0..2]: cam @ (0, 0), arm @ (0, 0), parametric(w[i]) = (w[i], w[i + 1]))]
#[on_curve(J[i in 0..2]: cam @ (0, 0), arm @ (0, 0), parametric(w[i + 2]) = (w[i + 2], r))]
#[on_curve(K: cam @ (0, 0), arm @ (0, 0), parametric(w) = (r, r))]
#[on_curve(L: cam @ (0, 0), arm @ (0, 0), parametric(u) = (u, u*u), roller = t)]
#[on_curve(M: cam @ (0, 0), arm @ (0, 0), parametric(u) = (u, u*u), roller = u)]
#[flat_follower(N: cam @ (0, 0), arm @ (0, 0), axis = (theta, 0), support(theta) = r*theta)]
#[angle(O: arm = theta)]
#[on_curve(P: cam @ (0, 0), arm @ (0, 0), polar(theta) = distance(ground @ (theta, 0), ground @ (0, 0)))]
struct Named {
    #[param(1)]
    r: f64,
}

#[mechanism]
#[bodies(cam, arm)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[on_curve(A: cam @ (0, 0), arm @ (0, 0), polar(theta) = -0.1)]
#[on_curve(B: cam @ (0, 0), arm @ (0, 0), polar(theta) = 0)]
#[on_curve(C: cam @ (0, 0), arm @ (0, 0), implicit(X, Y) = r*r - 1)]
#[on_curve(D: cam @ (0, 0), arm @ (0, 0), parametric(u) = (r, t))]
#[on_curve(E: cam @ (0, 0), cam @ (1, 0), polar(theta) = r)]
#[flat_follower(F: arm @ (0, 0), arm @ (1, 0), axis = (1, 0), support(theta) = r)]
struct Meant {
    #[param(1)]
    r: f64,
}

/// The normal of a roller's curve depends on its derivative, so that accelerations would need the third derivative.
#[mechanism]
#[bodies(cam, arm, rod)]
#[coordinates(u, v)]
#[function(f)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[revolute(P: ground @ (1, 0), arm @ (0, 0))]
#[on_curve(A: cam @ (0, 0), arm @ (1, 0), parametric(u) = (u, 0.1 * f(2*u)), roller = 0.1)]
#[on_curve(B: cam @ (0, 0), rod @ (1, 0), parametric(v) = (v + f(t), f(r)), roller = 0.1)]
struct Third<F> {
    f: F,
    #[param(1)]
    r: f64,
}

/// Variables of curves outside of their curve; a declared coordinate of the same name is used instead.
#[mechanism]
#[bodies(cam, arm)]
#[coordinates(u)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[angle(A: arm = 2 * theta)]
#[constraint(B: arm.x * X = Y)]
#[on_curve(C: cam @ (0, 0), arm @ (0, 0), polar(theta) = r + X)]
#[on_curve(D: cam @ (0, 0), arm @ (0, 0), implicit(X, Y) = X + Y - theta)]
#[on_curve(E: cam @ (0, 0), arm @ (0, 0), parametric(u) = (cos(theta), r))]
struct Elsewhere {
    #[param(1)]
    r: f64,
}

fn main() {}
