//! When one of several groups reaches its limit, the error names that group, whatever its index among the groups.

use kin_runtime::planned::{LimitKind, Located};
use kin_runtime::{Instant, Kinematics, Mechanism, PlanError, Planned, mechanism};

/// Three four-bars with a driven crank each, all cranks driven alike. The rocker lengths are parameters, so that any of
/// the three four-bars can be the one that reaches its limit.
#[mechanism]
#[bodies(crank[3], coupler[3], rocker[3])]
#[revolute(O[i in 0..3]: ground @ (i, 0), crank[i] @ (0, 0))]
#[revolute(A0: crank[0] @ (0.2, 0), coupler[0] @ (0, 0))]
#[revolute(A1: crank[1] @ (0.2, 0), coupler[1] @ (0, 0))]
#[revolute(A2: crank[2] @ (0.2, 0), coupler[2] @ (0, 0))]
#[revolute(B0: coupler[0] @ (0.5, 0), rocker[0] @ (r0, 0))]
#[revolute(B1: coupler[1] @ (0.5, 0), rocker[1] @ (r1, 0))]
#[revolute(B2: coupler[2] @ (0.5, 0), rocker[2] @ (r2, 0))]
#[revolute(D[i in 0..3]: ground @ (i + 0.5, 0), rocker[i] @ (0, 0))]
#[driver(drive[i in 0..3]: crank[i].phi = begun + pace * t)]
struct Bars {
    #[param(0.3)]
    r0: f64,
    #[param(0.3)]
    r1: f64,
    #[param(0.3)]
    r2: f64,
    #[param(-0.5)]
    begun: f64,
    #[param(1.0)]
    pace: f64,
}

/// Three four-bars of which `odd` has a rocker of the length `rocker`; the other two can make full turns of their
/// cranks.
fn bars(odd: usize, rocker: f64, begun: f64, pace: f64) -> Bars {
    let r = |k: usize| if k == odd { rocker } else { 0.3 };
    Bars { r0: r(0), r1: r(1), r2: r(2), begun, pace }
}

/// A start vector with the coupler and rocker angles of the closed four-bars at the initial crank angle, each rocker
/// pin on the same side of the line from its pivot to the coupler.
fn start(bars: &Bars) -> Vec<f64> {
    let model = Bars::model();
    let (crank, mut q) = (bars.begun, vec![0.0; Bars::COORDINATES]);
    for (k, rocker) in [bars.r0, bars.r1, bars.r2].into_iter().enumerate() {
        let a = [0.2 * crank.cos(), 0.2 * crank.sin()];
        let way = [0.5 - a[0], -a[1]];
        let square = way[0] * way[0] + way[1] * way[1];
        let along = (square + 0.25 - rocker * rocker) / (2.0 * square);
        let across = (0.25 / square - along * along).max(0.0).sqrt() * -crank.signum();
        let b = [a[0] + along * way[0] + across * way[1], a[1] + along * way[1] - across * way[0]];
        let coupler = (b[1] - a[1]).atan2(b[0] - a[0]);
        let turned = b[1].atan2(b[0] - 0.5);
        let first = k as f64;
        for (name, value) in [
            (format!("crank[{k}].x"), first),
            (format!("crank[{k}].phi"), crank),
            (format!("coupler[{k}].x"), first + a[0]),
            (format!("coupler[{k}].y"), a[1]),
            (format!("coupler[{k}].phi"), coupler),
            (format!("rocker[{k}].x"), first + 0.5),
            (format!("rocker[{k}].phi"), turned),
        ] {
            q[model.coordinates.iter().position(|c| c.name == name).expect("a coordinate")] = value;
        }
    }
    q
}

/// The time and the kind of the limit in the error; asserts that the error names the joints of the four-bar `odd`.
fn end(error: &PlanError, odd: usize) -> (f64, LimitKind) {
    let PlanError::Limit { limit, .. } = error else { panic!("{error}") };
    let expected = [format!("A{odd}"), format!("B{odd}"), format!("D[{odd}]")];
    let named: Vec<&str> = limit.step.joints().collect();
    assert!(expected.iter().all(|name| named.contains(&name.as_str())), "{error} for {odd}");
    let Some(Located { at, kind: Some(kind) }) = limit.located else { panic!("{error}") };
    (at, kind)
}

#[test]
fn the_group_at_a_crossing_is_named() {
    for odd in 0..3 {
        for (begun, pace) in [(-0.5, 1.0), (0.4, -2.0)] {
            let bars = bars(odd, 0.2, begun, pace);
            let place = -begun / pace;
            for to in [place - 1e-6, place, place + 0.01, place + 0.5] {
                let mut planned = Planned::new(&bars, &Instant::at(0.0), &start(&bars)).unwrap();
                let error = planned.at(&Instant::at(to)).map(|_| ()).unwrap_err();
                let (at, kind) = end(&error, odd);
                assert!((at - place).abs() < 1e-9 && kind == LimitKind::BranchPoint, "{error}: {at} for {place}");
            }
            // A solver cannot be started there, either.
            let beside = Bars { begun: 1e-5 * begun, ..bars };
            let error = Planned::new(&beside, &Instant::at(0.0), &start(&beside)).map(|_| ()).unwrap_err();
            let (at, kind) = end(&error, odd);
            assert!((at - 1e-5 * place).abs() < 1e-9 && kind == LimitKind::BranchPoint, "{error}: {at}");
        }
    }
}

#[test]
fn the_group_at_a_dead_centre_is_named() {
    for odd in 0..3 {
        for (begun, pace) in [(-0.5, 1.0), (0.4, -2.0)] {
            // A rocker of 0.19 is too short: the loop opens at a crank angle where those of the other two four-bars
            // stay closed.
            let bars = bars(odd, 0.19, begun, pace);
            let fold = ((0.29 - 0.31 * 0.31) / 0.2_f64).acos();
            let place = (f64::copysign(fold, begun) - begun) / pace;
            for to in [place, place + 1e-6, place + 0.1, place + 1.0] {
                let mut planned = Planned::new(&bars, &Instant::at(0.0), &start(&bars)).unwrap();
                let error = planned.at(&Instant::at(to)).map(|_| ()).unwrap_err();
                let (at, kind) = end(&error, odd);
                assert!((at - place).abs() < 1e-9 && kind == LimitKind::DeadCentre, "{error}: {at} for {place}");
            }
            let sweep = bars.solver().sweep_from(&start(&bars), &[0.0, place + 0.1]).unwrap_err();
            let (words, names) =
                (sweep.source.to_string(), [format!("A{odd}"), format!("B{odd}"), format!("D[{odd}]")]);
            assert!(names.iter().all(|name| words.contains(name.as_str())), "{words}");
        }
    }
}
