//! A straight line, found: which four-bar draws the straightest line, four cranks long, during half a turn of its crank?
//!
//! Hoecken's linkage (example `hoecken`) is the textbook's answer, of which only two ratios are chosen. Here all lengths and
//! the place of the point on the coupler are free, and nothing of the answer is known: the search begins at random.
//!
//! ```text
//!                T
//!              ╱             wanted: T.y is the same at all instants of half a turn,
//!            B                       and T.x changes by four cranks meanwhile
//!          ╱   ╲
//!        A       ╲
//!      O           C
//! ```
//!
//! ```text
//! cargo run --release --example straight_line --features design
//! cargo run --release --example straight_line --features design -- design --help
//! ```

use kin_runtime::design::{Design, DesignError, Designed, Number, Search};
use kin_runtime::{Kinematics, Scalar, mechanism};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::process::ExitCode;

/// A four-bar with a point anywhere on its coupler; the crank has the length 1.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l, 0), rocker @ (0, 0))]
#[revolute(C: ground @ (d, 0), rocker @ (c, 0))]
#[point(T = coupler @ (u, v))]
#[driver(drive: crank.phi = phi0 + t)]
#[guess(coupler.phi = 1, rocker.phi = 4.5)]
#[derive(Debug)]
pub struct StraightLine {
    /// From shaft to rocker pin
    #[param(2.2)]
    pub d: f64,
    /// Coupler, from crank to rocker
    #[param(2.8)]
    pub l: f64,
    /// Rocker
    #[param(2.8)]
    pub c: f64,
    /// The point on the coupler, along it
    #[param(5.0)]
    pub u: f64,
    /// The point on the coupler, across it
    #[param(0.5)]
    pub v: f64,
    /// Angle of the crank at the beginning of the line
    #[param(1.6)]
    pub phi0: f64,
}

/// Instants of the half turn.
const INSTANTS: usize = 19;
/// How long the line is to be, in cranks.
const LENGTH: f64 = 4.0;

/// The four-bar that draws the straightest line.
///
/// # Errors
/// As the search.
pub fn found() -> Result<Designed<StraightLine>, DesignError> {
    let times: Vec<f64> = (0..INSTANTS).map(|k| PI * k as f64 / (INSTANTS - 1) as f64).collect();
    // Of every instant T.x and T.y: heights beside the mean height are to be 0, and the length what is wanted.
    let line = |at: &[Vec<Number>]| {
        let number = Number::from_f64;
        let mean = at.iter().fold(number(0.0), |sum, place| sum + place[1]) / number(at.len() as f64);
        let heights = at.iter().map(|place| place[1] - mean);
        let length = (at[0][0] - at[at.len() - 1][0]).abs() - number(LENGTH);
        heights.chain([length]).collect()
    };
    Design::new(&StraightLine::default())
        .free("d", 1.0..=4.0)?
        .free("l", 1.0..=4.0)?
        .free("c", 1.0..=4.0)?
        .free("u", -8.0..=8.0)?
        .free("v", -8.0..=8.0)?
        .free("phi0", FRAC_PI_2 - PI..=FRAC_PI_2 + PI)?
        .residuals(&["T.x", "T.y"], &times, line)?
        .turns(TAU, 25, 0.02)?
        .transmission("B", 15_f64.to_radians(), TAU, 37)?
        .search(&Search { starts: 100, ..Search::default() })
}

/// How far T.y goes during the half turn, and how far T.x.
///
/// # Panics
/// Where the mechanism does not move through it, which a design does.
pub fn extent(mechanism: &StraightLine) -> [f64; 2] {
    let times: Vec<f64> = (0..=720).map(|k| PI * f64::from(k) / 720.0).collect();
    let motion = mechanism.kinematic_analysis(&times).expect("a design moves");
    let range = |axis: usize| {
        let values = motion.states.iter().map(|state| state[StraightLine::T].r[axis]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        high - low
    };
    [range(1), range(0)]
}

fn main() -> ExitCode {
    if std::env::args().len() > 1 {
        return kin_runtime::cli::main::<StraightLine>();
    }
    match found() {
        Ok(found) => {
            let [height, length] = extent(&found.mechanism);
            println!("{found}\n");
            println!(
                "A line of {length:.4} cranks that is {height:.2e} cranks high: 1 part in {:.0}.",
                length / height
            );
            println!(
                "Hoecken's line, 4.18 cranks long, is 1 part in 1042; its transmission angle stays above 23 degrees, this one above 15."
            );
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
