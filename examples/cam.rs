//! One cam under a flat tappet and under a roller rocker: which lift, velocity and acceleration does each get?
//!
//! The cam is known by its support function h(θ) = r + a cos θ + b cos 2θ: the distance from the shaft of the tangent
//! whose outward normal has the direction θ in the cam. A flat face needs no more than that, in one row. A roller runs on
//! the outline c = h n + h′ perp(n), a parametric curve; counter-clockwise, so that its outside is on the right and R is
//! negative there.
//!
//! ```text
//!                      ═══════●═══ tappet        o────── rocker
//!                          .─────.             ( R )
//!                        ( ·───▶ θ=0 )────────▶ c(u)
//!                          `─────´
//! ```
//!
//! ```text
//! cargo run --release --example cam
//! cargo run --release --example cam -- sweep --from 0 --to 0.02 --steps 100 --format csv
//! cargo run --release --example cam -- solve --at 0.004 --set b=0.002
//! ```

use kin_runtime::{Instant, Kinematics, Mechanism, mechanism};
use std::process::ExitCode;

/// A disc cam with a flat-faced tappet above it and a roller rocker at its side.
#[mechanism(cross_check)]
#[body(cam, x = 0, y = 0)]
#[body(tappet, x = 0, phi = 0)]
#[body(rocker, x = 0.07, y = -0.06)]
#[coordinates(u)]
#[flat_follower(face: cam @ (0, 0), tappet @ (0, 0), axis = (1, 0), support(theta) = r + a*cos(theta) + b*cos(2*theta))]
#[on_curve(roll: cam @ (0, 0), rocker @ (l, 0), parametric(u) = (
    (r + a*cos(u) + b*cos(2*u)) * cos(u) + (a*sin(u) + 2*b*sin(2*u)) * sin(u),
    (r + a*cos(u) + b*cos(2*u)) * sin(u) - (a*sin(u) + 2*b*sin(2*u)) * cos(u),
), roller = -roller)]
#[driver(shaft: cam.phi = 2*pi*rpm/60 * t)]
#[define(lift = tappet.y - (r - a + b))]
#[guess(tappet.y = r, rocker.phi = 2.0, u = -0.3)]
pub struct Cam {
    /// Mean radius of the cam
    #[param(0.03, unit = "m")]
    pub r: f64,
    /// Eccentricity
    #[param(0.006, unit = "m")]
    pub a: f64,
    /// Second harmonic, which makes the nose pointed and the back flat
    #[param(0.0015, unit = "m")]
    pub b: f64,
    /// Length of the rocker's arm
    #[param(0.07, unit = "m")]
    pub l: f64,
    /// Radius of the rocker's roller
    #[param(0.01, unit = "m")]
    pub roller: f64,
    /// Speed of the shaft
    #[param(3000, unit = "rpm")]
    pub rpm: f64,
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Cam>();
    }
    let cam = Cam::default();
    let turn = 60.0 / cam.rpm;
    let times: Vec<f64> = (0..=24).map(|k| turn * f64::from(k) / 24.0).collect();
    let revolution = match cam.kinematic_analysis(&times) {
        Ok(revolution) => revolution,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let solver = cam.solver();
    println!(" cam °   lift mm      m/s     m/s²   rocker °    rad/s    rad/s²");
    for (k, state) in revolution.iter().enumerate() {
        let Ok(motion) = solver.motion(state) else { return ExitCode::FAILURE };
        let (lift, rocker) = (motion[Cam::lift], motion[Cam::rocker]);
        println!(
            "{:6} {:9.3} {:8.3} {:8.0} {:10.2} {:8.2} {:9.0}",
            15 * k,
            1e3 * lift.value,
            lift.rate,
            lift.acceleration,
            rocker.phi.to_degrees(),
            rocker.phi_dot,
            rocker.phi_ddot
        );
    }
    // The outline, as a drawing needs it: the farthest point from the shaft is the nose.
    let Some(face) = Cam::model().joints.iter().position(|joint| joint.name == "face") else {
        return ExitCode::FAILURE;
    };
    let points = (0..360).map(|degrees| cam.curve_point(&Instant::at(0.0), face, f64::from(degrees).to_radians()));
    let radii = points.filter_map(Result::ok).flatten().map(|point| point.r[0].hypot(point.r[1]));
    let (smallest, largest) = radii.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), r| (a.min(r), b.max(r)));
    println!("the cam reaches from {:.2} mm to {:.2} mm around its shaft", 1e3 * smallest, 1e3 * largest);
    ExitCode::SUCCESS
}
