//! What is kept of a motion.

/// What is kept of a motion: one number for every row, or a list for a path.
///
/// A quantity has the name that kin prints: `rocker.phi`, `tip.x`, a define, `slide.stroke`, each also with the suffix
/// `_dot` or `_ddot` for its rate and its acceleration; `tip.speed`; `B.transmission` for the transmission angle at a
/// joint, in [0, π] (`B.transmission_A_D` if the joint has several), and `B.deviation` for its distance from π/2; with
/// masses or loads also `drive.effort`, `B.force_x`, `B.force_y`, `B.force`, `B.moment`, the tension of a spring,
/// `shaking.force` and `shaking.moment`. A name between bars (`|tip.x_ddot|`) stands for the absolute value. Units
/// follow the parameters, angles are in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Score {
    /// The least value over the instants.
    Least(String),
    /// The greatest value over the instants.
    Greatest(String),
    /// The mean over the instants, each with the same weight.
    Mean(String),
    /// The greatest value minus the least.
    Range(String),
    /// The first instant t of the least value.
    TimeOfLeast(String),
    /// The first instant t of the greatest value.
    TimeOfGreatest(String),
    /// The value at one of the instants.
    At {
        /// The quantity.
        of: String,
        /// The instant, which must be one of those of the motion.
        t: f64,
    },
    /// How far given points are from the path of a named point: for every given point, its distance from the nearest
    /// position of the named point at an instant.
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
        /// Whether the path is moved, turned and scaled so that paths of the same shape become equal: the mean of its
        /// points is the origin, the root mean square of their distances from it is 1, and x is the principal axis of
        /// the greatest second moment, with a third moment along it that is not negative. It is not mirrored, and its
        /// first point stays the first.
        normalised: bool,
    },
}

impl Score {
    /// The length of the list of a path over this number of instants; `None` for scores that are one number.
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
