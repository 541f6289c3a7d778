//! Stephenson's third linkage, driven at its last link: two loops share a link with three joints, so that no dyad can be
//! solved first. All closures are listed, with the one from which the dimensions were taken.

use kin_runtime::{Instant, Kinematics, Ranges, Solver, mechanism};

/// The link `plate` has the joints C, D and F.
#[mechanism]
#[bodies(left, right, plate, rod, crank)]
#[revolute(A: ground @ (0, 0), left @ (0, 0))]
#[revolute(B: ground @ (1, 0.2), right @ (0, 0))]
#[revolute(C: left @ (l[0], 0), plate @ (0, 0))]
#[revolute(D: right @ (l[1], 0), plate @ (l[2], 0))]
#[revolute(E: ground @ (0.4, -0.7), crank @ (0, 0))]
#[revolute(F: plate @ (x, y), rod @ (0, 0))]
#[revolute(G: rod @ (l[3], 0), crank @ (l[4], 0))]
#[driver(drive: crank.phi = start + t)]
struct Stephenson {
    l: [f64; 5],
    x: f64,
    y: f64,
    start: f64,
}

/// The same, with its bodies and joints in the opposite order.
#[mechanism]
#[bodies(crank, rod, plate, right, left)]
#[revolute(G: crank @ (l[4], 0), rod @ (l[3], 0))]
#[revolute(F: rod @ (0, 0), plate @ (x, y))]
#[revolute(E: crank @ (0, 0), ground @ (0.4, -0.7))]
#[revolute(D: plate @ (l[2], 0), right @ (l[1], 0))]
#[revolute(C: plate @ (0, 0), left @ (l[0], 0))]
#[revolute(B: right @ (0, 0), ground @ (1, 0.2))]
#[revolute(A: left @ (0, 0), ground @ (0, 0))]
#[driver(drive: crank.phi = start + t)]
struct Opposite {
    l: [f64; 5],
    x: f64,
    y: f64,
    start: f64,
}

/// Length and direction from one point to another.
fn link(from: [f64; 2], to: [f64; 2]) -> (f64, f64) {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    (x.hypot(y), y.atan2(x))
}

/// A number between −1 and 1, always the same for the same k.
fn number(k: usize) -> f64 {
    2.0 * (0.618_033_988_749_895 * k as f64 + 0.3 * (k as f64).sin()).rem_euclid(1.0) - 1.0
}

/// Dimensions with a closure, from the positions of its joints, and the angles of left, right, plate, rod and crank.
fn drawn(number_of: usize) -> ([f64; 5], [f64; 2], [f64; 5]) {
    let point = |k: usize| [number(8 * number_of + 2 * k), number(8 * number_of + 2 * k + 1)];
    let [c, d, f, g] = [0, 1, 2, 3].map(point);
    let [left, right, plate, rod, crank] =
        [link([0.0, 0.0], c), link([1.0, 0.2], d), link(c, d), link(f, g), link([0.4, -0.7], g)];
    let (x, y) = (f[0] - c[0], f[1] - c[1]);
    let (sin, cos) = plate.1.sin_cos();
    let lengths = [left.0, right.0, plate.0, rod.0, crank.0];
    (lengths, [cos * x + sin * y, cos * y - sin * x], [left.1, right.1, plate.1, rod.1, crank.1])
}

/// Compares the list of closures with the closure that is known; `order` has the index in q of each angle.
fn has_the_known_closure<M: kin_runtime::Mechanism>(
    solver: &Solver<'_, M>,
    angles: [f64; 5],
    order: [usize; 5],
) -> usize {
    let all = solver.assemblies(&Instant::at(0.0)).unwrap();
    if !all.is_complete() {
        return 0;
    }
    let same = |a: f64, b: f64| (a - b).sin().abs() < 1e-7 && (a - b).cos() > 0.0;
    let known = |q: &[f64]| order.iter().zip(angles).all(|(&k, angle)| same(q[k], angle));
    assert_eq!(1, all.found.iter().filter(|closure| known(&closure.q)).count(), "{angles:?}: {all}");
    assert!(all.found.len().is_multiple_of(2) && all.found.iter().all(|closure| closure.certificate.is_ok()), "{all}");
    all.found.len()
}

#[test]
fn every_list_of_closures_has_the_known_one() {
    let (mut complete, mut most) = (0, 0);
    for k in 0..12 {
        let (l, [x, y], angles) = drawn(k);
        let start = angles[4];
        let (one, other) = (Stephenson { l, x, y, start }, Opposite { l, x, y, start });
        let counts = [
            has_the_known_closure(&one.solver(), angles, [2, 5, 8, 11, 14]),
            has_the_known_closure(&other.solver(), angles, [14, 11, 8, 5, 2]),
        ];
        assert!(counts[0] == counts[1] || counts.contains(&0), "{counts:?}");
        complete += counts.iter().filter(|count| **count > 0).count();
        most = most.max(counts[0]);
    }
    assert!(complete >= 20 && most >= 4, "{complete} lists are complete, with up to {most} closures");
}

#[test]
fn a_linkage_with_four_closures_has_four_ranges() {
    let linkage = Stephenson { l: [1.0, 1.5, 0.7, 1.6, 1.7], x: 0.5, y: -0.4, start: 1.3 };
    let all = linkage.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && all.found.len() == 4, "{all}");
    let state = linkage.state_at(&Instant::at(0.0)).unwrap();
    assert!(all.found.iter().any(|closure| closure.q.iter().zip(&state.q).all(|(a, b)| (a - b).sin().abs() < 1e-9)));
    let ranges: Ranges = linkage.solver().ranges(&Instant::at(0.0), 0.3).unwrap();
    assert!(ranges.is_complete() && ranges.ranges.len() == 4, "{ranges}");
    // Motions from the four closures end where the ranges do.
    let ends = all.found.iter().map(|closure| {
        let sweep = linkage.solver().sweep_from(&closure.q, &[0.0, 0.3]);
        sweep.map_or_else(|error| error.source.limit().and_then(|limit| limit.at()).expect("a limit"), |_| 0.3)
    });
    let mut ends: Vec<f64> = ends.collect();
    ends.sort_by(f64::total_cmp);
    let [first, second] = &ranges.limits[..] else { panic!("{ranges}") };
    assert!((ends[0] - first.t.midpoint()).abs() < 1e-8 && (ends[1] - second.t.midpoint()).abs() < 1e-8, "{ends:?}");
    assert_eq!([0.3; 2], ends[2..], "{ranges}");
}
