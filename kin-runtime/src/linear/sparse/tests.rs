use super::*;
use crate::linear::Factorization;
use crate::random::Random;
use nalgebra::{DMatrix, DVector};

/// A regular matrix with a few entries per row: dense, and as pattern and values.
fn random_matrix(random: &mut Random, n: usize) -> (DMatrix<f64>, Vec<(usize, usize)>, Vec<f64>) {
    let mut dense = DMatrix::zeros(n, n);
    let index = |random: &mut Random| ((0.5 + 0.5 * random.symmetric()) * n as f64) as usize % n;
    let shift = index(random);
    for k in 0..n {
        dense[(k, (k + shift) % n)] = 1.0 + 0.5 * random.symmetric();
        for _ in 0..2 {
            let column = index(random);
            dense[(k, column)] += random.symmetric();
        }
    }
    let entries: Vec<(usize, usize)> =
        (0..n * n).map(|k| (k / n, k % n)).filter(|&index| dense[index] != 0.0).collect();
    let values = entries.iter().map(|&index| dense[index]).collect();
    (dense, entries, values)
}

fn factorised(ordered: &mut Ordered, values: Vec<f64>) -> Option<NumericLu> {
    let mut lu = NumericLu { values, ..NumericLu::default() };
    ordered.factorise(&mut lu).then_some(lu)
}

#[test]
fn solutions_signs_and_norms_are_those_of_the_dense_matrix() {
    let mut random = Random::new(11);
    let mut exact = 0;
    for (n, rounds) in (1..=12).chain([40]).map(|n| (n, 20)).chain([(240, 2)]) {
        for _ in 0..rounds {
            let (dense, entries, values) = random_matrix(&mut random, n);
            let inverse = dense.clone().try_inverse().unwrap();
            let norm = |matrix: &DMatrix<f64>| matrix.column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
            let condition = norm(&dense) * norm(&inverse);
            let mut found = factorised(&mut Ordered::new(n, entries), values).unwrap();
            let b = DVector::from_fn(n, |_, _| random.symmetric());
            let x = DVector::from_vec(found.solve(b.as_slice()));
            assert!((&dense * &x - &b).amax() <= 1e-15 * n as f64 * x.amax().max(1.0), "{n}");
            assert_eq!(found.is_positive(), dense.determinant() > 0.0);
            let (a, a_inverse) = found.norms();
            assert!((a - norm(&dense)).abs() < 1e-14 * a);
            let share = a * a_inverse / condition;
            assert!(share > 0.3 && share < 1.0 + 1e-9, "{share}");
            exact += usize::from(share > 1.0 - 1e-9);
            let (column, row) = found.largest_norms();
            let largest = |norms: &mut dyn Iterator<Item = f64>| norms.fold(0.0, f64::max);
            assert!((column / largest(&mut dense.column_iter().map(|c| c.norm())) - 1.0).abs() < 1e-14);
            let share = row / largest(&mut inverse.row_iter().map(|row| row.norm()));
            assert!(share > 0.5 && share < 1.0 + 1e-9, "{share}");
        }
    }
    assert!(exact > 200, "{exact}");
}

