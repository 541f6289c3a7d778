//! Motions that end where a linear step is singular: the solution goes to infinity, and would come back from the other
//! side.

use kin_runtime::batch::{Column, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Instant, Kinematics, Limit, LimitKind, Options, Refusal, SolveError, mechanism};
use kin_tests::random::Random;

/// A pin in the slot of an arm that turns about the origin, and on a line.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[bodies(pin)]
#[point_on_line(slot: arm @ (0, 0), pin @ (0, 0), axis = (1, 0))]
#[constraint(line: pin.y = w)]
#[relative_angle(along: arm, pin = 0.2)]
#[driver(drive: arm.phi = start + speed * t)]
struct Tangent {
    w: f64,
    start: f64,
    speed: f64,
}

/// The same, with line and slot in directions given by parameters.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[bodies(pin)]
#[point_on_line(slot: arm @ (0, 0), pin @ (0, 0), axis = (p, q))]
#[constraint(line: u * pin.x + v * pin.y = w)]
#[relative_angle(along: arm, pin = 0.2)]
#[driver(drive: arm.phi = start + speed * t)]
struct Oblique {
    p: f64,
    q: f64,
    u: f64,
    v: f64,
    w: f64,
    start: f64,
    speed: f64,
}

/// Reciprocal numbers, with a divisor that is a coordinate.
#[mechanism]
#[coordinates(u, v)]
#[driver(drive: u = start + speed * t)]
#[constraint(reciprocal: u * v = w)]
struct Reciprocal {
    w: f64,
    start: f64,
    speed: f64,
}

/// The same behind a group with two closures, so that nothing but the divisor is known.
#[mechanism]
#[coordinates(a, u, v)]
#[driver(drive: a = start + speed * t)]
#[constraint(square: (u + 3) * (u + 3) = (a + 3) * (a + 3))]
#[constraint(reciprocal: u * v = w)]
#[guess(u = 1)]
struct Behind {
    w: f64,
    start: f64,
    speed: f64,
}

