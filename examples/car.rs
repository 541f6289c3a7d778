//! A car backs into a parking space: where does it end?
//!
//! Four wheels that roll without slipping sideways are two knife edges, one on each axle; the front one is steered by a
//! function of time, and the speed of the rear axle is given. None of these rows says where the car is, only which way it
//! can go: its place is the integral of its motion.
//!
//! ```text
//!        y                  ╱ angle = steering
//!        │      ┌───────────╱──┐
//!        │      │ rear     ╱   │          η = −ẋ_P sin ψ + ẏ_P cos ψ = 0 at rear and front
//!        │   ───o─────────o────┤          η =  ẋ_P cos ψ + ẏ_P sin ψ − v = 0 at rear
//!        │      │        front │          ψ = car.phi + angle
//!        │      └──────────────┘
//!        └──────────────────────── x
//! ```
//!
//! ```text
//! cargo run --release --example car
//! cargo run --release --example car -- sweep --from 0 --to 6 --steps 60 --format csv
//! cargo run --release --example car -- sweep --from 0 --to 6 --steps 6 --set lock=0.3 --guess car.x=10
//! cargo run --release --example car -- info
//! ```

use kin_runtime::{Kinematics, SweepError, Trajectory, mechanism};
use std::f64::consts::TAU;
use std::process::ExitCode;

/// A car that backs up, steering first to one side and then to the other.
#[mechanism(cross_check)]
#[bodies(car)]
#[define(steering = lock * sin(2 * pi * t / duration))]
#[point(nose = car @ (wheelbase + 0.9, 0))]
#[knife_edge(rear: car @ (0, 0))]
#[knife_edge(front: car @ (wheelbase, 0), angle = steering)]
#[speed(engine: car @ (0, 0), value = -v)]
#[guess(car.x = 0, car.y = 0, car.phi = 0)]
pub struct Car {
    /// Distance of the axles
    #[param(2.6, unit = "m")]
    pub wheelbase: f64,
    /// Largest steering angle
    #[param(0.6, unit = "rad")]
    pub lock: f64,
    /// Speed of the rear axle, backwards
    #[param(1.2, unit = "m/s")]
    pub v: f64,
    /// Time of the manoeuvre
    #[param(6.0, unit = "s")]
    pub duration: f64,
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Car>();
    }
    let car = Car::default();
    match park(&car) {
        Ok(path) => {
            report(&car, &path);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn park(car: &Car) -> Result<Trajectory, SweepError> {
    let times: Vec<f64> = (0..=12).map(|k| car.duration * f64::from(k) / 12.0).collect();
    car.kinematic_analysis(&times)
}

fn report(car: &Car, path: &Trajectory) {
    println!("     t    steering       x         y       phi");
    for state in path {
        let steering = car.lock * (TAU * state.t / car.duration).sin();
        println!("{:6.2} {steering:10.4} {:9.4} {:9.4} {:9.4}", state.t, state.q[0], state.q[1], state.q[2]);
    }
    if let Some(end) = path.last() {
        println!("back by {:.4} m, aside by {:.4} m, turned by {:.1e} rad", -end.q[0], end.q[1], end.q[2]);
    }
}
