//! Recognises parts that are solvable in closed form.

use super::term_sum::{TermKey, TermReader, TermSum};
use super::tree::SolutionMethod;
use crate::expr::ExprId;
use std::collections::{BTreeMap, BTreeSet};

/// The closed-form method for the rows of a part, if there is one.
pub(super) fn recognise(
    reader: &mut TermReader<'_>,
    rows: &[usize],
    forms: &BTreeMap<usize, TermSum>,
) -> Option<SolutionMethod> {
    let unknowns: Vec<u32> = reader.unknowns().iter().copied().collect();
    let forms: Vec<&TermSum> = rows.iter().map(|row| &forms[row]).collect();
    if forms.iter().any(|form| form.rest.is_some()) {
        return None;
    }
    if let Some(method) = linear(reader, &forms, &unknowns) {
        return Some(method);
    }
    match (forms.as_slice(), unknowns.as_slice()) {
        (&[form], &[k]) => angle(reader, form).or_else(|| quadratic(reader, form, k)),
        (&[f, g], &[x, y]) => circle(reader, [f, g], [x, y]),
        _ => None,
    }
}

/// The coefficients [C, S] of a key, zero if the key is missing.
fn coefficient(reader: &mut TermReader<'_>, form: &TermSum, key: &TermKey) -> [ExprId; 2] {
    let zero = reader.graph.zero();
    form.terms.get(key).copied().unwrap_or([zero; 2])
}

/// True if a form contains no other keys than `keys`.
fn only(form: &TermSum, keys: &[TermKey]) -> bool {
    form.terms.keys().all(|key| keys.contains(key))
}

fn linear(reader: &mut TermReader<'_>, forms: &[&TermSum], unknowns: &[u32]) -> Option<SolutionMethod> {
    let keys: Vec<TermKey> = unknowns.iter().map(|&k| TermKey::power(k, 1)).collect();
    let allowed: BTreeSet<&TermKey> = keys.iter().collect();
    let is_linear = |form: &&TermSum| form.terms.keys().all(|key| *key == TermKey::default() || allowed.contains(key));
    if !forms.iter().all(is_linear) {
        return None;
    }
    let mut matrix = Vec::new();
    let mut constant = Vec::new();
    for form in forms {
        matrix.push(keys.iter().map(|key| coefficient(reader, form, key)[0]).collect());
        constant.push(coefficient(reader, form, &TermKey::default())[0]);
    }
    Some(SolutionMethod::Linear { matrix, constant })
}

fn angle(reader: &mut TermReader<'_>, form: &TermSum) -> Option<SolutionMethod> {
    // The row contains a single multiple of the angle; an equation in several multiples has no such closed form.
    let mut turning = form.terms.keys().filter(|key| **key != TermKey::default());
    let (Some(turn), None) = (turning.next(), turning.next()) else { return None };
    let (&[], &[(_, times)]) = (turn.powers.as_slice(), turn.angle.as_slice()) else { return None };
    let [a, b] = coefficient(reader, form, turn);
    let constant = coefficient(reader, form, &TermKey::default())[0];
    let c = reader.graph.neg(constant);
    Some(SolutionMethod::Angle { times, a, b, c })
}

fn quadratic(reader: &mut TermReader<'_>, form: &TermSum, k: u32) -> Option<SolutionMethod> {
    let keys = [TermKey::power(k, 2), TermKey::power(k, 1), TermKey::default()];
    if !only(form, &keys) {
        return None;
    }
    let [a, b, c] = keys.map(|key| coefficient(reader, form, &key)[0]);
    Some(SolutionMethod::Quadratic { a, b, c })
}

/// The intersection of two circles, or of a circle and a line.
fn circle(reader: &mut TermReader<'_>, forms: [&TermSum; 2], [x, y]: [u32; 2]) -> Option<SolutionMethod> {
    let squares = [TermKey::power(x, 2), TermKey::power(y, 2)];
    let keys = [squares[0].clone(), squares[1].clone(), TermKey::power(x, 1), TermKey::power(y, 1), TermKey::default()];
    if !forms.iter().all(|form| only(form, &keys)) {
        return None;
    }
    let coefficients = |reader: &mut TermReader<'_>, form: &TermSum| {
        let [e, e_y, l_x, l_y, k] = [0, 1, 2, 3, 4].map(|index: usize| coefficient(reader, form, &keys[index])[0]);
        reader.memory.zero_test.equal(reader.graph, e, e_y).then_some((e, [l_x, l_y], k))
    };
    let (first, second) = (coefficients(reader, forms[0])?, coefficients(reader, forms[1])?);
    let zero = reader.graph.zero();
    let ((e, l, k), (f, n, m)) = if first.0 == zero { (second, first) } else { (first, second) };
    if f == zero {
        return Some(SolutionMethod::Circle { e, l, k, n, m, second: None });
    }
    // The common chord of the two circles: e times the second equation minus f times the first.
    let graph = &mut *reader.graph;
    let mut less = |a: ExprId, b: ExprId| {
        let (a, b) = (graph.mul(e, a), graph.mul(f, b));
        graph.sub(a, b)
    };
    let (n, m) = ([less(n[0], l[0]), less(n[1], l[1])], less(m, k));
    Some(SolutionMethod::Circle { e, l, k, n, m, second: Some(f) })
}
