//! The sign of a determinant.

use nalgebra::DMatrix;

/// Whether the determinant is positive, by elimination with row pivoting; `None` where the smallest pivot is at most
/// `trust` times the largest, or where an entry is NaN. The matrix is overwritten.
pub(crate) fn positive_determinant(matrix: &mut DMatrix<f64>, trust: f64) -> Option<bool> {
    let n = matrix.nrows();
    let entries = matrix.as_mut_slice();
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
    let mut positive = true;
    for k in 0..n {
        let (done, rest) = entries.split_at_mut((k + 1) * n);
        let column = &mut done[k * n..];
        let mut index = k;
        for row in k + 1..n {
            if column[row].abs() > column[index].abs() {
                index = row;
            }
        }
        let pivot = column[index];
        positive ^= (pivot < 0.0) ^ (index != k);
        (smallest, largest) = (smallest.min(pivot.abs()), largest.max(pivot.abs()));
        if pivot == 0.0 || pivot.is_nan() {
            return None;
        }
        column.swap(k, index);
        let inverse = 1.0 / pivot;
        column[k + 1..].iter_mut().for_each(|x| *x *= inverse);
        for other in rest.chunks_exact_mut(n) {
            other.swap(k, index);
            let factor = other[k];
            if factor != 0.0 {
                other[k + 1..].iter_mut().zip(&column[k + 1..]).for_each(|(x, c)| *x -= factor * c);
            }
        }
    }
    (smallest > trust * largest || n == 0).then_some(positive)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sign(rows: usize, numbers: &[f64]) -> Option<bool> {
        positive_determinant(&mut DMatrix::from_row_slice(rows, rows, numbers), 1e-12)
    }

    #[test]
    fn exchanges_and_negative_pivots_count() {
        assert_eq!(sign(2, &[0.0, 1.0, 1.0, 0.0]), Some(false));
        assert_eq!(sign(2, &[0.0, 1.0, -1.0, 0.0]), Some(true));
        assert_eq!(sign(3, &[0.0, 0.0, 2.0, 3.0, 0.0, 1.0, 0.0, 4.0, 5.0]), Some(true));
        assert_eq!(sign(0, &[]), Some(true));
    }

    #[test]
    fn random_matrices_have_the_sign_of_their_determinant() {
        let mut random = crate::random::Random::new(3);
        for n in 1..9 {
            for _ in 0..50 {
                let matrix = DMatrix::from_fn(n, n, |_, _| random.symmetric());
                let expected = matrix.determinant() > 0.0;
                assert_eq!(positive_determinant(&mut matrix.clone(), 1e-12), Some(expected), "{matrix}");
            }
        }
    }

    #[test]
    fn what_vanishes_has_none() {
        assert_eq!(sign(2, &[1.0, 2.0, 2.0, 4.0]), None);
        assert_eq!(sign(2, &[1.0, 2.0, 2.0, 4.0 + 1e-13]), None);
        assert_eq!(sign(2, &[f64::NAN, 2.0, 2.0, 1.0]), None);
        assert_eq!(sign(1, &[0.0]), None);
    }
}
