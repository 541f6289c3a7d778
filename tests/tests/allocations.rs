//! Evaluation takes no memory: neither the equations nor the observables, in `f64` and `f32`.

use allocation_counter::measure;
use kin_runtime::{Instant, Mechanism, Scalar, Subset};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::{signals, *};
use kin_tests::random::Random;

macro_rules! allocation_tests {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(#[test]
        fn $moving() {
            allocates_nothing::<$Moving, f64>();
            allocates_nothing::<$Moving, f32>();
        })*
        $(#[test]
        fn $other() {
            allocates_nothing::<$Other, f64>();
            allocates_nothing::<$Other, f32>();
        })*
    };
}

every_mechanism!(allocation_tests);

fn allocates_nothing<M: Mechanism + Default, T: Scalar>() {
    let mechanism = M::default();
    let mut random = Random::new(5);
    let mut vector = || (0..M::COORDINATES).map(|_| T::from_f64(random.between(-1.0, 1.0))).collect::<Vec<_>>();
    let (q, q_dot) = (vector(), vector());
    let inputs: Vec<_> = signals::<M>(0.3).into_iter().map(|u| u.map(T::from_f64)).collect();
    let mut geometry = vec![T::from_f64(0.0); M::model().geometry];
    let counted = measure(|| {
        let at = Instant { t: T::from_f64(0.3), inputs: &inputs };
        let mut workspace = M::workspace::<T>();
        let mut observations = M::observations::<T>();
        for subset in [Subset::PHI, Subset::JACOBIAN, Subset::GAMMA, Subset::ALL] {
            mechanism.evaluate(subset, &at, &q, &q_dot, &mut workspace).expect("lengths agree");
        }
        let parameters = mechanism.parameters::<T>();
        mechanism.observe_with(parameters.as_ref(), &at, &q, &q_dot, &mut observations).expect("lengths agree");
        mechanism.write_geometry(parameters.as_ref(), &at, &mut geometry).expect("lengths agree");
    });
    assert_eq!(0, counted.count_total, "{}", M::model().name);
}
