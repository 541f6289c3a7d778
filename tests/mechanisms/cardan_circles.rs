//! Discs inside a ring of twice their radius: every point of a rim moves on a diameter of the ring.

use kin_runtime::mechanism;

/// Two Cardan circles in a ring that swings and slides.
#[mechanism]
#[bodies(ring, disc[2])]
#[coordinates(psi[2])]
#[point(rim[i in 0..2] = disc[i] @ (-r, 0))]
#[point(diameter = ring @ (1, 0))]
#[x(slide: ring @ (0, 0) = 0.1 * sin(2 * t))]
#[y(height: ring @ (0, 0) = 0.05)]
#[angle(swing: ring = 0.4 * sin(t))]
#[rolling(R[i in 0..2]: ring @ (0, 0), disc[i] @ (0, 0), radii = (-2*r, r), along = psi[i])]
#[driver(drive[i in 0..2]: psi[i] = 0.3 + 1.9 * t + i * pi / 2)]
pub struct CardanCircles {
    /// Radius of the discs
    #[param(0.11, unit = "m")]
    pub r: f64,
}
