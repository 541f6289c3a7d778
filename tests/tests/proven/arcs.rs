//! Sweeps along the arc of the solution curve, through dead centres, compared with known properties of the curves.

use kin_runtime::{
    ArcEnd, ArcFault, ArcPlaceKind, Instant, Kinematics, Options, SolutionArc, SolveError, Trajectory, mechanism,
};
use std::f64::consts::{PI, TAU};

/// A four-bar on the x axis with a point on its coupler.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (a, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (b, 0), rocker @ (c, 0))]
#[revolute(C: ground @ (d, 0), rocker @ (0, 0))]
#[point(tip = coupler @ (0.1, 0.07))]
#[driver(drive: crank.phi = start + t)]
struct FourBar {
    #[param(0.3)]
    a: f64,
    #[param(0.25)]
    b: f64,
    #[param(0.2)]
    c: f64,
    #[param(0.5)]
    d: f64,
    #[param(0.0)]
    start: f64,
}

impl FourBar {
    /// The crank angles in [0, π] at which coupler and rocker are in line, from the cosine theorem: stretched or folded.
    fn dead_centres(&self) -> Vec<f64> {
        let Self { a, b, c, d, .. } = *self;
        let cosine = |r: f64| (a * a + d * d - r * r) / (2.0 * a * d);
        [b + c, b - c].into_iter().map(cosine).filter(|cosine| cosine.abs() < 1.0).map(f64::acos).collect()
    }

    /// The two places of the coupler at a crank angle, by the intersection of two circles; none where they do not meet.
    fn tips(&self, phi: f64) -> Vec<[f64; 2]> {
        let Self { a, b, c, d, .. } = *self;
        let [x, y] = [a * phi.cos(), a * phi.sin()];
        let (u, v) = (d - x, -y);
        let square = u * u + v * v;
        let along = (square + b * b - c * c) / (2.0 * square);
        let across = b * b / square - along * along;
        let tip = |sign: f64| {
            let h = sign * across.sqrt();
            let (cos, sin) = ((along * u - h * v) / b, (along * v + h * u) / b);
            [x + 0.1 * cos - 0.07 * sin, y + 0.1 * sin + 0.07 * cos]
        };
        if across < 0.0 { Vec::new() } else { vec![tip(1.0), tip(-1.0)] }
    }

    fn arc(&self, steps: usize) -> Trajectory {
        self.solver().sweep_along_arc(0.0, None, steps).unwrap()
    }
}

fn arc(trajectory: &Trajectory) -> &SolutionArc {
    trajectory.arc.as_ref().expect("it went along the arc")
}

/// Deterministic numbers in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Neighbouring states are about as far apart as a step of the arc, angles and lengths alike: nothing jumps. On the scale of
/// the arc no coordinate counts less than a fifth.
fn is_unbroken(trajectory: &Trajectory) -> bool {
    let step = arc(trajectory).length / (trajectory.len() - 1) as f64;
    trajectory.states.windows(2).all(|pair| {
        let [a, b] = pair else { return false };
        a.q.iter().zip(&b.q).all(|(a, b)| (a - b).abs() <= 5.0 * step)
    })
}

