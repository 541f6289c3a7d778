//! Whether closure equations are the same after a whole turn of a coordinate.

use super::closure_equations::ClosureEquations;
use crate::scalar::Interval;

/// How far from a place the equations are compared with those after a whole turn. At one place numbers may be the same by
/// chance, as those of sin ½φ are at φ = 0.
const SHIFTS: [f64; 3] = [0.0, 0.73, -1.61];

/// For each of the coordinates u, whether the equations are the same after a whole turn in its unit: false for lengths, and
/// for angles that gears couple in a ratio. `u` is a single place; others are compared, too.
pub(super) fn turns(equations: &mut ClosureEquations<'_>, u: &[Interval]) -> Vec<bool> {
    let places = SHIFTS.map(|shift| u.iter().map(|&u| u + Interval::from(shift)).collect::<Vec<_>>());
    let and = |a: Vec<bool>, b: Vec<bool>| a.into_iter().zip(b).map(|(a, b)| a && b).collect();
    let judged = places.iter().filter_map(|place| turns_at(equations, place)).reduce(and);
    judged.unwrap_or_else(|| vec![false; u.len()])
}

/// The same, judged at one place; none if the equations are undefined there.
fn turns_at(equations: &mut ClosureEquations<'_>, u: &[Interval]) -> Option<Vec<bool>> {
    let (whole, values) = (equations.whole_turns(), equations.all_values(u)?);
    let is_same = |k: usize| {
        let mut turned = u.to_vec();
        turned[k] = turned[k] + whole[k];
        let same = |turned: Vec<Interval>| values.iter().zip(turned).all(|(a, b)| a.intersection(b).is_some());
        equations.all_values(&turned).is_some_and(same)
    };
    Some((0..u.len()).map(is_same).collect())
}
