//! A program with several mechanisms: the first argument selects one, the others are the command line of that
//! mechanism.
//!
//! ```text
//! cargo run -p kin-tests --bin several -- fourbar solve --at 0.5
//! ```

use std::ffi::OsString;
use std::process::ExitCode;

use kin_runtime::cli::run_from;
use kin_runtime::function::FromFn;
use kin_runtime::mechanism;
use kin_tests::programs::run;

/// A follower whose lift returns a wrong second derivative.
#[mechanism]
#[function(lift)]
#[coordinates(y)]
#[driver(rise: y = lift(t))]
struct WrongCam {
    lift: FromFn<fn(f64) -> [f64; 3]>,
}

impl Default for WrongCam {
    fn default() -> Self {
        Self { lift: FromFn(|x| [x.sin(), x.cos(), -1.01 * x.sin()]) }
    }
}

/// A condition that may oscillate faster than a sweep can follow.
#[mechanism]
#[coordinates(u)]
#[driver(drive: u = t)]
#[unilateral(teeth: sin(k * u) > 0.3)]
struct Teeth {
    #[param(1)]
    k: f64,
}

/// A lever that swings, and is fastest at t = 0.
#[mechanism]
#[body(lever, x = 0, y = 0)]
#[driver(swing: lever.phi = 0.3 * sin(t))]
#[derive(Default)]
struct Lever;

/// A kite, whose two long links turn freely where the crank's pin meets the other pivot, at rest at t = 0.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.5, 0), rocker @ (0.5, 0))]
#[revolute(D: rocker @ (0, 0), ground @ (0.2, 0))]
#[driver(drive: crank.phi = t * t * t)]
#[guess(coupler.phi = 1, rocker.phi = 1)]
#[derive(Default)]
struct Kite;

/// A carriage whose coordinate is a length, driven at constant speed.
#[mechanism]
#[coordinates(s, unit = "m")]
#[driver(feed: s = w * t)]
struct Carriage {
    #[param(0.1, unit = "m/s")]
    w: f64,
}

/// A crank that becomes faster; at t = 0 it has no acceleration.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[driver(drive: crank.phi = t + t * t * t)]
#[derive(Default)]
struct Faster;

/// A beam on three equal arms, of which two would suffice, so that the pin forces are not determined, and a torsion spring.
#[mechanism(allow_redundant)]
#[bodies(a, b, c, beam)]
#[revolute(O1: ground @ (0, 0), a @ (0, 0))]
#[revolute(O2: ground @ (0.3, 0), b @ (0, 0))]
#[revolute(O3: ground @ (0.6, 0), c @ (0, 0))]
#[revolute(A: a @ (0.2, 0), beam @ (0, 0))]
#[revolute(B: b @ (0.2, 0), beam @ (0.3, 0))]
#[revolute(C: c @ (0.2, 0), beam @ (0.6, 0))]
#[driver(drive: a.phi = 1 + t)]
#[guess(a.phi = 1, b.phi = 1, c.phi = 1)]
#[gravity(0, -9.81)]
#[mass(beam @ (0.2, 0.05), mass = 3, inertia = 0.1)]
#[torsion_spring(coil: ground, a, stiffness = 0.2, damping = 0.1)]
#[derive(Default)]
struct Loaded;

/// An arm of two links that nothing drives, whose load has no value where `a` is negative.
#[mechanism]
#[bodies(upper, fore)]
#[revolute(O: ground @ (0, 0), upper @ (0, 0))]
#[revolute(E: upper @ (0.3, 0), fore @ (0, 0))]
#[gravity(0, -10)]
#[mass(upper @ (0.15, 0), mass = 2, inertia = 0.02)]
#[mass(fore @ (0.1, 0), mass = 1, inertia = 0.01)]
#[torque(T: fore = sqrt(a))]
struct Arm {
    #[param(0)]
    a: f64,
}

/// A rotor with a counterweight, whose weights and inertia do no power at all.
#[mechanism]
#[body(rotor, x = 0, y = 0)]
#[driver(drive: rotor.phi = 0.3 + 7 * t)]
#[gravity(0, -9.81)]
#[mass(rotor @ (0.3, 0), mass = m)]
#[mass(rotor @ (-0.1, 0), mass = 0.3 * m / 0.1)]
struct Balanced {
    #[param(1.7)]
    m: f64,
}

/// A slider-crank whose slider is driven, which has a dead centre where the links are in line.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[input(place)]
#[driver(push: slider.x = place)]
#[guess(crank.phi = 0.5, rod.phi = -0.1)]
#[mass(crank @ (0.1, 0), mass = 1, inertia = 0.01)]
#[gravity(0, -9.81)]
#[derive(Default)]
struct DeadCentre;

/// A follower that only its weight holds on an eccentric disc, and that lifts off where the disc falls faster.
#[mechanism]
#[bodies(cam, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(way: ground @ (0, 0), follower @ (0, 0), axis = (0, 1))]
#[flat_follower(contact: cam @ (0, 0), follower @ (0, 0), axis = (1, 0), support(theta) = 0.05 + 0.01*cos(theta))]
#[driver(drive: cam.phi = 40 * t)]
#[guess(follower.y = 0.05)]
#[gravity(0, -9.81)]
#[mass(follower @ (0, 0), mass = 2)]
#[derive(Default)]
struct Eccentric;

