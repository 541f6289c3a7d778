//! An estimate of ‖A⁻¹‖₁ that only solves systems with A and Aᵀ.
//!
//! ‖A⁻¹x‖₁ is convex in x, so that its largest value over ‖x‖₁ ≤ 1 is at a unit vector e_j; the gradient, A⁻ᵀ
//! sign(A⁻¹x), shows which unit vector gives a larger value than x. Except for rounding the estimate is never too
//! large; it is usually exact, and hardly ever too small by more than a factor of three. A vector of growing numbers
//! with alternating signs guards against cancellation. N. J. Higham, FORTRAN codes for estimating the one-norm of a
//! real or complex matrix, with applications to condition estimation, ACM Trans. Math. Softw. 14 (1988) 381–396,
//! algorithm 4.1, after W. W. Hager (1984).

use crate::random::Random;

/// Largest number of unit vectors tried.
const VECTORS: usize = 5;

/// Solves linear systems with an n×n matrix A.
pub(crate) trait Inverse {
    /// Solves A x = b in place for W right-hand sides at once, which are interleaved: component 0 of all of them, then
    /// component 1, and so on.
    fn solve<const W: usize>(&self, x: &mut [f64]);
    /// Solves Aᵀ x = b in place.
    fn solve_transposed(&self, x: &mut [f64]);
}

/// The estimate of ‖A⁻¹‖₁; `work` has length 4n.
pub(crate) fn inverse_norm(inverse: &impl Inverse, work: &mut [f64]) -> f64 {
    let n = work.len() / 4;
    if n == 0 {
        return 0.0;
    }
    let (vectors, rest) = work.split_at_mut(2 * n);
    let (gradient, signs) = rest.split_at_mut(n);
    for (index, pair) in vectors.as_chunks_mut::<2>().0.iter_mut().enumerate() {
        let guard = 1.0 + index as f64 / (n - 1).max(1) as f64;
        *pair = [1.0 / n as f64, if index % 2 == 0 { guard } else { -guard }];
    }
    inverse.solve::<2>(vectors);
    let mut sums = [0.0; 2];
    for (sign, &[x, guard]) in signs.iter_mut().zip(vectors.as_chunks::<2>().0) {
        *sign = 1.0_f64.copysign(x);
        (sums[0], sums[1]) = (sums[0] + x.abs(), sums[1] + guard.abs());
    }
    let (mut norm, guarded) = (sums[0], 2.0 * sums[1] / (3.0 * n as f64));
    if n == 1 {
        return norm;
    }
    let v = &mut vectors[..n];
    let mut last = None;
    for _ in 0..VECTORS {
        gradient.copy_from_slice(signs);
        inverse.solve_transposed(gradient);
        let best = (0..n).fold(0, |best, j| if gradient[j].abs() > gradient[best].abs() { j } else { best });
        if last.is_some_and(|last: usize| gradient[best].abs() <= gradient[last].abs()) {
            break;
        }
        last = Some(best);
        v.fill(0.0);
        v[best] = 1.0;
        inverse.solve::<1>(v);
        let found = one_norm(v);
        if found.is_nan() || found <= norm {
            break;
        }
        norm = found;
        let mut changed = false;
        for (sign, x) in signs.iter_mut().zip(v.iter()) {
            let new = 1.0_f64.copysign(*x);
            changed |= new != *sign;
            *sign = new;
        }
        if !changed {
            break;
        }
    }
    norm.max(guarded)
}

/// The number of random sign vectors from which the norms of rows are estimated.
const SIGNS: usize = 8;

/// An estimate of the largest 2-norm of a row of A⁻¹; `work` is a buffer.
///
/// For a vector z of random signs the expected value of (A⁻¹z)ⱼ² is the squared norm of row j. The probability that the
/// sum over eight vectors is below a hundredth of its expected value is about one in a million. The row with the
/// largest sum is then computed exactly. So the estimate is never too large, and too small only where another row of
/// nearly the same norm has a larger sum.
pub(crate) fn largest_row(inverse: &impl Inverse, n: usize, work: &mut Vec<f64>) -> f64 {
    let mut random = Random::new(0x51_6e5);
    work.clear();
    work.extend((0..SIGNS * n).map(|_| 1.0_f64.copysign(random.symmetric())));
    inverse.solve::<SIGNS>(work);
    let squares = work.as_chunks::<SIGNS>().0.iter().map(|row| row.iter().map(|x| x * x).sum::<f64>());
    let (best, _) = squares.enumerate().fold((0, 0.0), |best, row| if row.1 > best.1 { row } else { best });
    work.clear();
    work.resize(n, 0.0);
    work.iter_mut().skip(best).take(1).for_each(|x| *x = 1.0);
    inverse.solve_transposed(work);
    work.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn one_norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x.abs()).sum()
}
