//! The example of the guide's chapter on a new constraint, `equidistant(N: P, Q, R)`: it compiles, and Φ is what it says.

use crate::constraint::{Assembly, ConstraintSet, Rows};
use crate::error::Origin;
use crate::mechanism::{BodyRef, Formula, Mechanism, Place};

pub(super) fn rows(a: &mut Assembly<'_>, p: &Place, q: &Place, r: &Place) -> Rows {
    let (p, q, r) = (a.place(p), a.place(q), a.place(r));
    let mut rows = Rows::between(&p, &q);
    let (to_q, to_r) = (a.square_of_distance(&p, &q), a.square_of_distance(&p, &r));
    rows.residuals = vec![("", a.graph.sub(to_q, to_r))];
    rows
}

#[test]
fn the_row_is_the_difference_of_two_squares() {
    let origin = Origin(0);
    let place =
        |x: f64, y: f64| Place { body: BodyRef::Ground(origin), x: Formula::Number(x), y: Formula::Number(y), origin };
    let (mechanism, mut set) = (Mechanism::default(), ConstraintSet::default());
    let mut assembly = Assembly::new(&mechanism, &mut set);
    let rows = rows(&mut assembly, &place(1.0, 2.0), &place(4.0, 6.0), &place(-1.0, 3.0));
    let [(suffix, phi)] = rows.residuals[..] else { panic!("one row") };
    assert_eq!(("", Some(25.0 - 5.0)), (suffix, assembly.graph.literal(phi)));
}
