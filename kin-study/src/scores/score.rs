//! What is kept of a motion.

/// What is kept of a motion, one number for every row.
///
/// A quantity has the name that kin prints: `rocker.phi`, `tip.x`, a define, `slide.stroke`, each also with `_dot` or
/// `_ddot` behind it for its rate and its acceleration; `tip.speed`; `B.transmission` is the transmission angle at a joint,
/// in [0, π] (`B.transmission_A_D` where it has several), `B.deviation` how far it is from π/2; where there are masses or loads, `drive.effort`, `B.force_x`, `B.force_y`,
/// `B.force`, `B.moment`, the tension of a spring, `shaking.force` and `shaking.moment`. Between bars (`|tip.x_ddot|`) its
/// magnitude is meant. Units follow the parameters, angles are in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Score {
    /// The least value over the instants.
    Least(String),
    /// The greatest value over the instants.
    Greatest(String),
    /// The mean over the instants, each with the same weight.
    Mean(String),
    /// The greatest value less the least.
    Range(String),
    /// The first instant t of the least value.
    TimeOfLeast(String),
    /// The first instant t of the greatest value.
    TimeOfGreatest(String),
    /// The value at one of the instants.
    At {
        /// The quantity.
        of: String,
        /// The instant, one of those of the motion.
        t: f64,
    },
    /// How far the path of a named point stays away from given points: of every given point the distance to the nearest
    /// place that the point reaches at an instant.
    Distance {
        /// The point of the mechanism.
        point: String,
        /// The given points.
        to: Vec<[f64; 2]>,
        /// How the distances become one number.
        measure: Measure,
    },
    /// The path of a named point: a list of x and y at every instant, as numbers of 32 bits.
    Path {
        /// The point of the mechanism.
        point: String,
        /// Moved, turned and scaled so that paths of one shape are alike: their mean is the origin, their distance from it is
        /// 1 in the root of the mean square, and the axis along which they extend farthest is x, with the longer tail in
        /// positive direction. They are not mirrored, and begin where they begin.
        normalised: bool,
    },
}

impl Score {
    /// How many numbers the list of a path has over so many instants; none for a number.
    pub(crate) fn list(&self, instants: usize) -> Option<usize> {
        matches!(self, Self::Path { .. }).then_some(2 * instants)
    }
}

/// How the distances of several points become one number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The greatest of them.
    #[default]
    Greatest,
    /// The root of the mean of their squares.
    RootMeanSquare,
}
