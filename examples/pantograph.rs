//! A pantograph: by which ratio does it enlarge what its stylus follows?
//!
//! By the ratio of its arms, everywhere: the fixed pin O, the stylus and the pen are always on one line, for the two bars
//! complete the arms to a parallelogram. Here the stylus is led along a heart; the pen draws it two and a half times as large.
//!
//! ```text
//!           C                   OC = CP = arm
//!         ╱   ╲                 OA = AS = arm / ratio, CB = AS, BS = AC
//!       A       B
//!     ╱   ╲   ╱   ╲
//!   O       S       P (pen)
//! ```
//!
//! The dimensions are this example's own, those of a pantograph for the desk; the principle is Christoph Scheiner's (1603).
//!
//! ```text
//! cargo run --release --example pantograph --features plot -- plot stylus pen --to 6.283 --out hearts.svg
//! cargo run --release --example pantograph -- animate --to 6.283 --out pantograph.html --set ratio=2
//! ```

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A pantograph whose stylus follows a heart.
#[mechanism]
#[bodies(arm, forearm, bar_a, bar_b)]
#[revolute(O: ground @ (0, 0), arm @ (0, 0))]
#[revolute(C: arm @ (length, 0), forearm @ (0, 0))]
#[revolute(A: arm @ (length/ratio, 0), bar_a @ (0, 0))]
#[revolute(B: forearm @ (length/ratio, 0), bar_b @ (0, 0))]
#[revolute(S: bar_a @ (length/ratio, 0), bar_b @ (length - length/ratio, 0))]
#[point(stylus = bar_a @ (length/ratio, 0))]
#[point(pen = forearm @ (length, 0))]
#[driver(across: stylus.x = at_x + size * 16 * sin(t).powi(3))]
#[driver(up: stylus.y = at_y + size * (13*cos(t) - 5*cos(2*t) - 2*cos(3*t) - cos(4*t)))]
#[guess(arm.phi = 1.2, forearm.phi = -0.6, bar_a.phi = -0.6, bar_b.phi = -2.0)]
pub struct Pantograph {
    /// Length of the arms
    #[param(0.4, unit = "m")]
    pub length: f64,
    /// How much larger than its original the drawing is
    #[param(2.5)]
    pub ratio: f64,
    /// Middle of the heart, x
    #[param(0.2, unit = "m")]
    pub at_x: f64,
    /// Middle of the heart, y
    #[param(0.02, unit = "m")]
    pub at_y: f64,
    /// Size of the heart
    #[param(0.003, unit = "m")]
    pub size: f64,
}

fn main() -> ExitCode {
    kin_runtime::cli::main::<Pantograph>()
}