/// Where the sparse LU claims full rank, a rank-revealing factorisation confirms it; the claim is made where the
/// condition number is far from the tolerance, and never where it is beyond.
#[test]
fn full_rank_is_claimed_only_where_it_is_revealed() {
    const TOLERANCE: f64 = 1e-7;
    let mut random = Random::new(12);
    for n in 2..12 {
        let (_, mut entries, mut values) = random_matrix(&mut random, n);
        // The last row is nearly the sum of the two rows before it, or a multiple of a single one.
        let before: Vec<f64> = (0..n)
            .map(|j| {
                let own = entries.iter().zip(&values).filter(|((i, k), _)| *k == j && *i + 3 > n && *i + 1 < n);
                own.map(|(_, value)| value).sum()
            })
            .collect();
        let rest = entries.iter().zip(&values).filter(|((i, _), _)| i + 1 < n);
        (entries, values) = rest.map(|(index, value)| (*index, *value)).unzip();
        entries.extend((0..n).map(|j| (n - 1, j)));
        let noise: Vec<f64> = (0..n).map(|_| random.symmetric()).collect();
        for digits in 0..=16 {
            let last = before.iter().zip(&noise).map(|(sum, noise)| sum + 10_f64.powi(-digits) * noise);
            let all: Vec<f64> = values.iter().copied().chain(last).collect();
            let mut dense = DMatrix::zeros(n, n);
            entries.iter().zip(&all).for_each(|(&index, value)| dense[index] = *value);
            let revealed = Factorization::absolute(&dense, &vec![1.0; n], TOLERANCE);
            let claimed = factorised(&mut Ordered::new(n, entries.clone()), all)
                .and_then(|found| Factorization::sparse_of_full_rank(Box::new(found), vec![1.0; n], TOLERANCE));
            match claimed {
                Some(claimed) => {
                    assert_eq!((claimed.rank, revealed.rank), (n, n), "{n} {digits}");
                    let share = claimed.condition / revealed.condition;
                    assert!(share > 0.3 && share < 3.4, "{n} {digits}: {share}");
                }
                None => assert!(revealed.full_condition > 1e5, "{n} {digits}: {}", revealed.full_condition),
            }
            assert!(digits < 9 || revealed.rank < n, "{n} {digits}");
        }
    }
}

/// A chain of links in which x, y and φ of each link follow from the link before it.
#[test]
fn long_arms_leave_no_doubt() {
    for (n, link) in [(10, 1.0), (300, 0.1), (300, 1.0), (1000, 0.3)] {
        let (mut entries, mut values) = (Vec::new(), Vec::new());
        let mut enter = |row, column, value| {
            entries.push((row, column));
            values.push(value);
        };
        for k in 0..n {
            let (sin, cos) = (0.01 * k as f64).sin_cos();
            for c in 0..3 {
                enter(3 * k + c, 3 * k + c, 1.0);
                if k > 0 {
                    enter(3 * k + c, 3 * k + c - 3, -1.0);
                }
            }
            if k > 0 {
                enter(3 * k, 3 * k - 1, link * sin);
                enter(3 * k + 1, 3 * k - 1, -link * cos);
            }
        }
        let found = factorised(&mut Ordered::new(3 * n, entries), values).unwrap();
        let claimed = Factorization::sparse_of_full_rank(Box::new(found), vec![1.0; 3 * n], 1e-7);
        assert!(claimed.is_some(), "{n} links of {link}");
    }
}

/// New values in the same pattern keep the order of elimination; a vanishing pivot changes it; a singular matrix has
/// none.
#[test]
fn an_order_is_kept_as_long_as_its_pivots_are_good() {
    let entries = vec![(0, 0), (0, 1), (1, 0), (1, 1), (2, 1), (2, 2)];
    let mut ordered = Ordered::new(3, entries);
    let mut check = |values: [f64; 6]| {
        let found = factorised(&mut ordered, values.to_vec())?;
        let x = found.solve(&[1.0, 2.0, 3.0]);
        let [a, b, c, d, e, f] = values;
        assert!((a * x[0] + b * x[1] - 1.0).abs() < 1e-14 && (c * x[0] + d * x[1] - 2.0).abs() < 1e-14);
        assert!((e * x[1] + f * x[2] - 3.0).abs() < 1e-14);
        assert_eq!(found.is_positive(), (a * d - b * c) * f > 0.0);
        Some(Rc::clone(found.symbolic.as_ref().unwrap()))
    };
    let first = check([3.0, 1.0, 1.0, 2.0, 0.5, 1.0]).unwrap();
    assert!(Rc::ptr_eq(&first, &check([2.0, -1.0, 1.0, 2.5, 0.1, 0.3]).unwrap()));
    let second = check([1e-9, 1.0, 1.0, 1e-9, 0.5, 1.0]).unwrap();
    assert!(!Rc::ptr_eq(&first, &second));
    assert!(Rc::ptr_eq(&second, &check([0.1, 1.0, 1.0, 0.2, 0.5, 1.0]).unwrap()));
    assert!(check([1.0, 2.0, 0.5, 1.0, 0.5, 1.0]).is_none());
    assert!(check([1.0, 2.0, 0.0, f64::NAN, 0.5, 1.0]).is_none());
}
