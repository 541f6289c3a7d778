//! Consistent units in various notations: each mechanism here compiles with `check_units`.
#![deny(missing_docs, warnings)]

use kin_runtime::{Kinematics, Signal, mechanism};
use kin_tests::works;

/// The lecture's four-bar, with literal numbers among the lengths.
#[mechanism(check_units)]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (-l1/2, 0))]
#[revolute(A: crank @ (l1/2, 0), coupler @ (-l2/2, 0))]
#[revolute(B: coupler @ (l2/2, 0), rocker @ (-l3/2, 0))]
#[revolute(D: rocker @ (l3/2, 0), ground @ (0.4, 2*d2))]
#[driver(drive: crank.phi = pi/4 + omega * t + alpha*t*t/2)]
#[point(tip = coupler @ (0, 0.1))]
#[define(reach = sqrt(pow(tip.x, 2) + tip.y*tip.y) - l1)]
#[define(slope = atan2(tip.y, tip.x - 0.1) + acos(tip.x/l2/4))]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0, rocker.x = l2)]
struct FourBar {
    #[param(0.1, unit = "m")]
    l1: f64,
    #[param(0.4, unit = "m")]
    l2: f64,
    #[param(0.3, unit = "m")]
    l3: f64,
    #[param(0.05, unit = "m")]
    d2: f64,
    #[param(1.5, unit = "rad/s")]
    omega: f64,
    #[param(0.5, unit = "s⁻²")]
    alpha: f64,
}

/// Every factor as a hint names it.
#[mechanism(check_units)]
#[body(handle, x = 0, y = 0)]
#[bodies(jaw)]
#[coordinates(u[6])]
#[translational(guide: ground @ (0, 0), jaw @ (0, 0), axis = (1, 0))]
#[screw(spindle: ground @ (0, 0), jaw @ (0, 0), axis = (1, 0), lead = lead, nut = handle)]
#[driver(turns: handle.phi = slope*pi/180 + n*2*pi/60*t)]
#[define(degrees = handle.phi*180/pi, unit = "deg")]
#[define(travel = l + lead*360*pi/180, unit = "mm")]
#[constraint(slow: u[0] = fast + feed/(60*1000))]
#[constraint(road: u[1] = fast + road*1000/3600)]
#[constraint(length: u[2] = l + inch*25.4)]
#[constraint(area: u[3] = l*l + inch*foot*25.4*12*25.4)]
#[constraint(speed: u[4] = n + omega*60/(2*pi))]
#[constraint(twist: u[5] = k + per_degree*180/pi)]
struct Factors {
    #[param(1, unit = "mm")]
    l: f64,
    #[param(1, unit = "in")]
    inch: f64,
    #[param(1, unit = "ft")]
    foot: f64,
    #[param(4, unit = "mm/rev")]
    lead: f64,
    #[param(1, unit = "m/s")]
    fast: f64,
    #[param(6000, unit = "mm/min")]
    feed: f64,
    #[param(3.6, unit = "km/h")]
    road: f64,
    #[param(60, unit = "rpm")]
    n: f64,
    #[param(1, unit = "rad/s")]
    omega: f64,
    #[param(30, unit = "deg")]
    slope: f64,
    #[param(1, unit = "N*mm/rad")]
    k: f64,
    #[param(1, unit = "N*mm/deg")]
    per_degree: f64,
}

/// Millimetres, revolutions per minute, degrees and numbers of teeth; literal numbers as quantities.
#[mechanism(check_units)]
#[bodies(motor, wheel, rack)]
#[revolute(O: ground @ (0, 0), motor @ (0, 0))]
#[revolute(W: ground @ (centre, 0), wheel @ (0, 0))]
#[gear(mesh: motor, wheel, radii = (z1, z2), offset = 0.5*z1)]
#[translational(guide: ground @ (0, 0), rack @ (0, 0), axis = (cos(tilt*pi/180), sin(tilt*pi/180)))]
#[rack_pinion(feed: ground @ (0, 0), rack @ (0, 0), axis = (cos(tilt*pi/180), sin(tilt*pi/180)), pinion = wheel, radius = r)]
#[driver(drive: motor.phi = n*2*pi/60*t + 0.1*sin(3*t) + phase)]
#[unilateral(stop: rack.x < 0.2*1000 + travel*1000)]
struct Machine {
    #[param(120, unit = "mm")]
    centre: f64,
    #[param(20)]
    z1: f64,
    #[param(40)]
    z2: f64,
    #[param(30, unit = "mm")]
    r: f64,
    #[param(15, unit = "deg")]
    tilt: f64,
    #[param(60, unit = "rpm")]
    n: f64,
    #[param(0.1, unit = "rad")]
    phase: f64,
    #[param(0.5, unit = "m")]
    travel: f64,
}

/// Velocities, inputs and coordinates without units of their own.
#[mechanism(check_units)]
#[bodies(skate)]
#[coordinates(u)]
#[input(feed)]
#[knife_edge(blade: skate @ (0, 0), angle = 0)]
#[speed(run: skate @ (0, 0), angle = 0, value = v + a*t)]
#[nonholonomic(turn: dot(skate.phi) = v/r)]
#[constraint(any: u = feed + v*t)]
struct Skate {
    #[param(1, unit = "m/s")]
    v: f64,
    #[param(0.1, unit = "m*s^-2")]
    a: f64,
    #[param(2, unit = "m")]
    r: f64,
}

/// Feet and inches, converted into one another and into metres.
#[mechanism(check_units)]
#[coordinates(u[3])]
#[constraint(inches: u[0] = wide - 12 * high)]
#[constraint(feet: u[1] = high - wide / 12)]
#[constraint(metres: u[2] = long - 0.3048 * high)]
struct Feet {
    #[param(30, unit = "in")]
    wide: f64,
    #[param(2, unit = "ft")]
    high: f64,
    #[param(1, unit = "m")]
    long: f64,
}

#[test]
fn units_that_agree_are_no_errors() {
    works(&FourBar::default());
    works(&Machine::default());
    works(&Feet::default());
    works(&Factors::default());
    let signal = [Signal { value: 1.0, rate: 0.0, acceleration: 0.0 }];
    let state = Skate::default().state_at(&kin_runtime::Instant { t: 0.0, inputs: &signal }).unwrap();
    assert!((state.q[3] - 1.0).abs() < 1e-12);
}
