//! Hart's inversor: can a straight line be drawn with fewer links than Peaucellier's eight?
//!
//! With six. The middles of the four bars of an antiparallelogram are always on one line, and from the middle of a short
//! bar the distances to the middles of both long bars have the product (12² − 6²)/4 = 27. So these are inverse to one
//! another, and the crank, which leads one of them on a circle through the first, makes the other draw a straight line.
//!
//! ```text
//!      C                      F
//!      │ ╲                 ╱  │        CE = FD = 6, CD = EF = 12: long bars cross
//!      A     ╲    p q   ╱     │        A fixed, p led by the crank from B, AB = Bp = 2
//!      │  B     ╱    ╲        │        q draws the line, 27/4 from A
//!      E  ╱                 ╲ D
//! ```
//!
//! Dimensions: those of the first inversor in Wikipedia, "Hart's inversors", in centimetres.
//!
//! ```text
//! cargo run --release --example hart -- sweep --from 0 --to 6.283 --steps 24 --points --format csv
//! cargo run --release --example hart --features plot -- plot q.x --to 6.283 --out line.svg
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// Hart's first inversor: q draws a straight line.
#[mechanism]
#[bodies(crank, rocker, link, coupler, tie)]
#[revolute(A: ground @ (0, 0), rocker @ (0, 0))]
#[revolute(B: ground @ (base, 0), crank @ (0, 0))]
#[revolute(C: rocker @ (-short/2, 0), link @ (-long/2, 0))]
#[revolute(D: link @ (long/2, 0), tie @ (short/2, 0))]
#[revolute(E: rocker @ (short/2, 0), coupler @ (-long/2, 0))]
#[revolute(F: coupler @ (long/2, 0), tie @ (-short/2, 0))]
#[revolute(P: crank @ (base, 0), link @ (0, 0))]
#[point(p = link @ (0, 0))]
#[point(q = coupler @ (0, 0))]
#[driver(drive: crank.phi = swing * sin(omega * t))]
#[guess(rocker.phi = -1.1, link.phi = -0.46, coupler.phi = 0.46, tie.phi = -2.05)]
pub struct Hart {
    /// Fixed distance AB, and the crank
    #[param(0.02, unit = "m")]
    pub base: f64,
    /// Short bars CE and FD
    #[param(0.06, unit = "m")]
    pub short: f64,
    /// Long bars CD and EF
    #[param(0.12, unit = "m")]
    pub long: f64,
    /// Largest angle of the crank
    #[param(1.3, unit = "rad")]
    pub swing: f64,
    /// Pace of the swing
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Hart>()
}
