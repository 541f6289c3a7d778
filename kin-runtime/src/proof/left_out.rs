//! Redundant rows, which proofs leave out: whether a solution of the other rows satisfies them.

use super::enclosures::Enclosures;
use super::sizes::write_sizes;
use crate::certificate::Uncertified;
use crate::model::Model;
use crate::scalar::Interval;
use crate::workspace::Subset;

/// The residual of a row that is violated, relative to what the row changes by if all coordinates change by their sizes.
/// Dimensions that are rounded to `f64` leave a residual far below this, and so does a state that is accepted.
const VIOLATED: f64 = 1e-9;

/// A row among `rows` that no configuration in a box satisfies, not even approximately.
pub(crate) fn violated(
    model: &Model,
    rows: &[usize],
    system: &mut dyn Enclosures,
    q: &[Interval],
) -> Option<Uncertified> {
    if rows.is_empty() {
        return None;
    }
    let still = vec![Interval::ZERO; q.len()];
    let all = system.evaluate(Subset::POSITION, q, &still).ok()?;
    let (entries, middle) = (model.constraint_pattern.entries, q.iter().map(|x| x.midpoint()).collect::<Vec<_>>());
    let mut sizes = Vec::new();
    write_sizes(model, (entries, all.phi_q), &middle, &mut sizes);
    rows.iter().find_map(|&row| {
        let of_row = entries.iter().zip(all.phi_q).filter(|((other, _), _)| *other == row);
        let size: f64 = of_row.map(|(&(_, k), entry)| entry.magnitude() * sizes[k]).sum();
        let phi = all.phi.get(row)?;
        // Both are false for NaN, too.
        let is_large = phi.lower() > VIOLATED * size || phi.upper() < -VIOLATED * size;
        let info = model.rows.get(row).filter(|_| is_large)?;
        Some(Uncertified::Violated { row: info.name, by: phi.midpoint().abs() })
    })
}