/// A press with a toggle whose law of motion ends at t = 2.
#[mechanism]
#[bodies(upper, lower)]
#[body(ram, x = 0, phi = 0)]
#[revolute(O: ground @ (0, 0), upper @ (0, 0))]
#[revolute(K: upper @ (0.4, 0), lower @ (0, 0))]
#[revolute(R: lower @ (0.5, 0), ram @ (0, 0))]
#[driver(push: upper.phi = -1.1 - 0.3 * sqrt(2 - t) + 0.05 * sin(upper.phi))]
#[guess(upper.phi = -1.5, lower.phi = -1.6, ram.y = -0.9)]
#[derive(Default)]
struct Press;

/// A crank that feeds a slider until the rod from it to a table lies flat, after more than a turn; only the crank turns.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(slider, y = 0, phi = 0)]
#[body(table, x = 0, phi = 0)]
#[driver(drive: crank.phi = 2 * t)]
#[constraint(feed: slider.x = size * (0.8 + lead * crank.phi))]
#[distance(rod: slider @ (0, 0), table @ (0, 0), length = 0.9 * size)]
#[guess(slider.x = 0.8 * size, table.y = 0.4 * size)]
struct Spindle {
    #[param(1)]
    size: f64,
    #[param(0.01)]
    lead: f64,
}

/// A four-bar that is a parallelogram but for a billionth, and passes the place at which it lies flat so closely that rates
/// are rounding errors there.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (0.5, 0), rocker @ (0.2 + more, 0))]
#[revolute(D: rocker @ (0, 0), ground @ (0.5, 0))]
#[driver(drive: crank.phi = t)]
#[guess(coupler.phi = 0, rocker.phi = -1)]
struct Nearly {
    #[param(1e-9)]
    more: f64,
}

/// A slider-crank with units, driven by a measured angle.
#[mechanism]
#[bodies(crank, rod)]
#[body(slider, y = 0, phi = 0)]
#[input(turn, unit = "rad", default = 0.5)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[driver(drive: crank.phi = turn)]
#[define(lean = rod.phi - crank.phi)]
#[point(middle = rod @ (l/2, 0))]
#[guess(rod.phi = -0.1, slider.x = r + l)]
struct WithUnits {
    #[param(0.2, unit = "m")]
    r: f64,
    #[param(0.7, unit = "m")]
    l: f64,
}

/// A dial whose angle is a scalar coordinate in degrees.
#[mechanism]
#[coordinates(theta, unit = "deg")]
#[coordinates(x, y, unit = "mm")]
#[driver(drive: theta = turned + 360 * n * t)]
#[constraint(across: x = r * cos(theta * pi / 180))]
#[constraint(along: y = r * sin(theta * pi / 180))]
struct Dial {
    #[param(40, unit = "mm")]
    r: f64,
    #[param(0.5, unit = "1/s")]
    n: f64,
    #[param(0, unit = "deg")]
    turned: f64,
}

/// A spindle that counts its turns and feeds a nut.
#[mechanism]
#[coordinates(turns, unit = "rev")]
#[coordinates(nut, unit = "mm")]
#[driver(drive: turns = n * t)]
#[constraint(thread: nut = lead * turns)]
struct Counter {
    #[param(2, unit = "rev/s")]
    n: f64,
    #[param(4, unit = "mm/rev")]
    lead: f64,
}

/// A follower on an eccentric disc that swings between two limits at t = -2 and t = 2, and lifts off where it falls fast.
#[mechanism]
#[bodies(cam, follower)]
#[revolute(O: ground @ (0, 0), cam @ (0, 0))]
#[translational(way: ground @ (0, 0), follower @ (0, 0), axis = (0, 1))]
#[flat_follower(contact: cam @ (0, 0), follower @ (0, 0), axis = (1, 0), support(theta) = 0.05 + 0.01*cos(theta))]
#[driver(drive: cam.phi = 40 * t + sqrt(4 - t * t))]
#[unilateral(late: cam.phi > 42)]
#[unilateral(early: cam.phi < -38)]
#[unilateral(past: cam.phi > 2)]
#[guess(follower.y = 0.05)]
#[gravity(0, -9.81)]
#[mass(follower @ (0, 0), mass = 2)]
#[derive(Default)]
struct Swinging;

/// A slider-crank whose slider is pushed from one dead centre, at t = -3, to the other, at t = 1.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[bodies(rod)]
#[body(slider, y = 0, phi = 0)]
#[revolute(A: crank @ (0.2, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7, 0), slider @ (0, 0))]
#[driver(push: slider.x = start + 0.1 * t)]
#[unilateral(low: slider.x > least)]
#[unilateral(high: slider.x < 0.85)]
#[guess(crank.phi = 0.5, rod.phi = -0.2, slider.x = 0.8)]
struct Pushed {
    #[param(0.8)]
    start: f64,
    #[param(0.6)]
    least: f64,
}

