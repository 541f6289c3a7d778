//! The numbers of forces, and how redundant rows share a load.

use nalgebra::DMatrix;

/// Changes along a null vector of Φ_qᵀ below this, relative to the largest one, count as zero.
pub(super) const ZERO_CHANGE: f64 = 1e-9;

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
    /// How all numbers change along every null vector of Φ_qᵀ; no columns where λ is unique.
    pub(crate) changes: DMatrix<f64>,
    /// The name of every prescribed coordinate, its effort, the rate of the coordinate, and whether the effort is determined.
    pub(crate) given: Vec<(&'static str, f64, f64, bool)>,
    pub(crate) sharing: Sharing,
    /// True if the closed forms gave λ, false if it was solved numerically.
    pub(crate) by_plan: bool,
}

impl Numbers {
    /// Whether equilibrium determines Σ factor · number, given the places and factors of its terms.
    pub(super) fn is_determined(&self, terms: &[(usize, f64)]) -> bool {
        let open = || terms.iter().filter(|(place, _)| !self.determined[*place]);
        let sums = self.changes.column_iter().map(|change| {
            let changes = open().map(|&(place, factor)| change[place] * factor);
            changes.fold([0.0_f64; 2], |[sum, size], change| [sum + change, size + change.abs()])
        });
        let sums: Vec<[f64; 2]> = sums.collect();
        let size = sums.iter().fold(0.0_f64, |size, sum| size.max(sum[1]));
        sums.iter().all(|[sum, _]| sum.abs() <= ZERO_CHANGE * size)
    }
}
