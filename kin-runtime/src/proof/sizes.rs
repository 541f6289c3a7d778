//! The scales of coordinates in proofs.

use crate::model::Model;
use crate::scalar::Interval;

/// Writes the scale of every coordinate: a radian, or the size of the mechanism. This is the largest coordinate that is a
/// length, or the median distance by which a radian moves a row, if that is larger: all bodies may be at the origin.
/// `entries` are those of Φ_q, and `places` their rows and columns, sorted by rows.
pub(super) fn write_sizes(
    model: &Model,
    (places, entries): (&[(usize, usize)], &[Interval]),
    q: &[f64],
    sizes: &mut Vec<f64>,
) {
    let is_length = |k: usize| model.coordinates.get(k).is_some_and(|known| known.kind.is_length());
    sizes.clear();
    let mut all = places.iter().zip(entries).peekable();
    while let Some(&(&(row, _), _)) = all.peek() {
        let mut largest = [0.0_f64; 2];
        while let Some((&(_, k), entry)) = all.next_if(|((other, _), _)| *other == row) {
            let largest = &mut largest[usize::from(is_length(k))];
            *largest = largest.max(entry.magnitude());
        }
        let [of_others, of_lengths] = largest;
        sizes.extend(Some(of_others / of_lengths).filter(|arm| *arm > 0.0 && arm.is_finite()));
    }
    sizes.sort_unstable_by(f64::total_cmp);
    let arm = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let lengths = q.iter().enumerate().filter(|(k, _)| is_length(*k));
    let length = lengths.fold(arm, |most, (_, x)| most.max(x.abs()));
    sizes.clear();
    sizes.extend((0..q.len()).map(|k| if is_length(k) && length > 0.0 { length } else { 1.0 }));
}
