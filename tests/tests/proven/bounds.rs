//! Searches whose bounds closures cross, and coordinates that rows without an enclosure leave determined.

use kin_runtime::{Instant, Kinematics, mechanism};

/// One closure for every t, which is near (u, v) = (t, 2t).
#[mechanism]
#[coordinates(u, v)]
#[constraint(curve: v + 0.3 * sin(u) = 2 * u + 0.1 * sin(v))]
#[driver(drive: v + u = 3 * t)]
struct Curve;

/// Two wheels geared 1 : 2, with a dyad between them, of which a link is driven.
#[mechanism]
#[bodies(a, b, c, d)]
#[revolute(A: ground @ (0, 0), a @ (0, 0))]
#[revolute(B: ground @ (0.5, 0), b @ (0, 0))]
#[revolute(C: a @ (0.35, 0), c @ (0, 0))]
#[revolute(D: b @ (0.35, 0), d @ (0, 0))]
#[revolute(E: c @ (0.6, 0), d @ (0.5, 0))]
#[gear(wheels: a, b, radii = (0.2, 0.1))]
#[driver(drive: c.phi = t)]
struct Geared;

/// A roller on an eccentric cam that turns as far as one likes.
#[mechanism]
#[coordinates(u)]
#[body(cam, x = 0, y = 0)]
#[body(roller, x = 0, phi = 0)]
#[on_curve(
    C: cam @ (0, 0), roller @ (0, 0),
    parametric(u) = (0.015 + 0.04 * cos(u), 0.04 * sin(u)), roller = -0.01
)]
#[driver(turn: cam.phi = t)]
#[guess(roller.y = 0.04, u = pi / 2)]
struct Cam;

/// A beam that a rope holds, which has no enclosure where a piece of it may have no length.
#[mechanism]
#[bodies(beam)]
#[revolute(hinge: ground @ (0, 0), beam @ (0, 0))]
#[rope(tackle: ground @ (0, 1), beam @ (1, 0), ground @ (0.2, 1), length = 2.9 - 0.1 * t)]
#[guess(beam.phi = -0.3)]
struct Crane;

/// A 3-RRR robot, one crank of which turns at the speed w.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (0.5*cos(2*pi*i/3 - 5*pi/6), 0.5*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (0.3, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (0.3, 0), platform @ (0.25*cos(2*pi*i/3 - 5*pi/6), 0.25*sin(2*pi*i/3 - 5*pi/6)))]
#[driver(a: crank[0].phi = 0.9 + w * t)]
#[driver(b: crank[1].phi = 3.1)]
#[driver(c: crank[2].phi = -1.2)]
struct Legs {
    w: f64,
}

/// In how many ranges there is a closure at t, and how many closures there are.
fn counts(mechanism: &impl Kinematics, [from, to]: [f64; 2], parts: usize) -> bool {
    let solver = mechanism.solver();
    let all = solver.ranges(&Instant::at(from), to).expect("ranges");
    for k in 0..=parts {
        let t = from + (to - from) * k as f64 / parts as f64;
        let inside = all.ranges.iter().filter(|range| range.from <= t && t <= range.to).count();
        let closures = solver.assemblies(&Instant::at(t)).expect("closures");
        assert!(closures.is_complete());
        assert_eq!(closures.found.len(), inside, "t = {t}: {all}");
    }
    all.is_complete()
}

/// Closures enter and leave the bounds of the search between dead centres; where they do, nothing is claimed.
#[test]
fn closures_that_cross_the_bounds_of_the_search_are_told() {
    assert!(!counts(&Curve, [1.0, 4.0], 20));
    assert!(!counts(&Curve, [-4.0, 0.0], 20));
    assert!(counts(&Curve, [-1.0, 1.0], 10));
    for start in [-4.0, -3.0, -1.0, 0.0, 1.0, 3.0] {
        counts(&Geared, [start, start + 1.5], 20);
    }
    assert!(counts(&Geared, [-2.0, -0.5], 10));
}

/// The angle of the driver is known, also far from its guess.
#[test]
fn a_driven_angle_is_not_searched_within_bounds() {
    for t in [-5.0, 1.0, 4.2, 7.0] {
        let all = Cam.solver().assemblies(&Instant::at(t)).expect("closures");
        assert!(all.is_complete() && all.found.len() == 2, "t = {t}: {all}");
        assert!(all.searched.iter().all(|(name, _)| *name == "u"), "{all:?}");
    }
    assert!(counts(&Cam, [0.0, 6.3], 10));
}

/// The hinge holds x and y of the beam whatever the rope does.
#[test]
fn a_beam_on_a_rope_has_both_of_its_closures() {
    let all = Crane.solver().assemblies(&Instant::at(1.0)).expect("closures");
    assert_eq!(2, all.found.len(), "{all}");
    let state = Crane.solver().state(&Instant::at(1.0)).expect("a state");
    assert!(all.found.iter().any(|found| (found.q[2] - state.q[2]).abs() < 1e-9), "{all}");
}

/// What moves in a microsecond has the ranges of what moves in a week.
#[test]
fn ranges_do_not_depend_on_the_unit_of_time() {
    for w in [1e-6, 1e6] {
        let all = Legs { w }.solver().ranges(&Instant::at(0.0), 0.2 / w).expect("ranges");
        assert_eq!((all.ranges.len(), all.circuits, all.is_complete()), (6, 4, true), "w = {w}: {all}");
    }
}
