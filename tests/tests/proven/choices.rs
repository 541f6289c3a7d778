//! Mechanisms whose closures are not distinguished by the signs of their plan: with angles that occur only as a
//! multiple, and with bodies that turn in a ratio to others.

use super::ranges::closures;
use kin_runtime::{Assemblies, Instant, Kinematics, Ranges, Signal, mechanism};
use std::f64::consts::{PI, TAU};

/// An angle that occurs as its multiple only.
#[mechanism]
#[bodies(a)]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[constraint(double: cos(2*a.phi) = 0.3 + 0.5*t)]
struct Double;

/// A wheel that turns half as fast as the rocker of a four-bar, the other way round, and holds a dyad.
#[mechanism]
#[bodies(crank, coupler, rocker, wheel, rod, lever)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.4, 0), rocker @ (0.3, 0))]
#[revolute(C: ground @ (0.4, 0), rocker @ (0, 0))]
#[revolute(W: ground @ (0.7, 0), wheel @ (0, 0))]
#[constraint(gears: 2*wheel.phi + rocker.phi = 0)]
#[revolute(D: wheel @ (0.1, 0), rod @ (0, 0))]
#[revolute(E: rod @ (0.3, 0), lever @ (0.3, 0))]
#[revolute(F: ground @ (1, 0.1), lever @ (0, 0))]
#[driver(drive: crank.phi = 1 + t)]
struct Geared;

/// The angles of the rocker.
fn rockers(t: f64) -> [f64; 2] {
    let (x, y) = (0.1 * (1.0 + t).cos() - 0.4, 0.1 * (1.0 + t).sin());
    let square = x * x + y * y;
    let half = ((0.09 + square - 0.16) / (0.6 * square.sqrt())).acos();
    [y.atan2(x) + half, y.atan2(x) - half]
}

/// A rack whose pinion is the rocker of a dyad.
#[mechanism]
#[bodies(rod, pinion, rack)]
#[revolute(A: ground @ (0.1, 0.1), rod @ (0, 0))]
#[revolute(B: rod @ (0.4, 0), pinion @ (0.3, 0))]
#[revolute(C: ground @ (0.5, 0), pinion @ (0, 0))]
#[translational(guide: ground @ (0, -0.05), rack @ (0, 0), axis = (1, 0))]
#[constraint(teeth: rack.x - 0.05*pinion.phi = 0.01*t)]
struct Rack;

fn same(a: f64, b: f64) -> bool {
    (((a - b) / TAU).round() * TAU + b - a).abs() < 1e-9
}

fn is_proven(all: &Assemblies) -> bool {
    all.is_complete() && all.found.iter().all(|closure| closure.certificate.is_ok())
}

#[test]
fn an_angle_that_occurs_doubled_has_all_of_its_directions() {
    let all = Double.solver().assemblies(&Instant::at(0.0)).unwrap();
    let half = 0.5 * 0.3_f64.acos();
    let expected = [half, -half, PI - half, half - PI];
    assert!(is_proven(&all) && all.found.len() == expected.len(), "{all}");
    for angle in expected {
        assert_eq!(all.found.iter().filter(|closure| same(closure.q[2], angle)).count(), 1, "{angle}: {all}");
    }
    // At t = 1.4 closures meet in pairs, at 0 and at half a turn.
    let all: Ranges = Double.solver().ranges(&Instant::at(0.0), 2.0).unwrap();
    assert!(all.is_complete(), "{all}");
    assert_eq!([0.1, 1.3, 1.5].map(|t| closures(&all, t)), [4, 4, 0], "{all}");
}

/// A whole turn of the rocker is half a turn of the wheel. The closures with the rocker within half a turn of its guess are listed,
/// and it is said that these are meant; a guess beyond has the others.
#[test]
fn gears_mesh_in_more_ways_than_signs_tell() {
    let wheels = |rocker: f64| {
        let solver = Geared.solver().with_guess(8, rocker);
        let all = solver.assemblies(&Instant::at(0.0)).unwrap();
        assert!(all.is_complete(), "{all}");
        let [(name, within)] = all.searched[..] else { panic!("{all}") };
        assert!(name == "rocker.phi" && same(within.midpoint(), rocker) && within.radius() < 3.2, "{all}");
        let mut expected = Vec::new();
        for angle in rockers(0.0) {
            let angle = angle - ((angle - rocker) / TAU).round() * TAU;
            let (sin, cos) = (-0.5 * angle).sin_cos();
            let distance = (0.3 - 0.1 * cos).hypot(0.1 - 0.1 * sin);
            let count = all.found.iter().filter(|closure| (closure.q[8] - angle).abs() < 1e-9).count();
            assert_eq!(count, if distance < 0.6 { 2 } else { 0 }, "{angle}: {all}");
            expected.push(count);
        }
        assert_eq!(all.found.len(), expected.iter().sum::<usize>(), "{all}");
        // Signs tell these closures apart.
        assert!((0..all.found.len()).all(|k| all.name(k) == all.found[k].name()), "{all}");
        all.found.into_iter().map(|closure| closure.q[11]).collect::<Vec<f64>>()
    };
    let (here, there) = (wheels(0.0), wheels(TAU));
    assert!(!here.is_empty() && !there.is_empty());
    assert!(here.iter().all(|&wheel| there.iter().all(|&other| !same(wheel, other))), "{here:?} {there:?}");
    let all = Geared.solver().ranges(&Instant::at(0.0), 0.1).unwrap();
    assert!(all.searched.iter().any(|(name, _)| *name == "rocker.phi"), "{all}");
}

/// Whole turns of a pinion are places of its rack.
#[test]
fn a_rack_has_a_place_for_every_whole_turn() {
    let all = Rack.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && all.found.len() == 2, "{all}");
    assert_eq!(all.searched.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["pinion.phi"], "{all}");
    for closure in &all.found {
        assert!((closure.q[6] - 0.05 * closure.q[5]).abs() < 1e-12, "{all}");
    }
}

/// A pendulum.
#[mechanism]
#[bodies(bob)]
#[revolute(O: ground @ (0, 0), bob @ (-1, 0))]
struct Pendulum;

/// Where nothing is left to be searched, because the only angle is prescribed, there is one closure.
#[test]
fn a_prescribed_angle_leaves_one_closure() {
    let given = Pendulum.solver().with_given(2, Signal::new(0.3, 1.0, 0.0));
    let all = given.assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && all.found.len() == 1, "{all:?}");
    assert!((all.found[0].q[0] - 0.3_f64.cos()).abs() < 1e-12);
}
