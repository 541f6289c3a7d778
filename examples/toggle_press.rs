//! A toggle press: what do its pins carry while the crank goes round and the ram meets 20 kN?
//!
//! Near the dead centre of the toggle a small torque presses hard, and the pins carry it.
//!
//! ```text
//! cargo run --release --example toggle_press
//! cargo run --release --example toggle_press -- forces --at 0.5
//! cargo run --release --example toggle_press -- forces --at 0.5 --set work=0
//! ```

use kin_runtime::{Instant, Kinematics, mechanism};
use std::process::ExitCode;

/// A toggle press on a crank.
#[mechanism(cross_check)]
#[bodies(crank, rod, upper, lower, ram)]
#[revolute(O: ground @ (0.8, 0.55), crank @ (0, 0))]
#[revolute(C: crank @ (r, 0), rod @ (0, 0))]
#[revolute(T: ground @ (0, 1), upper @ (0, 0))]
#[revolute(K: upper @ (0.45, 0), rod @ (0.72, 0))]
#[revolute(L: upper @ (0.45, 0), lower @ (0, 0))]
#[revolute(R: lower @ (0.45, 0), ram @ (0, 0))]
#[translational(guide: ground @ (0, 0), ram @ (0, 0), axis = (0, 1))]
#[driver(drive: crank.phi = omega * t)]
#[guess(rod.phi = 3.1, upper.phi = -1.4, lower.phi = -1.7, ram.y = 0.1)]
#[gravity(0, -9.81)]
#[mass(crank @ (0, 0), mass = 40, inertia = 1.2)]
#[mass(rod @ (0.36, 0), mass = 9, inertia = 0.4)]
#[mass(upper @ (0.225, 0), mass = 8, inertia = 0.14)]
#[mass(lower @ (0.225, 0), mass = 8, inertia = 0.14)]
#[mass(ram @ (0, -0.1), mass = 60)]
#[force(resistance: ram @ (0, -0.2), (0, work))]
pub struct TogglePress {
    /// Crank radius
    #[param(0.08)]
    pub r: f64,
    /// Crank speed
    #[param(6.0)]
    pub omega: f64,
    /// What the work piece resists with, N
    #[param(20000.0)]
    pub work: f64,
}

/// The largest force in every pin over a turn, by name, in N.
///
/// # Errors
/// Where the press does not close.
pub fn largest_pin_forces(press: &TogglePress) -> Result<Vec<(&'static str, f64)>, Box<dyn std::error::Error>> {
    const STEPS: usize = 360;
    let turn = core::f64::consts::TAU / press.omega;
    let mut largest: Vec<(&'static str, f64)> = Vec::new();
    let mut state = press.state_at(&Instant::at(0.0))?;
    for step in 0..STEPS {
        let t = turn * step as f64 / STEPS as f64;
        state = press.solver().state_from(&Instant::at(t), &state.q)?;
        for reaction in press.solver().forces(&state)?.reactions {
            let size = reaction.force.map_or(0.0, |[x, y]| x.hypot(y));
            match largest.iter_mut().find(|(name, _)| *name == reaction.name) {
                Some((_, known)) => *known = known.max(size),
                None => largest.push((reaction.name, size)),
            }
        }
    }
    Ok(largest)
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<TogglePress>();
    }
    match largest_pin_forces(&TogglePress::default()) {
        Ok(largest) => {
            println!("Toggle press: the largest force in each joint over a turn");
            for (name, force) in largest {
                println!("  {name:6} {:8.2} kN", force / 1000.0);
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
