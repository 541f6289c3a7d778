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
#[derive(Clone)]
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    pub(crate) determined: Vec<bool>,
    /// The name of every prescribed coordinate, its effort, the rate of the coordinate, and whether the effort is determined.
    pub(crate) given: Vec<(&'static str, f64, f64, bool)>,
    pub(crate) sharing: Sharing,
    /// True where the closed forms hold λ, false where it was eliminated.
    pub(crate) by_plan: bool,
}