/// Every way from 0 to beyond the pole ends at it, and passes no instant beyond it.
fn ends_at<M: Kinematics + Sync>(mechanism: &M, pole: f64) {
    let name = M::model().name;
    let is = |limit: Option<&Limit>, what: &str| {
        let limit = limit.unwrap_or_else(|| panic!("{name}, {what}: no limit"));
        let at = limit.at().unwrap_or_else(|| panic!("{name}, {what}: {limit}"));
        assert!((at - pole).abs() < 1e-9 && limit.kind() == Some(LimitKind::Pole), "{name}, {what}: {limit:?}");
        assert!(limit.to_string().contains("infinity at t = "), "{limit}");
    };
    let solver = mechanism.solver();
    for count in [1_u32, 3, 20, 500] {
        // The last instant is beyond the pole, and none is nearer to it than a thousandth of a step.
        let step = 1.4 * pole / f64::from(count) * 1.003;
        let times: Vec<f64> = (0..=count).map(|k| step * f64::from(k)).collect();
        let last = times.iter().take_while(|t| **t < pole).count();
        let error = solver.sweep(&times).expect_err("a pole");
        match (error.source.limit(), &error.source) {
            // An instant just before the pole is singular by the condition of Φ_q.
            (None, SolveError::Singular { t, .. }) if count == 500 => assert!((t - pole).abs() < 1e-2 * pole, "{name}"),
            (limit, source) => {
                is(limit, &format!("sweep in {count} steps: {source}"));
                assert_eq!(last, error.trajectory.states.len());
            }
        }
        let newton = mechanism.solver().with_options(Options { use_plan: false, ..Options::default() });
        let error = newton.sweep(&times).expect_err("a pole");
        match (error.source.limit(), &error.source) {
            // An instant just before the pole is singular by the condition of Φ_q.
            (None, SolveError::Singular { t, .. }) => {
                assert!(times.iter().any(|at| (*t..pole).contains(at)) && *t > 0.97 * pole, "{name}: {t} of {pole}");
            }
            (limit, source) => is(limit, &format!("full Newton in {count} steps: {source}")),
        }
        let mut planned = solver.planned(&Instant::at(0.0)).expect("it closes");
        let mut tracker = solver.tracker(&Instant::at(0.0)).expect("it closes");
        for (k, &t) in times.iter().enumerate().skip(1).take(last) {
            let at = Instant::at(t);
            match (planned.at(&at), tracker.update(&at)) {
                (Ok(_), Ok(_)) => assert!(k < last, "{name}: passed the pole"),
                (Err(planned), Err(tracker)) => {
                    assert_eq!(k, last, "{name}: {planned}");
                    is(planned.limit(), "planned");
                    if count < 500 {
                        is(tracker.limit(), "tracker");
                    }
                }
                (Ok(_), Err(SolveError::Singular { .. })) if count == 500 => break,
                (planned, tracker) => {
                    panic!("{name}, t = {t}: {:?} {:?}", planned.map(|_| ()), tracker.map(|_| ()))
                }
            }
        }
        let q = solver.state(&Instant::at(0.0)).expect("it closes").q;
        let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
        let parameters = mechanism.parameters::<f64>();
        let parameters: Vec<_> = parameters.as_ref().iter().map(|p| Column::Shared(*p)).collect();
        let sweeps =
            Sweeps { parameters: &parameters, times: &times, inputs: &[], modes: Modes::OfStart, start: &start };
        let mut out = Motions::new(1, Vec::new());
        sweep(mechanism, &sweeps, &mut out, &always, |_: &mut Vec<f64>, _| ()).unwrap();
        let end = out.ends().next().flatten().expect("a pole");
        assert_eq!(last, end.instant, "{name}: batch");
        is(end.limit.as_ref(), "batch");
    }
    // Full Newton does not pass the pole either.
    let newton = mechanism.solver().with_options(Options { use_plan: false, ..Options::default() });
    let times: Vec<f64> = (0..100).map(|k| 0.014 * pole * f64::from(k)).collect();
    let error = newton.sweep(&times).expect_err("a pole").source;
    assert!(!matches!(error, SolveError::NotAssembled { .. }), "{error}");
    // Its steps grow with the way to infinity.
    let newton = mechanism.solver().with_options(Options { use_plan: false, max_steps: 200, ..Options::default() });
    let error = newton.sweep(&[0.0, 1.4 * pole]).expect_err("a pole").source;
    assert!(!matches!(error, SolveError::StepRefused { reason: Refusal::TooManySteps, .. }), "{name}: {error}");
}

#[test]
fn a_pin_in_a_slot_does_not_pass_infinity() {
    let pi = std::f64::consts::PI;
    for (w, start, speed) in [(0.5, -2.5, 3.0), (-2.0, 2.0, -0.7)] {
        // Slot and line are parallel at a multiple of π.
        let next = if speed > 0.0 { (start / pi).ceil() * pi } else { (start / pi).floor() * pi };
        ends_at(&Tangent { w, start, speed }, (next - start) / speed);
        for (line, slot) in [(0.0, 0.0), (0.3, 0.0), (0.9, -0.4)] {
            let [(v, u), (q, p)] = [line, slot].map(f64::sin_cos);
            // The line is normal to (u, v), the slot along (p, q).
            let phi = line + 0.5 * pi - slot;
            let first = if speed > 0.0 { ((start - phi) / pi).ceil() } else { ((start - phi) / pi).floor() };
            ends_at(&Oblique { p, q, u, v, w, start, speed }, (phi + first * pi - start) / speed);
        }
    }
}

/// Three equations with a determinant that changes its sign.
#[mechanism]
#[coordinates(u, v, w)]
#[constraint(first: u + (a0 + a1 * t) * v = 1)]
#[constraint(second: v + b0 * w = 1)]
#[constraint(third: w + c0 * u = 1)]
struct Linear {
    a0: f64,
    a1: f64,
    b0: f64,
    c0: f64,
}

