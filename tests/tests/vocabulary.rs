//! Every joint and driver of the vocabulary compared with a closed form, with all kinds of operands: bodies with given
//! or carried coordinates, families, named points, moving frames, defines as dimensions.

use kin_runtime::{Kinematics, Mechanism, State, mechanism};

/// The value, rate and acceleration of a coordinate.
fn of<M: Mechanism>(state: &State, name: &str) -> [f64; 3] {
    let k = M::model().coordinate(name).unwrap_or_else(|| panic!("no coordinate {name}"));
    [state.q[k], state.q_dot[k], state.q_ddot[k]]
}

/// f and its first two derivatives by sixth-order finite differences, for the closed forms.
fn differences(f: impl Fn(f64) -> f64, t: f64) -> [f64; 3] {
    let h = 2e-3;
    let at = |k: f64| f(t + k * h);
    let odd = |k: f64| at(k) - at(-k);
    let even = |k: f64| at(k) + at(-k);
    let first = (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * h);
    let second = (270.0 * even(1.0) - 27.0 * even(2.0) + 2.0 * even(3.0) - 490.0 * at(0.0)) / (180.0 * h * h);
    [at(0.0), first, second]
}

fn agree(found: [f64; 3], expected: [f64; 3], what: &str) {
    for ((found, expected), tolerance) in found.into_iter().zip(expected).zip([1e-11, 1e-9, 1e-7]) {
        let size = expected.abs().max(1.0);
        assert!((found - expected).abs() < tolerance * size, "{what}: {found} and {expected}");
    }
}

/// Solves a sweep and compares one coordinate with its closed form.
fn follows<M: Mechanism + Kinematics>(mechanism: &M, times: &[f64], name: &str, closed_form: impl Fn(f64) -> f64) {
    let sweep = mechanism.kinematic_analysis(times).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(sweep.len(), times.len());
    for state in &sweep {
        agree(of::<M>(state, name), differences(&closed_form, state.t), &format!("{name} at t = {}", state.t));
    }
    let check = mechanism.cross_check().expect("comparable");
    assert!(check.passes(1e-11), "{check}");
}

const TIMES: [f64; 6] = [0.0, 0.3, 0.9, 1.7, 2.6, 4.0];

/// Three planets whose origins are carried by the arm, and a fixed internal ring gear.
#[mechanism]
#[body(sun, x = 0, y = 0)]
#[body(arm, x = 0, y = 0)]
#[body(ring, x = 0, y = 0, phi = 0)]
#[body(planet[i in 0..3], origin = arm @ (a * cos(2*pi*i/3), a * sin(2*pi*i/3)))]
#[define(a = rs + rp)]
#[gear(inner[i in 0..3]: sun, planet[i], radii = (rs, rp), carrier = arm)]
#[gear(outer: planet[0], ring, radii = (rp, -(rs + 2*rp)), carrier = arm)]
#[driver(drive: sun.phi = 0.7 * t + 0.1 * sin(t))]
struct Planetary {
    #[param(0.03)]
    rs: f64,
    #[param(0.02)]
    rp: f64,
}

#[test]
fn planetary_gear() {
    // Willis: rs φs = (rs + rr) φc with the ring at rest.
    follows(&Planetary::default(), &TIMES, "arm.phi", |t| 0.03 * (0.7 * t + 0.1 * t.sin()) / 0.1);
    follows(&Planetary::default(), &TIMES, "planet[2].phi", |t| {
        let (sun, arm) = (0.7 * t + 0.1 * t.sin(), 0.3 * (0.7 * t + 0.1 * t.sin()));
        arm - 1.5 * (sun - arm)
    });
}

/// A pinion on a guide that turns, and a belt from the pinion to a pulley on the guide.
#[mechanism]
#[bodies(guide, rack, pinion, pulley)]
#[revolute(O: ground @ (0, 0), guide @ (0, 0))]
#[translational(slide: guide @ (0, -radius), rack @ (0, 0), axis = (2, 0))]
#[revolute(P: guide @ (0, 0), pinion @ (0, 0))]
#[rack_pinion(teeth: guide @ (0, -radius), rack @ (0, 0), axis = (2, 0), pinion = pinion, radius = radius, offset = 0.01 * t)]
#[revolute(Q: guide @ (1, 0), pulley @ (0, 0))]
#[belt(band: pinion, pulley, radii = (radius, 0.05), carrier = guide, offset = 0.002)]
#[driver(turn: guide.phi = 0.4 * t)]
#[driver(drive: pinion.phi = 1.5 * sin(t))]
struct Rack {
    #[param(0.02)]
    radius: f64,
}

