//! A disc that rolls on an inclined line of a moving body.

use kin_runtime::mechanism;

/// A disc rolls on the inclined side of a beam that swings and slides; its angle is driven.
#[mechanism]
#[bodies(beam, disc)]
#[point(rim = disc @ (0, -r))]
#[x(slide: beam @ (0.1, 0) = 0.2 * sin(t))]
#[y(height: beam @ (0.1, 0) = 0.3)]
#[angle(swing: beam = 0.3 * cos(2 * t))]
#[rolling(track: beam @ (-0.2, 0.05), disc @ (0.01, 0.02), axis = (2, 0.5), radius = r, offset = c)]
#[driver(drive: disc.phi = -1.3 * t - 0.2 * sin(3 * t))]
pub struct RollingIncline {
    /// Radius of the disc
    #[param(0.15, unit = "m")]
    pub r: f64,
    /// Position of the disc on the line when its angle equals that of the beam
    #[param(0.1, unit = "m")]
    pub c: f64,
}
