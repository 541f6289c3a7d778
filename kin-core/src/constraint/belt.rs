//! Belt or chain: two bodies turn in the same sense, as fast as their radii say.
//!
//! Row (1), in units of length; φ_c = 0 for axles in the ground:
//! ```text
//! R_a(φ_a − φ_c) − R_b(φ_b − φ_c) − e = 0
//! ```
//! A crossed belt has radii of different sign. The belt does not slip, and only the ratio of the radii counts. It is
//! the row of a [`gear`](super::gear) with the second radius reversed.

use super::assembly::{Assembly, Rows};
use super::gear::{Pair, coupled};
use crate::mechanism::Formula;

pub(super) fn rows(a: &mut Assembly<'_>, pair: Pair<'_>, offset: &Formula) -> Rows {
    coupled(a, pair, offset, |a, [first, second]| a.graph.sub(first, second))
}
