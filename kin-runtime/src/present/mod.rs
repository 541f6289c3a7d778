//! Results for people and for other programs: numbers, tables, records and files.
//!
//! Everything here formats results that are already computed; nothing solves or evaluates equations.

pub(crate) mod animation;
pub(crate) mod assemblies;
pub(crate) mod certificate;
pub(crate) mod condition;
pub(crate) mod drawing;
#[cfg(feature = "equations")]
pub(crate) mod equations;
pub(crate) mod forces;
pub(crate) mod grid;
pub(crate) mod json;
pub(crate) mod number;
pub(crate) mod output;
pub(crate) mod plan;
#[cfg(feature = "plot")]
pub(crate) mod plot;
pub(crate) mod ranges;
pub(crate) mod record;
pub(crate) mod sensitivities;
pub(crate) mod structure;
pub(crate) mod table;
pub(crate) mod text;
pub(crate) mod units;
