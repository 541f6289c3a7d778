//! Iterations on more than three unknowns: rods between bodies that no other joint carries. Wherever such a mechanism
//! is, and in whatever unit of length, its motion is the same.

use kin_runtime::plan::{Depth, Solved};
use kin_runtime::{Instant, Kinematics, Mechanism, Options, mechanism};

/// A crank, two platforms and six rods at (x, y), all lengths multiplied by a scale.
#[mechanism]
#[bodies(crank, first, second)]
#[revolute(O: ground @ (x, y), crank @ (0, 0))]
#[distance(r0: crank @ (0.3 * s, 0), first @ (-0.5 * s, -0.3 * s), length = 0.8 * s)]
#[distance(r1: ground @ (x - s, y + 0.9 * s), first @ (-0.4 * s, 0.4 * s), length = 0.7 * s)]
#[distance(r2: first @ (0.5 * s, -0.3 * s), second @ (-0.5 * s, -0.4 * s), length = 0.9 * s)]
#[distance(r3: first @ (0.4 * s, 0.5 * s), second @ (-0.4 * s, 0.4 * s), length = 0.7 * s)]
#[distance(r4: ground @ (x + 2.2 * s, y - 0.5 * s), second @ (0.4 * s, -0.3 * s), length = 0.9 * s)]
#[distance(r5: ground @ (x + 2.5 * s, y + 1.3 * s), second @ (0.5 * s, 0.4 * s), length = 0.8 * s)]
#[driver(drive: crank.phi = 1.2 + t)]
#[guess(crank.phi = 1.2, first.x = x, first.y = y + 0.8 * s, first.phi = -0.2)]
#[guess(second.x = x + 1.4 * s, second.y = y + 0.5 * s, second.phi = 0.4)]
struct SixRods {
    x: f64,
    y: f64,
    s: f64,
}

#[test]
fn a_mechanism_is_followed_wherever_it_is() {
    let times: Vec<f64> = (0..=20).map(|k| 0.02 * f64::from(k)).collect();
    let here = SixRods { x: 0.0, y: 0.0, s: 1.0 };
    let here = here.solver().planned(&Instant::at(0.0)).expect("it closes");
    let (q, margin) = (here.q(), here.margins()[0]);
    assert!(margin > 1e-2, "{margin}");
    for (x, y, s) in
        [(10.0, 10.0, 1.0), (-300.0, 1000.0, 1.0), (0.0, 0.0, 1000.0), (4e4, -4e4, 1000.0), (0.0, 2.0, 1e-3)]
    {
        let moved = SixRods { x, y, s };
        let solver = moved.solver();
        let mut planned = solver.planned(&Instant::at(0.0)).expect("it closes there, too");
        let found = planned.margins()[0];
        assert!((found - margin).abs() < 1e-6 * margin, "{x} {y} {s}: {found} instead of {margin}");
        let size = x.abs().max(y.abs()).max(s);
        for (k, (found, q)) in planned.q().iter().zip(q).enumerate() {
            let expected = [x + s * q, y + s * q, *q][k % 3];
            assert!((found - expected).abs() < 1e-11 * size.max(1.0), "{x} {y} {s}: {k}");
        }
        let swept = solver.sweep(&times).unwrap_or_else(|error| panic!("{x} {y} {s}: {}", error.source));
        let newton = moved.solver().with_options(Options { use_plan: false, ..Options::default() });
        let expected = newton.sweep(&times).unwrap_or_else(|error| panic!("{x} {y} {s}: {}", error.source));
        for (found, expected) in swept.iter().zip(expected.iter()) {
            planned.at(&Instant::at(found.t)).expect("the plan follows");
            let same = |q: &[f64]| q.iter().zip(&expected.q).all(|(a, b)| (a - b).abs() < 1e-10 * size.max(1.0));
            assert!(same(&found.q) && same(planned.q()), "{x} {y} {s}: t = {}", found.t);
        }
    }
}

/// The squared norms of the rows are far beyond the range of `f32` when they are multiplied.
#[test]
fn margins_in_single_precision_are_those_in_double() {
    for s in [1e-3, 1.0, 1e3] {
        let rods = SixRods { x: 0.0, y: 0.0, s };
        let planned = rods.solver().planned(&Instant::at(0.0)).expect("it closes");
        let parameters = [0.0, 0.0, s as f32];
        let start: Vec<f32> = planned.q().iter().map(|q| *q as f32).collect();
        let ([mut q, mut q_dot, mut q_ddot], mut margins) = ([[0.0_f32; 9]; 3], [0.0_f32; 9]);
        let count = SixRods::model().plan.margins;
        let solved = Solved { q: &mut q, q_dot: &mut q_dot, q_ddot: &mut q_ddot, margins: &mut margins[..count] };
        let at = Instant { t: 0.0_f32, inputs: &[] };
        rods.solve_with(&parameters, &at, &[], &start, Depth::Acceleration, solved).expect("lengths agree");
        for (found, expected) in margins[..count].iter().zip(planned.margins()) {
            assert!((f64::from(*found) - expected).abs() < 1e-2 * expected, "{s}: {found} instead of {expected}");
        }
        for (found, expected) in q_dot.iter().zip(planned.q_dot()) {
            assert!((f64::from(*found) - expected).abs() < 1e-3 * s.max(1.0), "{s}: {found} instead of {expected}");
        }
    }
}

/// A crank that moves two pinned platforms by four rods.
#[mechanism]
#[bodies(crank, first, second)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[distance(r0: crank @ (0.492961, 0), first @ (0.395024, -0.353553), length = 0.699838)]
#[distance(r1: ground @ (-1.345590, 0.293530), first @ (-0.439459, 0.206912), length = 0.413166)]
#[revolute(C: first @ (0.493461, 0.725393), second @ (0, 0))]
#[distance(r2: ground @ (-1.171779, 1.319201), second @ (1.009452, 0.089570), length = 1.184066)]
#[distance(r3: ground @ (-1.874789, 0.860071), second @ (-0.240337, 0.351634), length = 0.473152)]
#[driver(drive: crank.phi = 0.426482 - 0.58567 * t)]
#[guess(crank.phi = 2.13, first.x = -0.653, first.y = 0.821, first.phi = 1.322)]
#[guess(second.x = -1.234, second.y = 1.478, second.phi = 1.89)]
struct FourRods;

/// Whether an instant falls just before the dead centre or not, the motion ends at the same one.
#[test]
fn a_dead_centre_is_the_same_for_every_grid() {
    let solver = FourRods.solver();
    let (start, beyond) = (-2.9, -2.6);
    let mut ends = Vec::new();
    for count in [1_u32, 3, 10, 29, 30, 31, 60, 61, 100, 300] {
        let times: Vec<f64> = (0..=count).map(|k| start + (beyond - start) * f64::from(k) / f64::from(count)).collect();
        let error = solver.sweep(&times).expect_err("a dead centre").source;
        let limit = error.limit().unwrap_or_else(|| panic!("{count}: {error}"));
        ends.push(limit.at().expect("it is located"));
        let mut planned = solver.planned(&Instant::at(start)).expect("it closes");
        let refused = times[1..].iter().find_map(|&t| planned.at(&Instant::at(t)).err()).expect("a dead centre");
        ends.push(refused.limit().and_then(|limit| limit.at()).expect("it is located"));
    }
    assert!(ends.iter().all(|end| (end - ends[0]).abs() < 1e-9), "{ends:?}");
}
