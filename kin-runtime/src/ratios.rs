//! Velocity ratios: how the mechanism follows each of its driving rows.

/// How q follows one driving row.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VelocityRatio {
    /// The driving row, place in Φ.
    pub row: usize,
    /// Its name.
    pub row_name: &'static str,
    /// Its joint.
    pub joint: &'static str,
    /// k = ∂q/∂f, n numbers: Φ_q k = e_d, with f the right-hand side of the row as it stands in Φ.
    pub first: Vec<f64>,
    /// l = ∂²q/∂f², n numbers: Φ_q l = −(Φ_q k)_q k.
    pub second: Vec<f64>,
    /// The row's own share of q̇: k ν_d.
    pub q_dot: Vec<f64>,
    /// The row's own share of q̈, all others standing still: −k Φ_tt,d + l ν_d².
    pub q_ddot: Vec<f64>,
}

/// Velocity ratios per driving row, in order of declaration.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VelocityRatios {
    /// One entry per driving row.
    pub drivers: Vec<VelocityRatio>,
}