/// All of the coupler curve, both closures and both directions of the driver, in one run: every place of the coupler that
/// two circles give lies between neighbouring states.
#[test]
fn a_crank_that_rocks_draws_the_whole_coupler_curve() {
    let bar = FourBar::default();
    let steps = 400;
    let swept = bar.arc(steps);
    let found = arc(&swept);
    assert!(found.is_closed() && swept.len() == steps + 1 && is_unbroken(&swept), "{found}");
    assert!(swept.states.iter().all(|state| state.residual < 1e-14), "{found}");
    let end = bar.dead_centres()[0];
    let times: Vec<f64> = found.places.iter().map(|place| place.t).collect();
    assert!((times[0] - end).abs() < 1e-12 && (times[1] + end).abs() < 1e-12 && times.len() == 2, "{times:?}");
    for place in &found.places {
        assert_eq!((place.kind, place.joints.as_slice()), (ArcPlaceKind::DeadCentre, ["A", "B", "C"].as_slice()));
        assert_eq!(place.drivers, ["drive"]);
        // Coupler and rocker are on one line: their angles differ by a multiple of π.
        let turn = (place.q[5] - place.q[8]) / PI;
        assert!((turn - turn.round()).abs() < 1e-9 && place.within <= 1e-11, "{turn} {place}");
    }
    let curve: Vec<[f64; 2]> = swept.states.iter().map(|state| state.points[0].r).collect();
    let longest = curve.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]));
    let longest = longest.fold(0.0, f64::max);
    for k in 0..1000 {
        let phi = end * (2.0 * f64::from(k) / 999.0 - 1.0) * (1.0 - 1e-9);
        for tip in bar.tips(phi) {
            let nearest = curve.iter().map(|r| (r[0] - tip[0]).hypot(r[1] - tip[1])).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 0.51 * longest, "{phi}: {nearest} of {longest}");
        }
    }
    let [Some(first), Some(last)] = [swept.states.first(), swept.last()] else { panic!("states") };
    assert!(first.q.iter().zip(&last.q).all(|(a, b)| (a - b).abs() < 1e-9));
    assert!(first.q_dot.iter().zip(&last.q_dot).all(|(a, b)| (a - b).abs() < 1e-6));
}

/// Random dimensions: the driver turns back exactly where the cosine theorem says, a crank that turns by Grashof's rule comes
/// back after one turn, and no state is off its curve.
#[test]
fn random_four_bars_turn_back_where_the_cosine_theorem_says() {
    let count = if cfg!(debug_assertions) { 40 } else { 10_000 };
    let mut draw = Draw(11);
    let (mut turning, mut rocking) = (0, 0);
    for _ in 0..count {
        let [a, b, c, d, start] = [(); 5].map(|()| 0.2 + draw.unit());
        let bar = FourBar { a, b, c, d, start: PI * start };
        let mut sides = [a, b, c, d];
        sides.sort_by(f64::total_cmp);
        if sides[3] > sides[0] + sides[1] + sides[2] - 1e-3 || bar.tips(bar.start).is_empty() {
            continue;
        }
        let expected = bar.dead_centres();
        let margin = (sides[0] + sides[3] - sides[1] - sides[2]).abs();
        if margin < 1e-4 || expected.iter().any(|phi| (phi - bar.start).abs() < 1e-3) {
            continue;
        }
        let swept = bar.arc(16);
        let found = arc(&swept);
        let what = format!("{a} {b} {c} {d} {start}: {found}");
        assert!(found.is_closed() && is_unbroken(&swept), "{what}");
        assert!(found.places.iter().all(|place| place.kind == ArcPlaceKind::DeadCentre), "{what}");
        for place in &found.places {
            let phi = (bar.start + place.t).rem_euclid(TAU);
            let folded = if phi > PI { TAU - phi } else { phi };
            assert!(expected.iter().any(|x| (x - folded).abs() < 1e-9), "{what} {expected:?}");
        }
        let turn = swept.last().map_or(0.0, |last| last.t);
        if expected.is_empty() {
            assert!(found.places.is_empty() && (turn - TAU).abs() < 1e-9, "{what}");
            turning += 1;
        } else {
            assert!(found.places.len() >= 2 && found.places.len().is_multiple_of(2), "{what}");
            // What is met within the arc is met all round: t comes back, or has gone on by whole turns.
            assert!((turn / TAU - (turn / TAU).round()).abs() < 1e-9, "{what}");
            rocking += 1;
        }
    }
    assert!(turning > count / 20 && rocking > count / 10, "{turning} {rocking}");
}

/// A slider that drives its crank through both dead centres.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(push: slider.x = 0.8 + 0.1 * t)]
#[guess(crank.phi = 0.5, rod.phi = -0.2, slider.x = 0.8)]
struct Engine;

