//! A data set of six-bars in the style of LINKS (Heyrani Nobari et al., 2022): random linkages of Stephenson's third kind
//! whose cranks go all the way round, with the path of a point at 200 instants. A four-bar moves a dyad by its coupler point.
//!
//! ```text
//! cargo run --release --example six_bar -- run examples/six_bar.toml --out target/six_bar
//! cargo run --release --example six_bar -- run examples/six_bar.toml --rows 1e6 --out target/million
//! ```
//!
//! `target/six_bar` holds Parquet files that any library reads: pandas, polars, DuckDB.

use kin_runtime::mechanism;
use std::process::ExitCode;

/// A six-bar of Stephenson's third kind, on a ground of length 1.
#[mechanism]
#[bodies(crank, coupler, rocker, link, swing)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l2, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (l3, 0), ground @ (1, 0))]
#[revolute(E: coupler @ (u, v), link @ (0, 0))]
#[revolute(F: link @ (l5, 0), swing @ (0, 0))]
#[revolute(G: swing @ (l6, 0), ground @ (gx, gy))]
#[driver(drive: crank.phi = t)]
#[point(tip = link @ (p, q))]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0, link.phi = 0.5, swing.phi = 5.0)]
pub struct SixBar {
    /// Crank
    #[param(0.3)]
    pub l1: f64,
    /// Coupler
    #[param(0.9)]
    pub l2: f64,
    /// Rocker
    #[param(0.8)]
    pub l3: f64,
    /// The dyad's pin on the coupler, along it
    #[param(0.5)]
    pub u: f64,
    /// The dyad's pin on the coupler, across
    #[param(0.3)]
    pub v: f64,
    /// First link of the dyad
    #[param(1.0)]
    pub l5: f64,
    /// Second link of the dyad
    #[param(1.0)]
    pub l6: f64,
    /// The dyad's pin on the ground, x
    #[param(1.5)]
    pub gx: f64,
    /// The dyad's pin on the ground, y
    #[param(0.5)]
    pub gy: f64,
    /// The point on the dyad's first link, along it
    #[param(0.5)]
    pub p: f64,
    /// The point on the dyad's first link, across
    #[param(0.3)]
    pub q: f64,
}

fn main() -> ExitCode {
    kin_study::main::<SixBar>()
}
