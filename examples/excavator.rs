//! Where is the bucket, and how fast, and which forces must the cylinders supply at a given load? An excavator arm
//! followed a thousand times a second from its measured cylinders.
//!
//! Nobody prescribes how this arm moves: the lengths of its three hydraulic cylinders are inputs, measured at run time
//! with their rates. A tracker follows them from one tick to the next on the branch of the first; what it cannot follow
//! is an error, after which it goes on from the last good tick. With the masses of the arm and a load in the bucket, the
//! forces of the cylinders follow from the motion.
//!
//! ```text
//!                    stick cylinder
//!                  ┌──────────────────S
//!              boom│              ╱   │╲  bucket cylinder
//!           ╱──────┴─────────────╱  stick L──┐ lever
//!          O ╲                        │ ╱    │ bucket link
//!        ══╪══╲ boom cylinder         B──────┘
//!         ground                       ╲ bucket ─ tip
//! ```
//!
//! ```text
//! cargo run --release --example excavator
//! cargo run --release --example excavator -- info
//! cargo run --release --example excavator -- solve --input boom_length=1400mm,0.1
//! cargo run --release --example excavator -- sweep --steps 10 --input boom_length=1.42,0.1
//! cargo run --release --example excavator -- forces --set load=1600
//! ```

use kin_runtime::{Instant, Kinematics, Mechanism, Options, Signal, SolveError, Tracker, mechanism};
use std::process::ExitCode;

/// Excavator arm: boom, stick, lever and bucket, moved by three cylinders whose lengths are measured.
#[mechanism(cross_check)]
#[bodies(boom, stick, lever, bucket)]
#[input(
    /// Pin to pin, from the ground to the boom
    boom_length,
    default = 1.42
)]
#[input(
    /// Pin to pin, from the boom to the stick
    stick_length,
    default = 1.94
)]
#[input(
    /// Pin to pin, from the stick to the lever
    bucket_length,
    default = 1.17
)]
#[point(tip = bucket @ (0.5, -0.2))]
#[define(digging_angle = bucket.phi)]
#[revolute(O: ground @ (0, 0.2), boom @ (0, 0))]
#[revolute(S: boom @ (boom_reach, 0.2), stick @ (0, 0))]
#[revolute(L: stick @ (1.25, 0.1), lever @ (-0.21, 0))]
#[revolute(B: stick @ (stick_reach, 0), bucket @ (-0.4, -0.1))]
#[distance(bucket_link: lever @ (0.19, 0.05), bucket @ (-0.15, 0.1), length = 0.4)]
#[distance(boom_cylinder: ground @ (0.45, -0.05), boom @ (1.4, 0.35), length = boom_length)]
#[distance(stick_cylinder: boom @ (1.5, 0.8), stick @ (-0.6, 0.15), length = stick_length)]
#[distance(bucket_cylinder: stick @ (0.25, 0.3), lever @ (0.21, 0), length = bucket_length)]
#[guess(boom.phi = 0.6, stick.phi = -1.3, lever.phi = -0.1, bucket.phi = -0.7)]
#[gravity(0, -9.81)]
#[mass(boom @ (1.5, 0.4), mass = 1100, inertia = 1300)]
#[mass(stick @ (0.4, 0.1), mass = 550, inertia = 280)]
#[mass(lever @ (0, 0), mass = 60, inertia = 2)]
#[mass(bucket @ (0.1, -0.1), mass = 420, inertia = 60)]
// What is in the bucket is carried at its tip.
#[force(carried: tip, (0, -9.81 * load))]
pub struct Excavator {
    /// From the swing frame's pin to the stick's
    #[param(3.1, unit = "m")]
    pub boom_reach: f64,
    /// From the boom's pin to the bucket's
    #[param(1.6, unit = "m")]
    pub stick_reach: f64,
    /// Load at the tip of the bucket, kg
    #[param(800)]
    pub load: f64,
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<Excavator>();
    }
    match dig(&Excavator::default()).and_then(|()| hold()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Four seconds of digging at a thousand ticks a second.
fn dig(excavator: &Excavator) -> Result<(), SolveError> {
    // A tick has little time: a step that cannot be made is given up soon.
    let options = Options { min_step: 1e-4, max_steps: 100, ..Options::default() };
    let solver = excavator.solver().with_options(options);
    let mut tracker = solver.tracker(&Instant { t: 0.0, inputs: &measured(0.0) })?;
    println!("     t     tip x     tip y     speed   digging angle");
    for tick in 0..=4000 {
        let t = 0.001 * f64::from(tick);
        tracker.update(&Instant { t, inputs: &measured(t) })?;
        if tick % 500 == 0 {
            show(&mut tracker)?;
        }
    }

    // A sensor fails for a tick: the arm cannot be where it says.
    let mut broken = measured(4.001);
    broken[Excavator::stick_length] = Signal::constant(9.0);
    if let Err(error) = tracker.update(&Instant { t: 4.001, inputs: &broken }) {
        println!("refused: {error}");
    }
    tracker.update(&Instant { t: 4.002, inputs: &measured(4.002) })?;
    println!("and on from there:");
    show(&mut tracker)
}

/// The forces with which the cylinders hold the arm at rest, at the lengths that the sensors say at first: of the boom,
/// the stick and the bucket, in N; positive where a cylinder pushes.
///
/// # Errors
/// Where the arm does not close.
pub fn holding_forces(excavator: &Excavator) -> Result<[f64; 3], SolveError> {
    let inputs = measured(0.0).map(|length| Signal::constant(length.value));
    let state = excavator.state_at(&Instant { t: 0.0, inputs: &inputs })?;
    let forces = excavator.solver().forces(&state)?;
    Ok(["boom_cylinder", "stick_cylinder", "bucket_cylinder"].map(|name| forces.effort(name).unwrap_or(f64::NAN)))
}

/// What the cylinders must supply at three loads.
fn hold() -> Result<(), SolveError> {
    println!("cylinder forces at rest, in kN:\n  load in kg      boom     stick    bucket");
    for load in [0.0, 800.0, 1600.0] {
        let excavator = Excavator { load, ..Excavator::default() };
        let [boom, stick, bucket] = holding_forces(&excavator)?.map(|force| force / 1000.0);
        println!("  {load:10.0} {boom:9.1} {stick:9.1} {bucket:9.1}");
    }
    Ok(())
}

/// What the sensors say at time t: lengths, and rates from the flow of oil.
fn measured(t: f64) -> [Signal; Excavator::INPUTS] {
    let wave = |middle: f64, stroke: f64, pace: f64| {
        let (sin, cos) = (pace * t).sin_cos();
        Signal::new(middle + stroke * sin, stroke * pace * cos, -stroke * pace * pace * sin)
    };
    let mut inputs = [Signal::default(); Excavator::INPUTS];
    inputs[Excavator::boom_length] = wave(1.42, 0.12, 0.8);
    inputs[Excavator::stick_length] = wave(1.9, -0.08, 1.3);
    inputs[Excavator::bucket_length] = wave(1.13, 0.05, 1.1);
    inputs
}

fn show(tracker: &mut Tracker<'_>) -> Result<(), SolveError> {
    let motion = tracker.motion()?;
    let tip = &motion[Excavator::tip];
    let (t, angle) = (tracker.state().t, motion[Excavator::digging_angle].value);
    println!("{t:6.3} {:9.4} {:9.4} {:9.4} {angle:15.4}", tip.r[0], tip.r[1], tip.v[0].hypot(tip.v[1]));
    Ok(())
}
