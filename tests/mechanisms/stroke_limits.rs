//! Source: the slider-crank in closed form, x = r cos φ + √(l² − r² sin² φ).

use kin_runtime::mechanism;

/// A slider-crank with limits on its stroke, on a point, on a distance, on a define, and on limits that move.
///
/// Where the slider stands at x, the crank stands at φ = ± arccos((x² + r² − l²) / (2 r x)).
#[mechanism]
#[bodies(crank, rod, slider)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (0, 0))]
#[revolute(B: rod @ (l, 0), slider @ (0, 0))]
#[translational(guide: ground @ (0, 0), slider @ (0, 0), axis = (1, 0))]
#[driver(drive: crank.phi = omega * t)]
#[point(pin = crank @ (r, 0), eye = ground @ (0, 3*r))]
#[define(lean = -rod.phi, level = far)]
#[unilateral(
    /// The cover
    front: slider.x < far
)]
#[unilateral(back: slider.x > near)]
#[unilateral(height: pin.y < high * r)]
#[unilateral(reach: distance(pin, eye) > 2*r)]
#[unilateral(slope: lean < leaning)]
#[unilateral(moving: slider.x - l < ahead + gap * t)]
#[unilateral(mark[i in 0..3]: slider.x > marks[i])]
#[guess(rod.phi = 0, slider.x = r + l)]
pub struct StrokeLimits {
    /// Crank radius
    #[param(0.2, unit = "m")]
    pub r: f64,
    /// Rod length
    #[param(0.7, unit = "m")]
    pub l: f64,
    /// Speed of the crank
    #[param(1.0, unit = "rad/s")]
    pub omega: f64,
    /// Where the slider comes too far
    #[param(0.85, unit = "m")]
    pub far: f64,
    /// Where the slider comes too near
    #[param(0.55, unit = "m")]
    pub near: f64,
    /// Height of the pin over r
    #[param(0.8)]
    pub high: f64,
    /// Largest angle of the rod
    #[param(0.2, unit = "rad")]
    pub leaning: f64,
    /// Speed of a moving limit
    #[param(0.05, unit = "m/s")]
    pub gap: f64,
    /// Where it begins
    #[param(0, unit = "m")]
    pub ahead: f64,
    /// Marks along the guide
    #[param([0.6, 0.7, 0.8], unit = "m")]
    pub marks: [f64; 3],
}

impl StrokeLimits {
    /// The crank angle between 0 and π at which the slider is at x.
    pub fn crank_at(&self, x: f64) -> f64 {
        let (r, l) = (self.r, self.l);
        ((x * x + r * r - l * l) / (2.0 * r * x)).acos()
    }
}