#[test]
fn rack_and_belt_on_a_moving_guide() {
    let stroke = |t: f64| 0.02 * (1.5 * t.sin() - 0.4 * t) + 0.01 * t;
    follows(&Rack::default(), &TIMES, "rack.x", |t| stroke(t) * (0.4 * t).cos() + 0.02 * (0.4 * t).sin());
    follows(&Rack::default(), &TIMES, "pulley.phi", |t| (0.02 * (1.5 * t.sin() - 0.4 * t) - 0.002) / 0.05 + 0.4 * t);
}

const R: f64 = 0.04;
const E: f64 = 0.015;

/// One eccentric cam, with its contact described in four ways.
#[mechanism]
#[coordinates(u)]
#[body(cam, x = 0, y = 0)]
#[body(by_polar, x = 0, phi = 0)]
#[body(by_implicit, x = 0, phi = 0)]
#[body(by_roller, x = 0, phi = 0)]
#[body(flat, x = 0.3, phi = 0)]
#[point(hub = cam @ (0, 0))]
#[on_curve(polar_contact: hub, by_polar @ (0, 0), polar(theta) = e * cos(theta) + sqrt(r*r - pow(e * sin(theta), 2)))]
#[on_curve(implicit_contact: hub, by_implicit @ (0, 0), implicit(X, Y) = (X - e).powi(2) + Y*Y - r*r)]
#[on_curve(roller_contact: hub, by_roller @ (0, 0), parametric(u) = (e + r * cos(u), r * sin(u)), roller = -roller)]
#[flat_follower(face: hub, flat @ (0, 0), axis = (3, 0), support(theta) = r + e * cos(theta))]
#[driver(drive: cam.phi = 0.3 + t)]
#[guess(by_polar.y = r, by_implicit.y = r, by_roller.y = r, u = 1.2, flat.y = r)]
struct Cam {
    #[param(0.04)]
    r: f64,
    #[param(0.015)]
    e: f64,
    #[param(0.01)]
    roller: f64,
}

#[test]
fn cams() {
    let lift =
        |radius: f64| move |t: f64| E * (0.3 + t).sin() + (radius * radius - (E * (0.3 + t).cos()).powi(2)).sqrt();
    follows(&Cam::default(), &TIMES, "by_polar.y", lift(R));
    follows(&Cam::default(), &TIMES, "by_implicit.y", lift(R));
    follows(&Cam::default(), &TIMES, "by_roller.y", lift(R + 0.01));
    follows(&Cam::default(), &TIMES, "flat.y", |t| R + E * (0.3 + t).sin());
}

/// A disc that rolls on a table which rises and tilts, and one that rolls inside a fixed ring of twice its radius.
#[mechanism]
#[coordinates(psi)]
#[bodies(table, wheel, disc)]
#[revolute(O: ground @ (0, 0), table @ (0, 0))]
#[rolling(on_table: table @ (0, 0.1), wheel @ (0, 0), axis = (1, 0), radius = 0.2, offset = 0.5)]
#[rolling(in_ring: ground @ (5, 0), disc @ (0, 0), radii = (2, -1), along = psi)]
#[driver(tilt: table.phi = 0.2 * sin(t))]
#[driver(spin: wheel.phi = -1.5 * t)]
#[driver(round: psi = 0.8 * t)]
#[point(rim = disc @ (1, 0))]
#[guess(disc.x = 6)]
struct Rolling;

#[test]
fn rolling_discs() {
    let tilt = |t: f64| 0.2 * t.sin();
    let along = move |t: f64| 0.5 - 0.2 * (-1.5 * t - tilt(t));
    follows(&Rolling, &TIMES, "wheel.x", move |t| along(t) * tilt(t).cos() - 0.3 * tilt(t).sin());
    follows(&Rolling, &TIMES, "wheel.y", move |t| along(t) * tilt(t).sin() + 0.3 * tilt(t).cos());
    // Cardan: a rim point of a disc that rolls in a ring of twice its radius moves on a diameter.
    follows(&Rolling, &TIMES, "disc.phi", |t| -0.8 * t);
    for t in TIMES {
        let state = Rolling.solver().sweep(&[0.0, t]).expect("it rolls").states.pop().expect("two states");
        let rim = Rolling.solver().motion(&state).expect("the same")[Rolling::rim];
        assert!(rim.r[1].abs() < 1e-11 && (rim.r[0] - 5.0 - 2.0 * (0.8 * t).cos()).abs() < 1e-11, "{rim:?}");
    }
}