#[test]
fn a_slider_drives_its_crank_all_the_way_round() {
    let swept = Engine.solver().sweep_along_arc(0.0, None, 60).unwrap();
    let found = arc(&swept);
    assert!(found.is_closed() && is_unbroken(&swept), "{found}");
    // x = r + l at t = 1, x = l − r at t = −3.
    let times: Vec<f64> = found.places.iter().map(|place| place.t).collect();
    assert!(times.len() == 2 && (times[0] - 1.0).abs() < 1e-12 && (times[1] + 3.0).abs() < 1e-11, "{times:?}");
    let turned = swept.last().map_or(0.0, |last| last.q[2]) - swept.states[0].q[2];
    assert!((turned.abs() - TAU).abs() < 1e-9, "{turned}");
    // Between two times it goes through the dead centre and back out of the interval.
    let part = Engine.solver().sweep_along_arc(0.0, Some(2.0), 30).unwrap();
    let found = arc(&part);
    assert_eq!((found.ends, found.places.len()), ([ArcEnd::Bound; 2], 1), "{found}");
    let [Some(first), Some(last)] = [part.states.first(), part.last()] else { panic!("states") };
    assert!(first.t.abs() < 1e-12 && last.t == 0.0 && (first.q[2] + last.q[2]).abs() < 1e-9, "{found}");
    // Between 0 and 0.9 there is none, in either direction of time.
    for (from, to) in [(0.0, 0.9), (0.9, 0.0)] {
        let part = Engine.solver().sweep_along_arc(from, Some(to), 7).unwrap();
        assert!(arc(&part).places.is_empty() && (part.states[0].t - from).abs() < 1e-12, "{from} {to}");
        assert!(part.last().is_some_and(|last| last.t == to) && part.len() == 8, "{from} {to}");
    }
}

/// At a dead centre rates have no value, and states start there as anywhere else.
#[test]
fn an_arc_may_begin_at_a_dead_centre() {
    let solver = Engine.solver().with_guess(2, 0.0).with_guess(5, 0.0);
    let swept = solver.sweep_along_arc(1.0, None, 24).unwrap();
    let found = arc(&swept);
    assert!(found.is_closed() && swept.states[0].q_dot[2].is_nan(), "{found}");
    assert!(swept.states[1..24].iter().all(|state| state.t < 1.0 && state.q_dot[2].is_finite()), "{found}");
    assert!(swept.states[0].bodies[0].phi.abs() < 1e-6 && swept.states[0].bodies[0].phi_dot.is_nan());
}

/// Branches of a flat parallelogram cross: the arc ends there and says so, whichever way it goes.
#[test]
fn the_arc_ends_where_branches_cross() {
    let flat = FourBar { a: 0.2, b: 0.5, c: 0.2, d: 0.5, start: 0.7 };
    for use_plan in [true, false] {
        let solver = flat.solver().with_options(Options { use_plan, ..Options::default() });
        let swept = solver.sweep_along_arc(0.0, None, 20).unwrap();
        let found = arc(&swept);
        assert_eq!((found.ends, found.places.len()), ([ArcEnd::BranchPoint; 2], 2), "{found}");
        let times: Vec<f64> = found.places.iter().map(|place| place.t + 0.7).collect();
        assert!(times[0].abs() < 1e-6 && (times[1] - PI).abs() < 1e-6, "{times:?}");
        assert!(found.places.iter().all(|place| place.kind == ArcPlaceKind::BranchPoint));
        for joint in ["A", "B", "C"] {
            assert!(found.places.iter().all(|place| place.joints.contains(&joint)), "{found}");
        }
        // It is one closure from end to end: a parallelogram, or its crossed sister.
        let is_level = |q: &[f64]| (q[8] - q[2]).abs() < 1e-5;
        let level = swept.states.iter().filter(|state| is_level(&state.q)).count();
        assert!(level <= 2 || level == swept.len(), "{level}");
    }
}

/// Beside a crossing: a gap of a hundred-thousandth between two branches. The arc turns round in front of it, as it must, and
/// never jumps over it.
#[test]
fn the_arc_follows_its_own_branch_beside_a_crossing() {
    for off in [1e-2, 1e-3, 1e-5] {
        // Cranks that rock, one past 0 and the other past π.
        for d in [0.5 + off, 0.5 - off] {
            let bar = FourBar { a: 0.2, b: 0.5, c: 0.2, d, start: 0.7 };
            let swept = bar.arc(50);
            let found = arc(&swept);
            assert!(found.is_closed() && is_unbroken(&swept), "{d}: {found}");
            let expected = bar.dead_centres();
            for place in &found.places {
                assert_eq!(place.kind, ArcPlaceKind::DeadCentre, "{d}: {place}");
                let phi = (0.7 + place.t).rem_euclid(TAU);
                let folded = if phi > PI { TAU - phi } else { phi };
                assert!(expected.iter().any(|x| (x - folded).abs() < 1e-8), "{d}: {place} {expected:?}");
            }
            assert_eq!(found.places.is_empty(), expected.is_empty(), "{d}: {found}");
        }
    }
}

