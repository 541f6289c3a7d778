//! Batches and lanes agree with single evaluations, for every mechanism.
#![cfg(feature = "simd")]

use allocation_counter::measure;
use kin_runtime::batch::{BatchError, Column, Configurations, Evaluations, always, evaluate};
use kin_runtime::model::Model;
use kin_runtime::{Instant, Lanes, LengthError, Mechanism, Signal, Subset, Workspace};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::*;
use kin_tests::random::Random;

/// The number of configurations: more than a tile of blocks, and not a multiple of the block size.
const COUNT: usize = 42;

macro_rules! batch_tests {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(#[test]
        fn $moving() {
            agrees(&$Moving::default());
        })*
        $(#[test]
        fn $other() {
            agrees(&$Other::default());
        })*
    };
}

every_mechanism!(batch_tests);

/// What the law needs of a mechanism, as a trait object, so that the law is compiled once.
trait Evaluated {
    fn model(&self) -> &'static Model;
    fn own_parameters(&self) -> Vec<f64>;
    /// The results of a batch.
    fn batch(&self, configurations: &Configurations<'_>, count: usize) -> Box<dyn Results>;
    /// The results of one configuration, without lanes.
    fn one(&self, parameters: &[f64], at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Vec<f64>;
    /// How often a batch allocates.
    fn allocations(&self, configurations: &Configurations<'_>, count: usize) -> u64;
}

impl<M> Evaluated for M
where
    M: Mechanism + Sync + 'static,
    Workspace<M, Lanes>: Send,
{
    fn model(&self) -> &'static Model {
        M::model()
    }

    fn own_parameters(&self) -> Vec<f64> {
        self.parameters::<f64>().as_ref().to_vec()
    }

    fn batch(&self, configurations: &Configurations<'_>, count: usize) -> Box<dyn Results> {
        let mut out = Evaluations::new(count);
        evaluate(self, Subset::ALL, configurations, &mut out, &always).expect("as many columns as there must be");
        Box::new(out)
    }

    fn one(&self, parameters: &[f64], at: &Instant<'_>, q: &[f64], q_dot: &[f64]) -> Vec<f64> {
        let mut workspace = M::workspace::<f64>();
        self.evaluate_with(parameters, Subset::ALL, at, q, q_dot, &mut workspace).expect("lengths agree");
        [workspace.phi(), workspace.phi_q(), workspace.phi_t(), workspace.gamma()].concat()
    }

    fn allocations(&self, configurations: &Configurations<'_>, count: usize) -> u64 {
        let mut out = Evaluations::<M>::new(count);
        let mut work = || {
            evaluate(self, Subset::ALL, configurations, &mut out, &always).expect("lengths agree");
        };
        measure(&mut work).count_total
    }
}

/// The results of a batch, as a trait object.
trait Results {
    fn count(&self) -> usize;
    fn model(&self) -> &'static Model;
    /// Φ, Φ_q, Φ_t or γ, by the number of the part, of one configuration.
    fn value(&self, part: usize, index: usize, place: usize) -> Option<f64>;
}

impl<M: Mechanism> Results for Evaluations<M> {
    fn count(&self) -> usize {
        self.count()
    }

    fn model(&self) -> &'static Model {
        M::model()
    }

    fn value(&self, part: usize, index: usize, place: usize) -> Option<f64> {
        match part {
            0 => self.phi(index).nth(place),
            1 => self.phi_q(index).nth(place),
            2 => self.phi_t(index).nth(place),
            _ => self.gamma(index).nth(place),
        }
    }
}

/// The arguments of `COUNT` configurations, one list per column: parameters, t, inputs, q, q̇.
struct Drawn {
    own: Vec<f64>,
    parameters: Vec<Vec<f64>>,
    t: Vec<f64>,
    inputs: Vec<Signal<Vec<f64>>>,
    q: Vec<Vec<f64>>,
    q_dot: Vec<Vec<f64>>,
}

impl Drawn {
    fn new(mechanism: &dyn Evaluated) -> Self {
        let mut random = Random::new(17);
        let mut list = |middle: f64, size: f64| (0..COUNT).map(|_| middle + size * random.between(-1.0, 1.0)).collect();
        let (own, model) = (mechanism.own_parameters(), mechanism.model());
        Self {
            // Every second parameter is different in every configuration.
            parameters: own.iter().map(|p| list(*p, 0.01 * p.abs())).collect(),
            t: list(0.3, 0.3),
            inputs: model.inputs.iter().map(|_| Signal::new(list(0.2, 0.2), list(0.0, 1.0), list(0.0, 1.0))).collect(),
            q: model.coordinates.iter().map(|_| list(0.0, 1.5)).collect(),
            q_dot: model.coordinates.iter().map(|_| list(0.0, 1.0)).collect(),
            own,
        }
    }

    /// Evaluates the configurations in `range` as a batch.
    fn batch(&self, mechanism: &dyn Evaluated, range: core::ops::Range<usize>) -> Box<dyn Results> {
        let [q, q_dot] = [&self.q, &self.q_dot].map(|lists| columns(lists, range.clone()));
        let parameters: Vec<_> = (self.own.iter().zip(&self.parameters).enumerate())
            .map(|(k, (own, list))| if k % 2 == 0 { Column::Each(&list[range.clone()]) } else { Column::Shared(*own) })
            .collect();
        let each = |list: &'_ Vec<f64>| -> Vec<f64> { list[range.clone()].to_vec() };
        let signals: Vec<Signal<Vec<f64>>> =
            self.inputs.iter().map(|u| Signal::new(each(&u.value), each(&u.rate), each(&u.acceleration))).collect();
        let inputs: Vec<_> = (signals.iter())
            .map(|u| Signal::new(Column::Each(&u.value), Column::Each(&u.rate), Column::Each(&u.acceleration)))
            .collect();
        let configurations = Configurations {
            parameters: &parameters,
            t: Column::Each(&self.t[range.clone()]),
            inputs: &inputs,
            q: &q,
            q_dot: &q_dot,
        };
        mechanism.batch(&configurations, range.len())
    }