/// a x² + b x = c, where a changes its sign; without b, too.
#[mechanism]
#[coordinates(x)]
#[constraint(square: (a0 + a1 * t) * x * x + b * x = c)]
#[guess(x = start)]
struct Root {
    a0: f64,
    a1: f64,
    b: f64,
    c: f64,
    start: f64,
}

#[mechanism]
#[coordinates(x)]
#[constraint(square: (a0 + a1 * t) * x * x = c + t)]
#[guess(x = 1)]
struct Square {
    a0: f64,
    a1: f64,
    c: f64,
}

/// Scalars are measured by their own size, so that steps on the way to infinity become shorter with the rest of the way
/// only.
#[test]
fn scalars_do_not_pass_infinity() {
    fn ends<M: Kinematics>(mechanism: &M, pole: f64) {
        let name = M::model().name;
        for count in [1_u32, 7, 20] {
            let times: Vec<f64> = (0..=count).map(|k| 1.4042 * pole / f64::from(count) * f64::from(k)).collect();
            let last = times.iter().take_while(|t| **t < pole).count();
            let error = mechanism.solver().sweep(&times).expect_err("a pole");
            let states = error.trajectory.states.len();
            assert!(states <= last && states + 1 >= last, "{name}: {}", error.source);
            let mut planned = mechanism.solver().planned(&Instant::at(0.0)).expect("it closes");
            let refused = times[1..=last].iter().find_map(|&t| planned.at(&Instant::at(t)).err()).expect("a pole");
            let is = |limit: Option<&Limit>, words: &dyn std::fmt::Display| {
                let at = limit.and_then(Limit::at).unwrap_or(f64::NAN);
                assert!((at - pole).abs() < 2e-9 * pole.abs(), "{name}: {words}, not at {pole}: {at}");
                assert_eq!(Some(LimitKind::Pole), limit.and_then(Limit::kind), "{name}: {words}");
            };
            is(refused.limit(), &refused);
            match (error.source.limit(), &error.source) {
                // An instant just before the pole is singular by the condition of Φ_q.
                (None, SolveError::Singular { t, .. }) => assert!((t - pole).abs() < 1e-2 * pole, "{name}"),
                (limit, source) => is(limit, source),
            }
        }
    }
    let (w, start, speed) = (2.0, 1.0, -0.3);
    ends(&Reciprocal { w, start, speed }, -start / speed);
    ends(&Behind { w, start, speed }, -start / speed);
    // The determinant is 1 + a b c.
    ends(&Linear { a0: -1.0, a1: -2.0, b0: 0.8, c0: 0.5 }, 0.75);
    ends(&Linear { a0: -1.0, a1: -2.0, b0: 800.0, c0: 0.5e-3 }, 0.75);
    for size in [1e-3, 1.0, 1e3] {
        // The root that goes to infinity is the one of the other sign than c/b.
        let (a0, a1, b, start) = (0.4 / size, -0.3 / size, 1.0, -10.0 * size);
        ends(&Root { a0, a1, b, c: size, start }, 4.0 / 3.0);
    }
    ends(&Square { a0: 0.4, a1: -0.3, c: 0.7 }, 4.0 / 3.0);
}

/// A link between sliders beside a number of any size.
#[mechanism]
#[body(a, y = 0, phi = 0)]
#[body(b, x = 0, phi = 0)]
#[coordinates(z)]
#[distance(link: a @ (0, 0), b @ (0, 0), length = 1)]
#[driver(pull: a.x = 0.5 * t)]
#[constraint(large: z = k * t)]
#[guess(b.y = 1)]
struct Large {
    k: f64,
}