/// Two waves that end at a limit; the first has many crests of nearly one height, the second is highest at the limit.
#[mechanism]
#[coordinates(u, x)]
#[driver(drive: u = t)]
#[constraint(circle: x * x + u * u = r * r)]
#[define(crests = sin(60 * u) + 0.003 * sin(u + 0.3))]
#[define(rising = sin(4.5 * pi * u / r) * (1 + 0.001 * u))]
#[guess(x = r)]
struct Waves {
    #[param(1)]
    r: f64,
}

/// A sun whose origin is beside its axle, and two drivers of the sum and of the difference of two angles.
#[mechanism]
#[bodies(sun, planet, arm)]
#[revolute(S: ground @ (1, 2), sun @ (0.5, 0.25))]
#[revolute(H: ground @ (1, 2), arm @ (0, 0))]
#[revolute(Q: arm @ (3, 0), planet @ (0.2, 0))]
#[gear(mesh: sun, planet, radii = (20, 10), carrier = arm)]
#[driver(sum: sun.phi + arm.phi = 2 * t)]
#[driver(difference: arm.phi - sun.phi = -1.5 * t)]
#[mass(sun @ (0, 0), mass = 1, inertia = 1)]
#[gravity(0, -10)]
#[derive(Default)]
struct Sun;

/// A slider-crank of any size whose guide passes the crank at a distance, with a point on the crank.
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (0.2 * size, 0), rod @ (0, 0))]
#[revolute(B: rod @ (0.7 * size, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0.1 * size), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = t)]
#[point(pin = crank @ (0.2 * size, 0))]
#[guess(rod.phi = -0.1, slider.x = 0.9 * size)]
struct Sized {
    #[param(1, unit = "m")]
    size: f64,
}

/// A boom on a rope from a point beside its foot, which has to push once the boom leans to the other side.
#[mechanism]
#[bodies(boom)]
#[input(l, unit = "m")]
#[revolute(foot: ground @ (0, 0), boom @ (0, 0))]
#[rope(stay: ground @ (-r, 0), boom @ (r, 0), length = l)]
#[guess(boom.phi = 1.2)]
#[gravity(0, -9.81)]
#[mass(boom @ (r, 0), mass = m)]
struct Boom {
    #[param(1, unit = "m")]
    r: f64,
    #[param(2, unit = "kg")]
    m: f64,
}

fn main() -> ExitCode {
    let mut args: Vec<OsString> = std::env::args_os().collect();
    let name = if args.len() > 1 { args.remove(1) } else { OsString::new() };
    match name.to_str() {
        Some("arm") => run_from::<Arm>(args),
        Some("balanced") => run_from::<Balanced>(args),
        Some("boom") => run_from::<Boom>(args),
        Some("carriage") => run_from::<Carriage>(args),
        Some("cam") => run("CamTable", args),
        Some("counter") => run_from::<Counter>(args),
        Some("chain") => run("Chain10", args),
        Some("wrong_cam") => run_from::<WrongCam>(args),
        Some("dead_centre") => run_from::<DeadCentre>(args),
        Some("dial") => run_from::<Dial>(args),
        Some("eccentric") => run_from::<Eccentric>(args),
        Some("excavator") => run("MeasuredExcavator", args),
        Some("fourbar") => run("FourbarLectureMid", args),
        Some("ends") => run("FourbarEnds", args),
        Some("faster") => run_from::<Faster>(args),
        Some("kite") => run_from::<Kite>(args),
        Some("lever") => run_from::<Lever>(args),
        Some("leg") => run("FiveBarLeg", args),
        Some("infeasible") => run("InfeasibleFourbar", args),
        Some("limits") => run("StrokeLimits", args),
        Some("loaded") => run_from::<Loaded>(args),
        Some("nearly") => run_from::<Nearly>(args),
        Some("press") => run_from::<Press>(args),
        Some("pushed") => run_from::<Pushed>(args),
        Some("redundant") => run("RedundantParallelogram", args),
        Some("robot") => run("Robot3rrr", args),
        Some("singular") => run("SingularSliderCrank", args),
        Some("spindle") => run_from::<Spindle>(args),
        Some("swinging") => run_from::<Swinging>(args),
        Some("teeth") => run_from::<Teeth>(args),
        Some("underdriven") => run("UnderdrivenFivebar", args),
        Some("sized") => run_from::<Sized>(args),
        Some("sun") => run_from::<Sun>(args),
        Some("waves") => run_from::<Waves>(args),
        Some("with_units") => run_from::<WithUnits>(args),
        _ => {
            eprintln!(
                "error: the first argument is arm, balanced, cam, carriage, chain, counter, wrong_cam, dead_centre, dial, eccentric, excavator, fourbar, ends, faster, infeasible, kite, leg, lever, limits, loaded, nearly, press, pushed, redundant, robot, singular, sized, spindle, sun, swinging, teeth, underdriven, waves or with_units"
            );
            ExitCode::from(2)
        }
    }
}
