//! Dense linear algebra: factorisations that know their rank, null spaces, dependencies of rows.

mod factor;
mod null_space;
mod rows;
mod sign;

pub(crate) use factor::Factorization;
pub(crate) use null_space::null_space;
pub(crate) use rows::{Dependency, dependencies, independent_rows};
pub(crate) use sign::positive_determinant;
