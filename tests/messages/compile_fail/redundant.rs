//! Mechanisms that are redundant for all dimensions: the error names the joint and the joints that make it redundant.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.2, 0))]
#[revolute(B2: rocker @ (0.2, 0), coupler @ (0.4, 0))]
#[revolute(D: ground @ (0.5, 0), rocker @ (0, 0))]
struct Twice;

/// No single joint is wrong; together they determine the angle of the last wedge twice.
#[mechanism]
#[bodies(lower, upper)]
#[translational(floor: ground @ (0, 0), lower @ (0, 0), axis = (1, 0))]
#[translational(slope: lower @ (0, 0), upper @ (0, 0), axis = (4, 3))]
#[translational(wall: ground @ (1, 0), upper @ (0, 0), axis = (0, 1))]
#[driver(push: lower.x = t)]
struct Wedges;

#[mechanism]
#[bodies(table)]
#[translational(front: ground @ (0, 0), table @ (0, 0), axis = (1, 0))]
#[translational(back: ground @ (0, depth), table @ (0, depth), axis = (1, 0))]
struct Guides {
    #[param(0.2)]
    depth: f64,
}

/// The number of rows is right for a frame, but two of them belong to a part that is rigid without one of them.
#[mechanism]
#[bodies(p, q, r, s, swing[2])]
#[revolute(O: ground @ (0, 0), p @ (0, 0))]
#[revolute(A: p @ (1, 0), q @ (0, 0))]
#[revolute(B: q @ (1, 0), r @ (0, 0))]
#[revolute(C: r @ (1, 0), s @ (0, 0))]
#[revolute(D: s @ (1, 0), p @ (0, 0))]
#[distance(rising: p @ (0, 0), r @ (0, 0), length = 1.4)]
#[distance(falling: p @ (1, 0), s @ (0, 0), length = 1.4)]
#[revolute(pin: ground @ (3, 0), swing[0] @ (0, 0))]
#[revolute(link[i in 0..1]: swing[i] @ (1, 0), swing[i + 1] @ (0, 0))]
struct Hidden;

#[mechanism]
#[bodies(crank, rod)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), rod @ (0, 0))]
#[y(guide: rod @ (0.4, 0) = 0)]
#[driver(turn: crank.phi = t)]
#[driver(push: rod.x = 0.4 + t)]
struct Overdriven;

#[mechanism]
#[bodies(chain[4])]
#[revolute(root: ground @ (0, 0), chain[0] @ (0, 0))]
#[revolute(pin[i in 0..3]: chain[i] @ (1, 0), chain[i + 1] @ (0, 0))]
#[relative_angle(turn[i in 0..3]: chain[i], chain[i + 1] = 0.1 * t)]
#[angle(hold[i in 0..4]: chain[i] = 0)]
#[fixed(weld: chain[0] @ (0.5, 0), chain[1] @ (0.5, 0))]
struct Family;

/// With `allow_redundant`, a mechanism that moves only because of special lengths is accepted.
#[mechanism(allow_redundant)]
#[bodies(p, q)]
#[revolute(A: ground @ (0, 0), p @ (0, 0))]
#[revolute(B: p @ (1, 0), q @ (0, 0))]
#[revolute(C: p @ (1, 0), q @ (0, 0))]
struct Allowed;

/// The height that rolling on the line prescribes is held already.
#[mechanism]
#[body(wheel, y = 0.3)]
#[rolling(R: ground @ (0, 0), wheel @ (0, 0), axis = (1, 0), radius = 0.3)]
struct Rests;

/// For some sliders one row is redundant, for one slider all rows are.
#[mechanism]
#[bodies(slider[3])]
#[angle(level[i in 0..3]: slider[i] = 0)]
#[y(floor: slider[2] @ (0, 0) = 0)]
#[translational(rail[i in 0..3]: ground @ (0, 0), slider[i] @ (0, 0), axis = (1, 0))]
struct Row;

/// Joints of which some rows are needed: what has only these rows replaces them.
mod parts {
    use kin_runtime::mechanism;

    /// The wheel of a cart must still roll.
    #[mechanism]
    #[bodies(cart, wheel)]
    #[translational(T: ground @ (0, 0), cart @ (0, 0), axis = (1, 0))]
    #[revolute(P: cart @ (0, r), wheel @ (0, 0))]
    #[rolling(R: ground @ (0, 0), wheel @ (0, 0), axis = (1, 0), radius = r)]
    #[driver(d: cart.x = t)]
    struct Cart {
        #[param(0.3)]
        r: f64,
    }

    /// The angle and one direction of the weld are needed.
    #[mechanism]
    #[bodies(a, b)]
    #[translational(T: ground @ (0, 0), a @ (0, 0), axis = (1, 0))]
    #[y(Y: b @ (0, 0) = 0)]
    #[fixed(F: a @ (0, 0), b @ (0, 0))]
    #[driver(d: a.x = t)]
    struct OneOfThree;

    /// One direction of the weld is needed.
    #[mechanism]
    #[bodies(a, b)]
    #[translational(T: ground @ (0, 0), a @ (0, 0), axis = (1, 0))]
    #[translational(T2: ground @ (0, 0), b @ (0, 0), axis = (1, 0))]
    #[fixed(F: a @ (0, 0), b @ (0, 0))]
    #[driver(d: a.x = t)]
    struct TwoOfThree;

    /// The planet's rolling is needed, its position is not.
    #[mechanism]
    #[bodies(sun, planet)]
    #[coordinates(psi)]
    #[revolute(S: ground @ (0, 0), sun @ (0, 0))]
    #[x(X: planet @ (0, 0) = 3)]
    #[y(Y: planet @ (0, 0) = 0)]
    #[constraint(level: psi = 0)]
    #[rolling(R: sun @ (0, 0), planet @ (0, 0), radii = (1, 2), along = psi)]
    #[driver(d: sun.phi = t)]
    struct Planet;
}

fn main() {
    let _ = (Twice, Wedges, Guides::default(), Hidden, Overdriven, Family, Allowed);
}