/// A car with steered front wheels, driven at the rear.
#[mechanism]
#[bodies(car)]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (l, 0), angle = steer)]
#[speed(drive: car @ (0, 0), value = v)]
#[guess(car.x = 1, car.y = 2, car.phi = 0.5)]
struct Car {
    #[param(2.5)]
    l: f64,
    #[param(0.3)]
    steer: f64,
    #[param(3.0)]
    v: f64,
}

#[test]
fn a_car_drives_in_a_circle() {
    let rate = 3.0 * 0.3_f64.tan() / 2.5;
    let radius = 3.0 / rate;
    follows(&Car::default(), &TIMES, "car.phi", |t| 0.5 + rate * t);
    follows(&Car::default(), &TIMES, "car.x", |t| 1.0 + radius * ((0.5 + rate * t).sin() - 0.5_f64.sin()));
    follows(&Car::default(), &TIMES, "car.y", |t| 2.0 - radius * ((0.5 + rate * t).cos() - 0.5_f64.cos()));
}

/// A wheel that rolls along a straight line: v_x = −R φ̇ written with `dot`, and a coordinate whose rate is tied to the
/// wheel's.
#[mechanism]
#[coordinates(s)]
#[body(wheel, y = 0.2)]
#[nonholonomic(roll: dot(wheel.x) + r * dot(wheel.phi) = 0)]
#[nonholonomic(follow: (1 + 0.5 * sin(t)) * dot(s) - dot(wheel.x * wheel.x) = 0.1 * t)]
#[driver(turn: wheel.phi = -2 * sin(t))]
#[guess(wheel.x = 0.3, s = 1)]
struct Wheel {
    #[param(0.2)]
    r: f64,
}

#[test]
fn rolling_by_its_velocities() {
    let x = |t: f64| 0.3 + 0.4 * t.sin();
    follows(&Wheel::default(), &TIMES, "wheel.x", x);
    let sweep = Wheel::default().kinematic_analysis(&TIMES).expect("it rolls");
    for state in &sweep {
        let t = state.t;
        let [_, rate, _] = of::<Wheel>(state, "s");
        let expected = (2.0 * x(t) * 0.4 * t.cos() + 0.1 * t) / (1.0 + 0.5 * t.sin());
        assert!((rate - expected).abs() < 1e-9, "{rate} and {expected}");
    }
}

/// A block and tackle: a load on a guide, hung on three parts of a rope that is wound up; and a family of two sledges
/// on rails, each tied by a rope of given length to a fixed point between the rails.
#[mechanism]
#[bodies(load)]
#[body(sledge[2], phi = 0.1)]
#[point(hook = load @ (0.1, 0.2))]
#[translational(guide: ground @ (0, 0), load @ (0, 0), axis = (0, 1))]
#[rope(tackle: ground @ (0.1, 0), hook, ground @ (0.1, 0), hook, length = 3*(h - 0.1*sin(t)))]
#[point_on_line(rail[i in 0..2]: ground @ (0, i), sledge[i] @ (0, 0), axis = (1, 0))]
#[rope(pull[i in 0..2]: ground @ (0, 0.5), sledge[i] @ (0, 0), length = sqrt(0.25 + pow(1 + 0.1*t*(1 + i), 2)))]
#[guess(load.y = -1, sledge[0].x = 1, sledge[1].x = 1)]
struct Ropes {
    #[param(2.0)]
    h: f64,
}

#[test]
fn a_load_hangs_on_as_many_parts_as_the_rope_has() {
    let ropes = Ropes::default();
    follows(&ropes, &TIMES, "load.y", |t| -0.2 - (2.0 - 0.1 * t.sin()));
    follows(&ropes, &TIMES, "sledge[0].x", |t| 1.0 + 0.1 * t);
    follows(&ropes, &TIMES, "sledge[1].x", |t| 1.0 + 0.2 * t);
    // A rope of negative length is an error, as for a distance.
    let error = Ropes { h: -1.0 }.state_at(&kin_runtime::Instant::at(0.0)).unwrap_err();
    assert!(error.to_string().contains("tackle"), "{error}");
}

