//! How far mechanisms move, against what is known of them.

use kin_runtime::planned::LimitKind;
use kin_runtime::{Instant, Kinematics, Ranges, mechanism};
use std::f64::consts::{PI, TAU};

/// A four-bar on the x axis.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(C: ground @ (d, 0), rocker @ (0, 0))]
#[driver(drive: crank.phi = t)]
struct FourBar {
    #[param(0.3)]
    a: f64,
    #[param(0.25)]
    b: f64,
    #[param(0.2)]
    c: f64,
    #[param(0.5)]
    d: f64,
}

impl FourBar {
    /// The crank angles in [0, π] at which coupler and rocker are in line, from the cosine theorem: stretched or folded.
    fn dead_centres(&self) -> Vec<f64> {
        let Self { a, b, c, d } = *self;
        let cosine = |r: f64| (a * a + d * d - r * r) / (2.0 * a * d);
        let angles = [b + c, b - c].into_iter().map(cosine).filter(|cosine| cosine.abs() < 1.0).map(f64::acos);
        let mut angles: Vec<f64> = angles.collect();
        angles.sort_by(f64::total_cmp);
        angles
    }

    fn ranges(&self, from: f64, to: f64) -> Ranges {
        self.solver().ranges(&Instant::at(from), to).unwrap()
    }
}

/// Deterministic numbers in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Over a full turn, which begins between limits: as many dead centres as the cosine theorem says, each where it says, and
/// none for a crank that turns by Grashof's rule.
#[test]
fn dead_centres_of_random_four_bars_are_those_of_the_cosine_theorem() {
    let count = if cfg!(debug_assertions) { 12 } else { 10_000 };
    let mut draw = Draw(7);
    let (mut turning, mut rocking) = (0, 0);
    for _ in 0..count {
        let [a, b, c, d] = [(); 4].map(|()| 0.2 + draw.unit());
        let bar = FourBar { a, b, c, d };
        let expected = bar.dead_centres();
        let mut sides = [a, b, c, d];
        sides.sort_by(f64::total_cmp);
        let longest_reaches = sides[3] < sides[0] + sides[1] + sides[2];
        // Too near to a change point, or to a limit at 0 or π.
        let margin = sides[0] + sides[3] - sides[1] - sides[2];
        let near = |x: f64| expected.iter().any(|phi| (phi - x).abs() < 1e-3);
        if margin.abs() < 1e-3 || near(0.0) || near(PI) {
            continue;
        }
        let all = bar.ranges(-1e-4, TAU - 1e-4);
        assert!(all.is_complete(), "{a} {b} {c} {d}: {all}");
        // Grashof: the crank turns where it, or the ground, is the shortest link.
        let turns = margin < 0.0 && (sides[0] == a || sides[0] == d);
        if longest_reaches {
            assert_eq!(turns, expected.is_empty() && !all.ranges.is_empty(), "{a} {b} {c} {d}");
        }
        // Above and below the axis, in each of two modes.
        assert_eq!(all.limits.len(), 4 * expected.len(), "{a} {b} {c} {d}: {all}");
        for limit in &all.limits {
            let phi = limit.t.midpoint();
            let folded = if phi > PI { TAU - phi } else { phi };
            assert!(expected.iter().any(|x| (x - folded).abs() < 1e-9), "{phi} {expected:?}");
            assert_eq!(
                (limit.kind, limit.joints.as_slice()),
                (Some(LimitKind::DeadCentre), ["A", "B", "C"].as_slice())
            );
            assert_eq!(limit.drivers[0].0, "drive");
            // Where the motion towards the limit found it, the pins are in line there.
            if let [.., x, y, _] = limit.q.as_slice() {
                let place = [a * phi.cos(), a * phi.sin()];
                let pin = [limit.q[3] + b * limit.q[5].cos(), limit.q[4] + b * limit.q[5].sin()];
                let across = (pin[0] - place[0]) * (y - place[1]) - (pin[1] - place[1]) * (x - place[0]);
                assert!(across.abs() < 1e-8, "{across}");
            }
        }
        let circuits: usize = if expected.is_empty() { all.ranges.len() } else { all.circuits };
        assert!(circuits <= all.ranges.len(), "{all}");
        if turns { turning += 1 } else { rocking += 1 }
    }
    assert!(turning >= count / 10 && rocking > count / 10, "{turning} {rocking}");
}

#[test]
fn ranges_that_meet_at_a_dead_centre_are_one_circuit() {
    // The crank rocks between two dead centres; both modes are one motion there and back.
    let bar = FourBar::default();
    let end = bar.dead_centres()[0];
    let all = bar.ranges(-PI, PI);
    assert!(all.is_complete());
    let within = |x: f64, y: f64| (x - y).abs() < 1e-9;
    assert_eq!((all.ranges.len(), all.circuits), (2, 1), "{all}");
    assert!(all.ranges.iter().all(|range| within(range.from, -end) && within(range.to, end)), "{all}");
    assert!(all.limits.iter().all(|limit| limit.proven && limit.q.len() == 9), "{all}");

    // A crank that turns: two circuits, which no motion connects.
    let turning = FourBar { a: 0.1, b: 0.4, c: 0.3, d: 0.4 };
    let all = turning.ranges(0.0, TAU);
    assert!(all.is_complete() && all.limits.is_empty());
    assert_eq!((all.ranges.len(), all.circuits), (2, 2), "{all}");
    assert!(all.ranges.iter().all(|range| range.from == 0.0 && range.to == TAU), "{all}");

    // A parallelogram crosses its other branch where it is flat: nothing proves that it goes on there.
    let flat = FourBar { a: 0.2, b: 0.5, c: 0.2, d: 0.5 };
    let all = flat.ranges(-1.0, 1.0);
    assert!(!all.is_complete(), "{all}");
    assert!(all.limits.iter().all(|limit| limit.t.contains(0.0) && limit.t.radius() < 1e-4 && !limit.proven), "{all}");
}