    /// Evaluates one configuration without lanes.
    fn one(&self, mechanism: &dyn Evaluated, place: usize) -> Vec<f64> {
        let of = |lists: &[Vec<f64>]| lists.iter().map(|list| list[place]).collect::<Vec<_>>();
        let parameters: Vec<_> = (self.own.iter().zip(of(&self.parameters)).enumerate())
            .map(|(k, (own, drawn))| if k % 2 == 0 { drawn } else { *own })
            .collect();
        let inputs: Vec<_> =
            (self.inputs.iter()).map(|u| Signal::new(u.value[place], u.rate[place], u.acceleration[place])).collect();
        let at = Instant { t: self.t[place], inputs: &inputs };
        mechanism.one(&parameters, &at, &of(&self.q), &of(&self.q_dot))
    }
}

fn columns(lists: &[Vec<f64>], range: core::ops::Range<usize>) -> Vec<Column<'_>> {
    lists.iter().map(|list| Column::Each(&list[range.clone()])).collect()
}

/// All results of one configuration of a batch.
fn results(out: &dyn Results, place: usize) -> Vec<f64> {
    let (rows, entries) = (out.model().rows.len(), out.model().constraint_pattern.entries.len());
    let parts = [rows, entries, rows, rows].into_iter().enumerate();
    let places = parts.flat_map(|(part, count)| (0..count).map(move |index| (part, index)));
    places.map(|(part, index)| out.value(part, index, place).expect("a configuration of the batch")).collect()
}

fn bits(numbers: Vec<f64>) -> Vec<u64> {
    numbers.into_iter().map(f64::to_bits).collect()
}

fn agrees(mechanism: &dyn Evaluated) {
    let name = mechanism.model().name;
    let drawn = Drawn::new(mechanism);
    let whole = drawn.batch(mechanism, 0..COUNT);
    for place in 0..COUNT {
        let (found, expected) = (results(&*whole, place), drawn.one(mechanism, place));
        assert_eq!(expected.len(), found.len());
        for (found, expected) in found.into_iter().zip(expected) {
            // The tolerance is a few ulp of the largest intermediate result.
            let same =
                (found - expected).abs() <= 2e-13 * (1.0 + expected.abs()) || found.is_nan() && expected.is_nan();
            assert!(same, "{name} {place}: {found:e} and {expected:e}");
        }
    }
    // The results of a configuration do not depend on its position in the batch or on the size of the batch, to the
    // last bit.
    for count in 0..=9 {
        let part = drawn.batch(mechanism, COUNT - count..COUNT);
        assert_eq!(count, part.count());
        for place in 0..count {
            let (own, other) = (results(&*part, place), results(&*whole, COUNT - count + place));
            assert_eq!(bits(own), bits(other), "{name} {count} {place}");
        }
    }
    allocates_nothing_inside(mechanism);
}

/// A batch of thousands of configurations allocates as often as one of eight.
fn allocates_nothing_inside(mechanism: &dyn Evaluated) {
    let model = mechanism.model();
    let inputs = vec![Signal::new(Column::Shared(0.1), Column::Shared(0.2), Column::Shared(0.3)); model.inputs.len()];
    let parameters: Vec<_> = mechanism.own_parameters().into_iter().map(Column::Shared).collect();
    let [small, large] = [8, 3_000].map(|count| {
        let list = vec![0.3; count];
        let columns = vec![Column::Each(&list); model.coordinates.len()];
        let (q, q_dot) = (&columns, &columns);
        let configurations =
            Configurations { parameters: &parameters, t: Column::Each(&list), inputs: &inputs, q, q_dot };
        mechanism.allocations(&configurations, count)
    });
    assert_eq!(small, large, "{}", model.name);
}

#[test]
fn columns_are_counted() {
    let numbers = [0.0; 3];
    let mechanism = FourbarLectureMid::default();
    let parameters = mechanism.parameters::<f64>().map(Column::Shared);
    let q = [Column::Each(&numbers); FourbarLectureMid::COORDINATES];
    let good = Configurations { parameters: &parameters, t: Column::Shared(0.0), inputs: &[], q: &q, q_dot: &q };
    let refused = |configurations: Configurations<'_>, count: usize| {
        let mut out = Evaluations::<FourbarLectureMid>::new(count);
        evaluate(&mechanism, Subset::ALL, &configurations, &mut out, &always).map_err(|error| match error {
            BatchError::Length(error) => error,
            other => panic!("{other}"),
        })
    };
    assert_eq!(Ok(()), refused(good, 3));
    let column = LengthError { what: "a column of q", expected: 4, found: 3 };
    assert_eq!(Err(column), refused(good, 4));
    let list = LengthError { what: "q_dot", expected: 9, found: 1 };
    assert_eq!(Err(list), refused(Configurations { q_dot: &q[..1], ..good }, 3));
}