/// A scissor jack's spindle on a frame that turns: the stroke depends on the turns relative to the guide, not to the
/// ground.
#[mechanism]
#[body(frame, x = 0.3, y = 0.1, phi = 0.4*t)]
#[body(handle, origin = frame @ (0, 0))]
#[bodies(carriage)]
#[translational(guide: frame @ (0, 0), carriage @ (0, 0), axis = (3, 4))]
#[screw(spindle: frame @ (0, 0), carriage @ (0, 0), axis = (3, 4), lead = 2*pi*p, nut = handle, offset = e)]
#[driver(turns: handle.phi = 5*t + sin(t))]
struct Spindle {
    #[param(-0.02)]
    p: f64,
    #[param(0.5)]
    e: f64,
}

#[test]
fn a_screw_moves_its_carriage_by_the_lead_with_every_turn() {
    let stroke = |t: f64| 0.5 - 0.02 * (4.6 * t + t.sin());
    let direction = 0.8_f64.atan2(0.6);
    follows(&Spindle::default(), &TIMES, "carriage.x", |t| 0.3 + stroke(t) * (direction + 0.4 * t).cos());
    follows(&Spindle::default(), &TIMES, "carriage.y", |t| 0.1 + stroke(t) * (direction + 0.4 * t).sin());
}

/// Joints to bodies whose poses are held at scalar coordinates.
#[test]
fn bodies_may_be_held_at_scalar_coordinates() {
    /// A crank of 0.5 and a rod of 1.1 move a slider along x, whose place is s.
    #[mechanism]
    #[coordinates(s)]
    #[body(slider, x = s, y = 0, phi = 0)]
    #[bodies(rod)]
    #[body(crank, x = 0, y = 0)]
    #[revolute(P: crank @ (0.5, 0), rod @ (0, 0))]
    #[revolute(Q: rod @ (1.1, 0), slider @ (0, 0))]
    #[driver(drive: crank.phi = 0.4 + t)]
    #[guess(s = 1)]
    struct Slider;

    /// A bar from the origin to a load, which a carriage on a slope carries.
    #[mechanism]
    #[coordinates(s)]
    #[body(carriage, x = s * cos(0.3), y = s * sin(0.3), phi = 0.3)]
    #[body(load, origin = carriage @ (0.1, 0))]
    #[distance(bar: ground @ (0, 0), load @ (0.2, 0), length = 2 + 0.1 * t)]
    #[driver(tilt: load.phi = 0.3 + t)]
    #[guess(s = 1)]
    struct Slope;

    /// A platform on a rocking guide: one scalar turns it, another one moves it.
    #[mechanism]
    #[coordinates(angle, s)]
    #[body(platform, x = s, y = 0.2, phi = 2 * angle)]
    #[point_on_line(guide: ground @ (0.3, 0), platform @ (0.5, 0), axis = (1, 1))]
    #[driver(turn: angle = t)]
    struct Platform;

    let times: Vec<f64> = (0..=12).map(|k| 0.05 * f64::from(k)).collect();
    let slider = |t: f64| {
        let (sin, cos) = (0.4 + t).sin_cos();
        0.5 * cos + (1.1_f64.powi(2) - (0.5 * sin).powi(2)).sqrt()
    };
    follows(&Slider, &times, "s", slider);
    // The load is at s + 0.1 along the slope, and 0.2 further in a direction that turns by t against the slope.
    let slope = |t: f64| {
        let (sin, cos) = t.sin_cos();
        ((2.0 + 0.1 * t).powi(2) - (0.2 * sin).powi(2)).sqrt() - 0.2 * cos - 0.1
    };
    follows(&Slope, &times, "s", slope);
    // The line y = x − 0.3 goes through the point.
    follows(&Platform, &times, "s", |t| 0.3 + 0.2 + 0.5 * (2.0 * t).sin() - 0.5 * (2.0 * t).cos());
    for plan in [Slider::model().plan, Slope::model().plan, Platform::model().plan] {
        assert!(plan.exists(), "{}", plan.absent.unwrap_or_default());
    }
}