/// A number in a small unit does not make every step short.
#[test]
fn a_large_scalar_is_followed() {
    for k in [1.0, -1e3, 1e6, 1e9] {
        let large = Large { k };
        let swept = large.solver().sweep(&[-1.0, 0.0, 1.0]).expect("it closes");
        let mut planned = large.solver().planned(&Instant::at(-1.0)).expect("it closes");
        for state in &swept.states {
            planned.at(&Instant::at(state.t)).expect("it closes");
            for q in [&state.q[..], planned.q()] {
                assert!((q[2] - k * state.t).abs() <= 1e-12 * k.abs(), "{k}: {q:?}");
                assert!((q[1] - (1.0 - 0.25 * state.t * state.t).sqrt()).abs() < 1e-12, "{k}: {q:?}");
            }
        }
    }
}

/// A slot that swings past the line's direction and back: two poles, 2 acos(1 + p/b)/w apart.
#[mechanism]
#[body(arm, x = 0, y = 0)]
#[body(pin, phi = 0)]
#[point_on_line(slot: arm @ (0, 0), pin @ (0, 0), axis = (1, 0))]
#[point_on_line(line: ground @ (0, 0.3), pin @ (0, 0), axis = (1, 0))]
#[driver(drive: arm.phi = p + b * (1 - cos(t)))]
struct Swing {
    p: f64,
    b: f64,
}

/// The least value within a step shows that a determinant has changed its sign and back.
#[test]
fn two_poles_within_a_step_are_seen() {
    let (mut passed, mut all) = (0, 0);
    for p in [-1e-3, -3e-3, -1e-2, -3e-2, -5e-2] {
        for b in [0.2, 0.5, 0.9] {
            let swing = Swing { p, b };
            let pole = -(1.0 + p / b).acos();
            for count in [2_u32, 5, 10, 30, 100] {
                let times: Vec<f64> = (0..=count).map(|k| -1.0 + 2.3 / f64::from(count) * f64::from(k)).collect();
                all += 1;
                match swing.solver().sweep(&times) {
                    Ok(_) => passed += 1,
                    Err(error) => {
                        let at = error.source.limit().and_then(Limit::at);
                        assert!(at.is_some_and(|at| (at - pole).abs() < 1e-6), "{p} {b} {count}: {}", error.source);
                    }
                }
            }
        }
    }
    assert!(passed == 0 && all == 75, "{passed} of {all}");
}

/// The same with p = 0: the divisor touches 0 without a change of its sign, and the pin comes back from the side to
/// which it has left.
#[test]
fn poles_that_a_determinant_only_touches_are_not_passed() {
    let mut random = Random::new(3);
    for count in [2_u32, 3, 5, 10, 30, 100, 300] {
        for _ in 0..20 {
            let b = random.between(0.1, 1.5) * if random.between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
            let swing = Swing { p: 0.0, b };
            let (first, last) = (random.between(-1.5, -0.5), random.between(0.3, 1.5));
            let times: Vec<f64> =
                (0..=count).map(|k| first + (last - first) * f64::from(k) / f64::from(count)).collect();
            let error = swing.solver().sweep(&times).expect_err("infinity is on the way");
            match (error.source.limit(), &error.source) {
                (Some(limit), _) => {
                    let at = limit.at().unwrap_or_else(|| panic!("{b} {count}: {limit}"));
                    assert!(at.abs() < 1e-5 && limit.kind() == Some(LimitKind::Pole), "{b} {count}: {limit}, {at}");
                }
                // An instant just before the pole is singular by the condition of Φ_q.
                (None, source) => assert!(matches!(source, SolveError::Singular { .. }), "{b} {count}: {source}"),
            }
            let mut planned = swing.solver().planned(&Instant::at(times[0])).expect("it closes");
            let ended = times[1..].iter().position(|&t| planned.at(&Instant::at(t)).is_err());
            let place = ended.map(|k| times[k + 1]);
            assert!(place.is_some_and(|t| t >= -1e-2 && t - (last - first) / f64::from(count) < 1e-5), "{b} {count}");
        }
    }
}

/// A pin on two lines, one of which is turned by an input.
#[mechanism]
#[input(angle)]
#[body(pin, phi = 0)]
#[constraint(turned: cos(angle) * pin.x + sin(angle) * pin.y = 0.3)]
#[constraint(still: pin.y = 0.2 * pin.x + 1)]
struct Turned;

