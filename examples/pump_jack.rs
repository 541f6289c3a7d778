//! A pump jack: what torque must the motor give over a turn of the crank, and how much of it does the counterweight save?
//!
//! The rods in the well hang on the beam and are heavier on the way up, when they lift oil. The counterweight on the crank
//! is to even out the torque.
//!
//! ```text
//! cargo run --release --example pump_jack
//! cargo run --release --example pump_jack -- forces --at 2
//! cargo run --release --example pump_jack -- forces --at 2 --set counterweight=0
//! ```

use kin_runtime::{Instant, Kinematics, Mechanism, mechanism};
use std::process::ExitCode;

/// A pump jack with a counterweight on its crank.
#[mechanism(cross_check)]
#[bodies(crank, pitman, beam)]
#[point(horsehead = beam @ (reach, 0))]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), pitman @ (0, 0))]
#[revolute(B: pitman @ (l, 0), beam @ (-b, 0))]
#[revolute(D: ground @ (px, py), beam @ (0, 0))]
#[driver(motor: crank.phi = omega * t)]
#[guess(pitman.phi = 1.5, beam.phi = 0)]
#[gravity(0, -9.81)]
#[mass(crank @ (1.4*r, 0), mass = counterweight, inertia = 40)]
#[mass(pitman @ (l/2, 0), mass = 350, inertia = 500)]
#[mass(beam @ (0.3, 0), mass = 2500, inertia = 9000)]
// The rods with the oil above them on the way up, the rods alone on the way down; the change takes a tenth of the speed.
#[force(rods: horsehead, (0, -9.81 * (rods + oil * (0.5 + atan(10*dot(horsehead.y)) / pi))))]
pub struct PumpJack {
    /// Crank radius
    #[param(0.9)]
    pub r: f64,
    /// Length of the pitman arm
    #[param(3.2)]
    pub l: f64,
    /// From the saddle bearing to the pitman
    #[param(2.5)]
    pub b: f64,
    /// From the saddle bearing to the horsehead
    #[param(3.0)]
    pub reach: f64,
    /// Saddle bearing, x
    #[param(2.4)]
    pub px: f64,
    /// Saddle bearing, y
    #[param(3.3)]
    pub py: f64,
    /// Counterweight on the crank, kg
    #[param(3200.0)]
    pub counterweight: f64,
    /// Rods in the well, kg
    #[param(2500.0)]
    pub rods: f64,
    /// Oil that is lifted, kg
    #[param(1500.0)]
    pub oil: f64,
    /// Crank speed
    #[param(0.9)]
    pub omega: f64,
}

/// The largest torque of the motor over a turn, in N m.
///
/// # Errors
/// Where the jack does not close.
pub fn largest_torque(jack: &PumpJack) -> Result<f64, Box<dyn std::error::Error>> {
    const STEPS: usize = 360;
    let turn = core::f64::consts::TAU / jack.omega;
    let mut largest = 0.0;
    let mut state = jack.state_at(&Instant::at(0.0))?;
    for step in 0..STEPS {
        let t = turn * step as f64 / STEPS as f64;
        state = jack.solver().state_from(&Instant::at(t), &state.q)?;
        let forces = jack.solver().forces(&state)?;
        largest = forces.effort("motor").unwrap_or(f64::INFINITY).abs().max(largest);
    }
    Ok(largest)
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<PumpJack>();
    }
    let with = PumpJack::default();
    let without = PumpJack { counterweight: 0.0, ..PumpJack::default() };
    match largest_torque(&with).and_then(|with| Ok((with, largest_torque(&without)?))) {
        Ok((with, without)) => {
            println!("{}: largest torque of the motor over a turn", PumpJack::model().name);
            println!("  with its counterweight     {:6.1} kN m", with / 1000.0);
            println!("  without                    {:6.1} kN m", without / 1000.0);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
