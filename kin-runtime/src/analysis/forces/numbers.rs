//! The numbers of forces, and how redundant rows share a load.

/// What to do if redundant rows share a load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Sharing {
    /// Report the forces as undetermined, without numbers.
    #[default]
    Undetermined,
    /// Take the possible forces of least norm.
    LeastNorm,
}

/// The numbers of forces, and which of them equilibrium determines; efforts of prescribed coordinates.
#[derive(Clone)]
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    pub(crate) determined: Vec<bool>,
    /// The name of every prescribed coordinate, its effort, the rate of the coordinate, and whether the effort is determined.
    pub(crate) given: Vec<(&'static str, f64, f64, bool)>,
    pub(crate) sharing: Sharing,
    /// True if the closed forms gave λ, false if it was solved numerically.
    pub(crate) by_plan: bool,
}
