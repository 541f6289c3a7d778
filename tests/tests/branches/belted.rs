//! An arm that carries a belted fore arm, solved by an iteration whose margin is several times larger than its branch
//! value near a dead centre.

use kin_runtime::{Instant, Kinematics, Planned, mechanism};

#[mechanism]
#[body(arm, x = 0, y = 0)]
#[bodies(fore, link)]
#[body(wheel, x = 0, y = 0)]
#[body(rocker, x = d, y = 0)]
#[revolute(A: arm @ (a, 0), fore @ (0, 0))]
#[belt(bb: wheel, fore, radii = (n1, n2), carrier = arm, offset = off)]
#[gear(gg: wheel, rocker, radii = (m1, m2), offset = off2)]
#[revolute(B: fore @ (b, 0), link @ (0, 0))]
#[revolute(C: link @ (l, 0), rocker @ (f, 0))]
#[driver(drive: wheel.phi = start + t)]
#[derive(Clone, Debug)]
struct Belted {
    d: f64,
    a: f64,
    b: f64,
    l: f64,
    f: f64,
    n1: f64,
    n2: f64,
    m1: f64,
    m2: f64,
    off: f64,
    off2: f64,
    start: f64,
}

impl Belted {
    /// The square of the distance that the link has to span, minus that of its length, where the arm has an angle.
    fn gap(&self, arm: f64, t: f64) -> f64 {
        let wheel = self.start + t;
        let fore = (self.n1 * (wheel - arm) - self.off) / self.n2 + arm;
        let rocker = (self.off2 - self.m1 * wheel) / self.m2;
        let x = self.d + self.f * rocker.cos() - self.a * arm.cos() - self.b * fore.cos();
        let y = self.f * rocker.sin() - self.a * arm.sin() - self.b * fore.sin();
        x * x + y * y - self.l * self.l
    }

    /// The extreme of the gap over angles of the arm beside the dead centre.
    fn extreme(&self, t: f64) -> f64 {
        let slope = |arm: f64| self.gap(arm + 1e-4, t) - self.gap(arm - 1e-4, t);
        let (mut low, mut high) = (3.45, 3.57);
        let rises = slope(low) > 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (slope(middle) > 0.0) == rises { low = middle } else { high = middle }
        }
        self.gap(0.5 * (low + high), t)
    }
}

#[test]
fn the_dead_centre_of_a_belted_arm_is_located() {
    let belted = Belted {
        d: 0.8720149642947115,
        a: 0.21194555090598938,
        b: 0.4046903331604249,
        l: 0.8247161833715378,
        f: 0.22021925781476748,
        n1: 4.0,
        n2: 1.0,
        m1: 2.0,
        m2: -2.0,
        off: 16.1780672490044,
        off2: 2.2932543812880457,
        start: 2.404670146783337,
    };
    let (mut before, mut behind) = (4.2, 4.28);
    let closes = belted.extreme(before) > 0.0;
    assert!((belted.extreme(behind) > 0.0) != closes);
    for _ in 0..60 {
        let middle = 0.5 * (before + behind);
        if (belted.extreme(middle) > 0.0) == closes { before = middle } else { behind = middle }
    }
    assert!((before - 4.2449).abs() < 1e-4, "{before}");

    let times: Vec<f64> = (0..=8).map(|k| 0.5680431399987341 * f64::from(k)).collect();
    // The angles of the arm, the fore arm and the link.
    let solver = belted.solver().with_guess(0, -2.454681269584786).with_guess(3, 0.804657146883307);
    let solver = solver.with_guess(6, 0.06348886845095561);
    let first = solver.state(&Instant::at(0.0)).expect("it closes at its guess");
    assert!(belted.gap(first.q[0], 0.0).abs() < 1e-9);
    let ended = solver.sweep(&times).expect_err("it ends at a dead centre");
    assert_eq!(8, ended.trajectory.states.len());
    let mut planned = Planned::new(&belted, &Instant::at(0.0), &first.q).expect("it closes");
    let refused = times.iter().find_map(|&t| planned.at(&Instant::at(t)).err()).expect("it ends at a dead centre");
    let by_plan = refused.limit().and_then(|limit| limit.located).expect("the limit is located");
    let text = ended.to_string();
    let by_sweep = ended.source.limit().and_then(|limit| limit.located).expect("the limit is located");
    for located in [by_plan.at, by_sweep.at] {
        assert!((located - before).abs() < 1e-7, "{located} instead of {before}: {text}");
    }
}

/// A plate that is lifted by a cam whose angle is the unknown, up to the highest place of the cam. All terms of the cam's
/// equation vanish there together, so that its branch value is about 1 up to the limit.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(plate, x = 0, phi = 0)]
#[flat_follower(contact: cam @ (0, 0), plate @ (0, 0), axis = (1, 0), support(theta) = r + e*cos(theta) + a*cos(2*theta))]
#[driver(lift: plate.y = start + 0.3*t)]
#[derive(Clone, Debug)]
struct Lifted {
    r: f64,
    e: f64,
    a: f64,
    start: f64,
}

#[test]
fn the_highest_place_of_a_cam_is_located() {
    let lifted = Lifted { r: 1.0, e: 0.2, a: 0.03, start: 1.0 + 0.2 * 1.0_f64.cos() + 0.03 * 2.0_f64.cos() };
    let top = (1.23 - lifted.start) / 0.3;
    let first = [1.0, -1.0].into_iter().flat_map(|side| [0.5, 1.5, 2.5].map(|shift| side * shift)).find_map(|guess| {
        let solver = lifted.solver().with_guess(0, guess);
        solver.state(&Instant::at(0.0)).ok().filter(|state| state.q_dot[0].abs() > 0.1)
    });
    let first = first.expect("it closes");
    for end in [0.7617, 0.46, 2.0] {
        let mut planned = Planned::new(&lifted, &Instant::at(0.0), &first.q).expect("it closes");
        let refused = planned.at(&Instant::at(end)).expect_err("it cannot be lifted farther");
        let located = refused.limit().and_then(|limit| limit.located).expect("the limit is located");
        assert!((located.at - top).abs() < 1e-8, "{refused}: {top}");
        assert!(refused.to_string().contains("contact"), "{refused}");
    }
}
