//! Extremes as records for JSON.

use serde::Serialize;

use super::search::Extreme;
use crate::present::record::Parameters;

/// A quantity with its extremes; `None` if it has no finite value.
#[derive(Clone, Debug, Serialize)]
pub(super) struct QuantityRange {
    pub(super) quantity: String,
    pub(super) unit: Option<String>,
    pub(super) least: Option<Extreme>,
    pub(super) greatest: Option<Extreme>,
}

/// The extremes of one motion.
#[derive(Serialize)]
pub(super) struct MotionRecord {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) varied: Option<Parameters>,
    pub(super) parameters: Parameters,
    pub(super) from: Option<f64>,
    pub(super) to: Option<f64>,
    pub(super) complete: bool,
    pub(super) extremes: Vec<QuantityRange>,
}