/// A wheel that rolls, with a point on its rim: the cusps of the cycloid are where the point touches the ground.
#[mechanism]
#[bodies(wheel)]
#[rolling(road: ground @ (0, 0), wheel @ (0, 0), axis = (1, 0), radius = 0.5)]
#[driver(drive: wheel.x = 2 * t)]
#[point(rim = wheel @ (0, -0.5))]
#[point(near = wheel @ (0, -0.49))]
#[point(hub = wheel @ (0, 0))]
struct Wheel;

#[test]
fn cusps_of_a_cycloid_are_where_its_point_touches() {
    let swept = Wheel.solver().sweep_along_arc(-0.3, Some(6.0), 40).unwrap();
    let found = arc(&swept);
    assert_eq!(found.ends, [ArcEnd::Bound; 2], "{found}");
    let expected: Vec<f64> = (0..4).map(|turn| TAU * 0.5 * f64::from(turn) / 2.0).collect();
    assert_eq!(found.places.len(), expected.len(), "{found}");
    for (place, expected) in found.places.iter().zip(expected) {
        assert_eq!(place.kind, ArcPlaceKind::Cusp { point: "rim" });
        assert!((place.t - expected).abs() < 1e-9, "{place} {expected}");
    }
    // The same at the very start.
    let swept = Wheel.solver().sweep_along_arc(0.0, Some(1.0), 10).unwrap();
    let cusps: Vec<f64> = arc(&swept).places.iter().map(|place| place.t).collect();
    assert!(cusps.len() == 1 && cusps[0].abs() < 1e-12, "{cusps:?}");
}

/// A driver that comes to rest and goes back: t goes on where the mechanism stands still.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(swing: crank.phi = 1 - cos(t))]
#[guess(rod.phi = -0.2, slider.x = 0.8)]
struct Swinging;

#[test]
fn a_driver_that_swings_is_followed_through_its_rests() {
    let swept = Swinging.solver().sweep_along_arc(0.0, None, 80).unwrap();
    let found = arc(&swept);
    // At rest at t = 0, π and 2π; no dead centres, as the crank drives.
    assert!(found.is_closed() && found.places.is_empty(), "{found}");
    let last = swept.last().map_or(0.0, |last| last.t);
    assert!(last > TAU - 1.0 && last < TAU + 1.0, "{last}");
    assert!(swept.states.windows(2).all(|pair| pair[0].t < pair[1].t));
    assert!(swept.states.iter().all(|state| (state.q[2] - (1.0 - state.t.cos())).abs() < 1e-12));
}

/// Three legs with two given cranks and a driven one: a group that closes by iteration alone.
#[mechanism]
#[bodies(platform, crank[3], rod[3])]
#[revolute(motor[i in 0..3]: ground @ (0.5*cos(2*pi*i/3 - 5*pi/6), 0.5*sin(2*pi*i/3 - 5*pi/6)), crank[i] @ (0, 0))]
#[revolute(elbow[i in 0..3]: crank[i] @ (0.3, 0), rod[i] @ (0, 0))]
#[revolute(wrist[i in 0..3]: rod[i] @ (0.3, 0), platform @ (0.25*cos(2*pi*i/3 - 5*pi/6), 0.25*sin(2*pi*i/3 - 5*pi/6)))]
#[driver(a: crank[0].phi = 0.9 + t)]
#[driver(b: crank[1].phi = 3.1)]
#[driver(c: crank[2].phi = -1.2)]
struct Legs;

