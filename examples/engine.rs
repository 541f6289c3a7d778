//! An engine on its feet: how much does it shake, and what does a counterweight on the crank take away?
//!
//! The shaking force is what the engine exerts on the ground; of motion alone it is −Σ m a. A counterweight on the crank
//! balances what turns, and half of what goes to and fro.
//!
//! ```text
//! cargo run --release --example engine
//! cargo run --release --example engine -- forces --at 0.01
//! cargo run --release --example engine -- forces --at 0.01 --set counterweight=0
//! ```

use kin_runtime::{Instant, Kinematics, mechanism};
use std::process::ExitCode;

/// A single cylinder engine with a counterweight.
#[mechanism(cross_check)]
#[bodies(crank, rod, piston)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), piston @ (0, 0))]
#[translational(cylinder: ground @ (0, 0), piston @ (0, 0), axis = (0, 1))]
#[driver(speed: crank.phi = omega * t)]
#[guess(rod.phi = 1.5, piston.y = r + l)]
#[gravity(0, -9.81)]
#[mass(crank @ (0, 0), mass = 4, inertia = 0.01)]
#[mass(crank @ (-r, 0), mass = counterweight)]
#[mass(rod @ (0.3*l, 0), mass = 0.6, inertia = 0.002)]
#[mass(piston @ (0, 0.02), mass = 0.5)]
pub struct Engine {
    /// Crank radius
    #[param(0.045)]
    pub r: f64,
    /// Rod length
    #[param(0.15)]
    pub l: f64,
    /// Counterweight opposite of the crank pin, kg
    #[param(0.76)]
    pub counterweight: f64,
    /// Crank speed
    #[param(300.0)]
    pub omega: f64,
}

/// The largest shaking force of motion over a turn, in N.
///
/// # Errors
/// Where the engine does not close.
pub fn largest_shaking(engine: &Engine) -> Result<f64, Box<dyn std::error::Error>> {
    const STEPS: usize = 360;
    let turn = core::f64::consts::TAU / engine.omega;
    let mut largest: f64 = 0.0;
    let mut state = engine.state_at(&Instant::at(0.0))?;
    for step in 0..STEPS {
        let t = turn * step as f64 / STEPS as f64;
        state = engine.solver().state_from(&Instant::at(t), &state.q)?;
        let [x, y] = engine.solver().forces(&state)?.inertia.force;
        largest = largest.max(x.hypot(y));
    }
    Ok(largest)
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Engine>();
    }
    let with = Engine::default();
    let without = Engine { counterweight: 0.0, ..Engine::default() };
    match largest_shaking(&with).and_then(|with| Ok((with, largest_shaking(&without)?))) {
        Ok((with, without)) => {
            println!("Engine: largest shaking force over a turn");
            println!("  with its counterweight  {with:8.0} N");
            println!("  without                 {without:8.0} N");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
