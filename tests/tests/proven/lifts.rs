//! Sweeps along the arc of scissor lifts, whose stages reach their limits all at once.

use kin_runtime::{ArcEnd, ArcPlaceKind, Kinematics, Options, mechanism};

/// A scissor lift of two stages. At t = 10 its arms lie flat, at t = −90 they stand upright, one on the other; each stage
/// could go on to either side.
#[mechanism]
#[bodies(left[2], right[2])]
#[body(nut, y = 0, phi = 0)]
#[revolute(foot: ground @ (0, 0), left[0] @ (0, 0))]
#[revolute(slide: nut @ (0, 0), right[0] @ (0, 0))]
#[revolute(middle[i in 0..2]: left[i] @ (1, 0), right[i] @ (1, 0))]
#[revolute(a: left[0] @ (2, 0), right[1] @ (0, 0))]
#[revolute(b: right[0] @ (2, 0), left[1] @ (0, 0))]
#[driver(push: nut.x = 1.8 + 0.02 * t)]
#[guess(left[i in 0..2].phi = 0.4, right[i in 0..2].phi = 2.7)]
struct Lift;

/// The determinant changes its sign twice where two groups cross their limits together.
#[test]
fn an_arc_ends_where_two_groups_cross_at_once() {
    for use_plan in [true, false] {
        let solver = Lift.solver().with_options(Options { use_plan, ..Options::default() });
        let swept = solver.sweep_along_arc(0.0, None, 20).expect("an arc");
        let found = swept.arc.as_ref().expect("it went along the arc");
        assert_eq!([ArcEnd::BranchPoint; 2], found.ends, "{found}");
        let places: Vec<(ArcPlaceKind, f64)> = found.places.iter().map(|place| (place.kind, place.t)).collect();
        let [(ArcPlaceKind::BranchPoint, upright), (ArcPlaceKind::BranchPoint, flat)] = places[..] else {
            panic!("{found}")
        };
        assert!((upright + 90.0).abs() < 1e-4 && (flat - 10.0).abs() < 1e-4, "{found}");
        // Within the arc the first stage stands on the side of its guess.
        assert!(swept.states.iter().all(|state| state.q[2] > -1e-3 && state.q[2] < 1.58), "{found}");
    }
}

/// Two arms on cylinders of the same length, which have dead centres of their own.
#[mechanism]
#[body(a, x = 0, y = 0)]
#[body(b, x = 0, y = 5)]
#[distance(first: ground @ (d1, 0), a @ (a1, 0), length = base + t)]
#[distance(second: ground @ (d2, 5), b @ (a2, 0), length = base + t)]
#[guess(a.phi = g1, b.phi = g2)]
struct Twin {
    a1: f64,
    d1: f64,
    a2: f64,
    d2: f64,
    base: f64,
    g1: f64,
    g2: f64,
}

#[test]
fn a_closed_arc_from_a_dead_centre_lists_it_once() {
    let twin = Twin {
        a1: 0.7381396443196653,
        d1: 1.4879941956600018,
        a2: 0.5443761320902166,
        d2: 1.6817326452267674,
        base: 1.2049551895063872,
        g1: -3.1315132468713496,
        g2: -std::f64::consts::PI,
    };
    let swept = twin.solver().sweep_along_arc(1.0211535878105968, None, 20).expect("an arc");
    let found = swept.arc.as_ref().expect("it went along the arc");
    // Stretched and folded.
    assert!(found.is_closed() && found.places.len() == 2, "{found}");
}

/// A scissor jack: a screw draws its knees together. At t = −5 all four arms lie flat, and the screw can turn no further
/// back; there branches cross, too, as either pair of arms could tilt.
#[mechanism]
#[body(ll, x = -20, y = 0)]
#[body(lr, x = 20, y = 0)]
#[bodies(ul, ur)]
#[body(top, x = 0, phi = 0)]
#[revolute(kl: ll @ (150, 0), ul @ (0, 0))]
#[revolute(kr: lr @ (150, 0), ur @ (0, 0))]
#[revolute(tl: ul @ (150, 0), top @ (-20, 0))]
#[revolute(tr: ur @ (150, 0), top @ (20, 0))]
#[constraint(thread: distance(ll @ (150, 0), lr @ (150, 0)) = 300 - 8 * t)]
#[guess(ll.phi = 2.6, lr.phi = 0.5, ul.phi = 0.5, ur.phi = 2.6, top.y = 150)]
struct Jack;

#[test]
fn an_arc_reports_a_dead_centre_at_which_branches_cross() {
    let swept = Jack.solver().sweep_along_arc(0.0, None, 40).expect("an arc");
    let places = &swept.arc.as_ref().expect("it went along the arc").places;
    let turning: Vec<_> = places.iter().filter(|place| place.kind == ArcPlaceKind::DeadCentre).collect();
    assert!(turning.len() == 1 && (turning[0].t + 5.0).abs() < 1e-6, "{places:?}");
}