/// At a dead centre of a group without closed form the rows depend on one another, and both of its closures there are one:
/// beside it, on the side where t comes from, there are two more closures than beyond.
#[test]
fn groups_that_close_by_iteration_turn_back_where_two_closures_meet() {
    let all = Legs.solver().assemblies(&Instant::at(0.0)).unwrap();
    assert!(all.is_complete() && !all.found.is_empty(), "{all}");
    let mut seen = 0;
    for assembly in &all.found {
        let solver = (0..assembly.q.len()).fold(Legs.solver(), |solver, k| solver.with_guess(k, assembly.q[k]));
        let swept = solver.sweep_along_arc(0.0, None, 100).unwrap();
        let found = arc(&swept);
        assert!(found.is_closed() && is_unbroken(&swept), "{found}");
        assert!(swept.states[0].q.iter().zip(&assembly.q).all(|(a, b)| (a - b).abs() < 1e-9));
        for place in &found.places {
            assert_eq!(place.kind, ArcPlaceKind::DeadCentre, "{found}");
            assert!(place.joints.iter().any(|joint| joint.starts_with("wrist")), "{place}");
        }
        if let (true, Some(place)) = (seen == 0 && !cfg!(debug_assertions), found.places.first()) {
            let count = |t: f64| {
                let all = Legs.solver().assemblies(&Instant::at(t)).unwrap();
                assert!(all.is_complete(), "{t}: {all}");
                all.found.len()
            };
            assert_eq!(count(place.t - 1e-5).abs_diff(count(place.t + 1e-5)), 2, "{place}");
            seen += 1;
        }
    }
}

/// One pin, without a driver.
#[mechanism]
#[bodies(arm)]
#[revolute(A: ground @ (0, 0), arm @ (0, 0))]
struct Pendulum;

/// A blade that only goes along itself.
#[mechanism]
#[bodies(sleigh)]
#[knife_edge(blade: sleigh @ (0, 0), angle = 0)]
#[speed(pull: sleigh @ (0, 0), angle = 0, value = 1)]
#[driver(turn: sleigh.phi = t)]
#[guess(sleigh.x = 0, sleigh.y = 0)]
struct Sleigh;

#[test]
fn what_is_no_single_curve_is_refused() {
    let refused = |error: SolveError| match error {
        SolveError::NoArc { why, .. } => why,
        error => panic!("{error}"),
    };
    let error = Pendulum.solver().sweep_along_arc(0.0, None, 10).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no sweep along the arc from t = 0: the motion can begin in 2 independent directions: drivers leave it open, or \
         branches cross there"
    );
    assert_eq!(refused(error), ArcFault::Directions { count: 2 });
    let error = Sleigh.solver().sweep_along_arc(0.0, None, 10).unwrap_err();
    assert_eq!(refused(error), ArcFault::VelocityLevel);
    // A flat parallelogram is on two branches.
    let flat = FourBar { a: 0.2, b: 0.5, c: 0.2, d: 0.5, start: 0.0 };
    let solver = flat.solver().with_guess(5, 0.0).with_guess(8, 0.0);
    assert_eq!(refused(solver.sweep_along_arc(0.0, None, 10).unwrap_err()), ArcFault::Directions { count: 2 });
    let error = Engine.solver().sweep_along_arc(0.0, Some(f64::NAN), 10).unwrap_err();
    assert!(matches!(error, SolveError::NonFinite { .. }), "{error}");
}

/// The same loop by its angles alone, which turn as bodies do.
#[mechanism]
#[coordinates(phi1, phi2, phi3)]
#[constraint(close_x: l1*cos(phi1) + 0.4*cos(phi2) + 0.3*cos(phi3) = 0.4)]
#[constraint(close_y: l1*sin(phi1) + 0.4*sin(phi2) + 0.3*sin(phi3) = 0)]
#[driver(drive: phi1 = t)]
#[guess(phi2 = 0.9, phi3 = 5)]
struct Loop {
    #[param(0.1)]
    l1: f64,
}

#[test]
fn loops_of_angles_close_after_whole_turns() {
    let turning = Loop::default().solver().sweep_along_arc(0.3, None, 20).unwrap();
    assert!(arc(&turning).is_closed() && arc(&turning).places.is_empty(), "{}", arc(&turning));
    assert!(turning.last().is_some_and(|last| (last.t - 0.3 - TAU).abs() < 1e-9));
    let rocking = Loop { l1: 0.35 }.solver().sweep_along_arc(0.3, None, 20).unwrap();
    assert!(arc(&rocking).is_closed() && arc(&rocking).places.len() >= 2, "{}", arc(&rocking));
}
