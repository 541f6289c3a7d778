//! Linear algebra: rank-revealing factorisations, sparse and dense; null spaces; linear dependencies of rows.

mod factor;
mod inverse_norm;
mod null_space;
mod rows;
mod sign;
mod sparse;

pub(crate) use factor::{Factorization, scale_columns};
pub(crate) use null_space::null_space;
pub(crate) use rows::{Dependency, dependencies, independent_rows};
pub(crate) use sign::positive_determinant;
pub(crate) use sparse::{NumericLu, Ordered};
