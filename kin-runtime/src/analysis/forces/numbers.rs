//! The numbers of forces, and what is asked of them.

/// What is asked where redundant rows share a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sharing {
    /// To say so, without numbers.
    Undetermined,
    /// The least of all possible forces.
    LeastNorm,
}

/// The numbers of forces, and which of them equilibrium determines; efforts of prescribed coordinates.
pub(super) struct Numbers {
    pub(super) values: Vec<f64>,
    pub(super) determined: Vec<bool>,
    /// The name of every prescribed coordinate, its effort, the rate of the coordinate, and whether the effort is determined.
    pub(super) given: Vec<(&'static str, f64, f64, bool)>,
    pub(super) sharing: Sharing,
}
