//! Closures of mechanisms with distances that may be 0 somewhere in the region that is searched, where the rows have no
//! derivatives.

use kin_runtime::{Assemblies, Instant, Kinematics, mechanism};

/// A platform on two legs and a rope over a pulley.
#[mechanism]
#[bodies(p)]
#[distance(c1: ground @ (0, 0), p @ (0, 0), length = 0.5)]
#[distance(c2: ground @ (1, 0), p @ (0.5, 0), length = 0.6)]
#[rope(c3: ground @ (0.4, 2), ground @ (0.4, 1), p @ (0.3, 0.3), length = 1.65)]
#[guess(p.x = 0.3, p.y = 0.4, p.phi = 0.1)]
struct OnRope;

/// The same with a third leg.
#[mechanism]
#[bodies(p)]
#[distance(c1: ground @ (0, 0), p @ (0, 0), length = 0.5)]
#[distance(c2: ground @ (1, 0), p @ (0.5, 0), length = 0.6)]
#[distance(c3: ground @ (0.4, 1), p @ (0.3, 0.3), length = 0.65)]
#[guess(p.x = 0.3, p.y = 0.4, p.phi = 0.1)]
struct OnLegs;

/// A disc as a polar curve, turned by the arm of a roller.
#[mechanism]
#[bodies(disc, arm)]
#[revolute(O: ground @ (0, 0), disc @ (0.1, 0))]
#[revolute(A: ground @ (0.9, 0.2), arm @ (0, 0))]
#[on_curve(contact: disc @ (0, 0), arm @ (0.7, 0), polar(theta) = 0.33)]
#[driver(drive: arm.phi = 3.1 + t)]
#[guess(disc.phi = 0.5)]
struct PolarDisc;

/// The same disc as a circle.
#[mechanism]
#[bodies(disc, arm)]
#[revolute(O: ground @ (0, 0), disc @ (0.1, 0))]
#[revolute(A: ground @ (0.9, 0.2), arm @ (0, 0))]
#[on_curve(contact: disc @ (0, 0), arm @ (0.7, 0), implicit(X, Y) = X*X + Y*Y - 0.33*0.33)]
#[driver(drive: arm.phi = 3.1 + t)]
#[guess(disc.phi = 0.5)]
struct ImplicitDisc;

fn all<M: Kinematics>(mechanism: &M) -> Assemblies {
    let found = mechanism.solver().assemblies(&Instant::at(0.0)).expect("rows have enclosures");
    assert!(found.is_complete(), "{found}");
    found
}

/// The value of a row excludes the place where a length is 0.
#[test]
fn lengths_that_may_vanish_hide_no_closure() {
    for (found, expected) in [(all(&OnRope), all(&OnLegs)), (all(&PolarDisc), all(&ImplicitDisc))] {
        assert!(!expected.found.is_empty(), "{expected}");
        assert_eq!(found.found.len(), expected.found.len(), "{found}, {expected}");
        for of_legs in &expected.found {
            let same = |q: &[f64]| q.iter().zip(&of_legs.q).all(|(a, b)| (a - b).abs() < 1e-12);
            assert!(found.found.iter().any(|closure| same(&closure.q)), "{found}, {expected}");
        }
    }
}
