//! What is kept of a motion.

/// What is kept of a motion, one number for every row.
///
/// A quantity has the name that kin prints: `rocker.phi`, `tip.x`, a define, `slide.stroke`, each also with `_dot` or
/// `_ddot` behind it for its rate and its acceleration; `B.transmission` is the transmission angle at a joint, in [0, π],
/// `B.deviation` how far it is from π/2; where there are masses or loads, `drive.effort`, `B.force_x`, `B.force_y`,
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