/// An input may jump across a pole, and across two, at the same instant or at another: the signs at both ends may be
/// equal, and no coordinate turns.
#[test]
fn an_input_does_not_jump_across_a_pole() {
    use kin_runtime::Signal;
    // The lines are parallel at cos(angle) + 0.2 sin(angle) = 0.
    let pole = 1.0_f64.atan2(-0.2);
    for (to, passes) in [(1.2, false), (1.75, false), (3.3, true), (5.5, true), (-0.9, false)] {
        for dt in [0.0, 0.1, 1.0] {
            for rate in [0.0, 3.0] {
                let at = |t: f64, angle: f64| (t, [Signal::new(angle, rate, 0.0)]);
                let (from, to) = (at(0.0, 0.0), at(dt, to));
                let [from, to] = [&from, &to].map(|(t, inputs)| Instant { t: *t, inputs });
                let solver = Turned.solver();
                let mut planned = solver.planned(&from).expect("it closes");
                let mut tracker = solver.tracker(&from).expect("it closes");
                let start: Vec<_> = planned.q().iter().map(|q| Column::Shared(*q)).collect();
                let (by_plan, by_tracker) = (planned.at(&to).map(|_| ()), tracker.update(&to).map(|_| ()));
                let (angles, rates) = ([from.inputs[0].value, to.inputs[0].value], [rate; 2]);
                let input = Signal::new(Column::Each(&angles), Column::Each(&rates), Column::Shared(0.0));
                let (times, modes) = ([0.0, dt], Modes::OfStart);
                let sweeps = Sweeps { parameters: &[], times: &times, inputs: &[input], modes, start: &start };
                let mut out = Motions::new(1, Vec::new());
                sweep(&Turned, &sweeps, &mut out, &always, |_: &mut Vec<f64>, _| ()).unwrap();
                let end = out.ends().next().flatten();
                assert_eq!(passes, end.is_some(), "{to:?}: batch");
                let of_batch = end.and_then(|end| end.limit);
                if !passes {
                    assert!(by_plan.is_ok() && by_tracker.is_ok(), "{to:?}: {by_plan:?} {by_tracker:?}");
                    continue;
                }
                let (by_plan, by_tracker) = (by_plan.expect_err("a pole"), by_tracker.expect_err("a pole"));
                for limit in [by_plan.limit(), by_tracker.limit(), of_batch.as_ref()] {
                    assert_eq!(Some(LimitKind::Pole), limit.and_then(Limit::kind), "{by_plan} {by_tracker}");
                    if rate == 0.0 && dt > 0.0 {
                        // Without rates the input moves uniformly.
                        let s = limit.and_then(Limit::at).expect("located") / dt;
                        assert!((s * to.inputs[0].value - pole).abs() < 1e-9, "{s}");
                    }
                }
            }
        }
    }
}

/// An exact kite (Galloway's mechanism): where the crank's pin is on the axle of the rocker, both turn about it together.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[bodies(coupler)]
#[body(rocker, x = 1, y = 0)]
#[revolute(A: crank @ (1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (1.5, 0), rocker @ (1.5, 0))]
#[driver(drive: crank.phi = 1 - t)]
#[guess(coupler.phi = 1, rocker.phi = 2)]
struct Kite;

#[test]
fn coinciding_pins_are_no_solution_at_infinity() {
    for times in [vec![0.0, 2.0], vec![0.0, 1.0, 2.0], (0..=20).map(|k| 0.13 * f64::from(k)).collect()] {
        let error = Kite.solver().sweep(&times).expect_err("the pins meet").source;
        let limit = error.limit().expect("a limit");
        assert_ne!(limit.kind(), Some(LimitKind::Pole), "{times:?}: {error}");
        assert!(limit.at().is_some_and(|t| (t - 1.0).abs() < 1e-9), "{times:?}: {error}");
    }
}
