//! Iterations for a single unknown whose coefficient is one term, in which nothing cancels: cams that their followers turn,
//! where it is the slope of the cam, and loads on ropes. Its margin tells how far the dead centre is, as those of other groups
//! do, and the dead centre is located and named.

use core::f64::consts::PI;
use kin_runtime::function::{MotionLaw, Sequence};
use kin_runtime::{Instant, Kinematics, LimitKind, Mechanism, mechanism};

/// A follower that turns a cam with one bell-shaped lobe up to its top.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(follower, x = 0, phi = 0)]
#[constraint(contact: follower.y = 1 + h * exp(-cam.phi * cam.phi))]
#[driver(lift: follower.y = 1 + h * (0.5 + 0.1 * t))]
#[guess(cam.phi = 0.8)]
struct Bell {
    h: f64,
}

/// The same with a cam from a table.
#[mechanism]
#[body(cam, x = 0, y = 0)]
#[body(follower, x = 0, phi = 0)]
#[function(lift)]
#[constraint(contact: follower.y = 1 + lift(cam.phi))]
#[driver(drive: follower.y = 1 + 0.1 * t)]
#[guess(cam.phi = 0.3)]
struct Table {
    lift: Sequence,
}

/// A load that is hauled along a vertical guide, x beside the drum of the rope, to the height of the drum. The rope is a
/// formula with a part of the constant length c, which is solved by iteration.
#[mechanism]
#[body(load, x = x * s, phi = 0)]
#[constraint(R: distance(ground @ (0, 0), load @ (0, 0)) + c * s = s * (1 - 0.1 * t + c))]
#[guess(load.y = -s)]
struct Hauled {
    s: f64,
    x: f64,
    c: f64,
}

/// A scalar on a bell-shaped hill, up to its top.
#[mechanism]
#[coordinates(u)]
#[driver(lift: exp(-u * u / (s * s)) = 0.5 + 0.1 * t)]
#[guess(u = 0.8 * s)]
struct Hill {
    s: f64,
}

fn ends_at_its_dead_centre<M: Mechanism>(mechanism: &M, what: &str) {
    let mut planned = mechanism.solver().planned(&Instant::at(0.0)).expect("it closes");
    let mut margin =
        |t: f64| planned.at(&Instant::at(t)).unwrap_or_else(|error| panic!("{what}, {t}: {error}")).margins()[0];
    let margins = [0.0, 4.0, 4.9, 4.99, 4.999, 4.9999, 4.999_99].map(&mut margin);
    assert!(margins[0] > 0.1, "{what}: {margins:?}");
    // The margin is proportional to the time that is left.
    for pair in margins[3..].windows(2) {
        assert!((pair[0] / pair[1] - 10.0).abs() < 0.5, "{what}: {margins:?}");
    }
    for times in [vec![0.0, 3.0, 6.0], vec![0.0, 5.0, 6.0], (0..=60).map(|k| 0.1 * f64::from(k)).collect()] {
        let error = mechanism.solver().sweep(&times).expect_err("it ends");
        let limit = error.source.limit().expect("a limit");
        assert_eq!(limit.kind(), Some(LimitKind::DeadCentre), "{what}: {error}");
        assert!(limit.at().is_some_and(|t| (t - 5.0).abs() < 1e-9), "{what}: {error}");
    }
}

#[test]
fn loads_and_scalars_end_at_their_dead_centres_in_every_unit() {
    for s in [1.0, 1e-3, 1e3, 1e6] {
        ends_at_its_dead_centre(&Hauled { s, x: 0.5, c: 0.0 }, "rope");
        ends_at_its_dead_centre(&Hill { s }, "hill");
    }
}

/// Where the only coordinate vanishes at the limit, and no joint tells how large the mechanism is.
#[test]
fn a_load_at_the_height_of_its_drum_is_at_a_dead_centre() {
    for s in [1.0, 1e-3, 1e4] {
        for k in 0..30 {
            let hauled = Hauled { s, x: 0.2 + 0.02 * f64::from(k), c: 0.1 * f64::from(k) };
            let end = 10.0 * (1.0 - hauled.x);
            for before in [0.1, 1e-2, 1e-3, 1e-4] {
                let state =
                    hauled.state_at(&Instant::at(end - before)).unwrap_or_else(|error| panic!("{s} {k}: {error}"));
                let length = hauled.x + 0.1 * before;
                let y = -(length * length - hauled.x * hauled.x).sqrt();
                assert!((state.q[0] / s - y).abs() < 1e-9, "{s} {k} {before}: {} {y}", state.q[0] / s);
            }
            let error = hauled.solver().sweep(&[0.0, 0.7 * end, end + 1.0]).expect_err("it ends");
            let limit = error.source.limit().expect("a limit");
            assert_eq!(limit.kind(), Some(LimitKind::DeadCentre), "{s} {k}: {error}");
            assert!(limit.at().is_some_and(|t| (t - end).abs() < 1e-13), "{s} {k}: {error}");
        }
    }
}

#[test]
fn the_margin_of_a_slope_falls_towards_its_dead_centre() {
    for h in [1.0, 1e-3, 1e3] {
        let bell = Bell { h };
        let mut planned = bell.solver().planned(&Instant::at(0.0)).expect("it closes");
        for t in [0.0_f64, 2.0, 4.0, 4.9, 4.99, 4.9999, 4.999_999] {
            let phi = (-(0.5 + 0.1 * t).ln()).sqrt();
            let margins = planned.at(&Instant::at(t)).unwrap_or_else(|error| panic!("{t}: {error}")).margins();
            // f′/f″ in radians.
            let away: f64 = 2.0 * phi / (4.0 * phi * phi - 2.0);
            let expected = (away * away).min(1.0);
            assert!((margins[0] - expected).abs() <= 1e-5 * expected, "{h}, {t}: {margins:?} for {expected}");
        }
        let error = planned.at(&Instant::at(6.0)).expect_err("the top is passed");
        let limit = error.limit().expect("a limit");
        assert_eq!(limit.kind(), Some(LimitKind::DeadCentre), "{error}");
        assert!(limit.at().is_some_and(|t| (t - 5.0).abs() < 1e-9), "{error}");
    }
}

#[test]
fn the_top_of_a_cam_from_a_table_is_a_dead_centre() {
    let lift = Sequence::starting_at(0.0, 0.0).rise(MotionLaw::Harmonic, 0.5, PI).fall(MotionLaw::Harmonic, 0.5, PI);
    let table = Table { lift: lift.build().expect("a sequence") };
    let times: Vec<f64> = (0..=60).map(|k| 0.1 + 0.1 * f64::from(k)).collect();
    let error = table.solver().sweep(&times).expect_err("the top is passed");
    let limit = error.source.limit().expect("a limit");
    assert_eq!(limit.kind(), Some(LimitKind::DeadCentre), "{error}");
    assert!(limit.at().is_some_and(|t| (t - 5.0).abs() < 1e-9), "{error}");
    assert_eq!(error.trajectory.states.len(), 49);
}
