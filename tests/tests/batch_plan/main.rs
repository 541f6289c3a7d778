//! Batches of solutions by the plan, and of whole motions, agree with single ones, for every mechanism with a plan.
#![cfg(feature = "simd")]

mod batched;
mod columns;
mod first_instant;
mod limits;
mod motions;
mod passing;

use batched::{Batched, Results, Seen};
use kin_runtime::batch::{
    BatchError, Column, Modes, Moment, Motions, Problems, Solutions, Sweeps, always, solve, sweep,
};
use kin_runtime::model::Model;
use kin_runtime::plan::{Depth, Plan, Solved, StepKind};
use kin_runtime::{Instant, Lanes, Mechanism, PlanError, Signal};
use kin_tests::every_mechanism;
use kin_tests::mechanisms::*;
use kin_tests::random::Random;
use std::ops::Range;

/// The number of configurations: several tiles of blocks, and not a multiple of the block size.
const COUNT: usize = 42;
/// The number of instants of a motion.
const INSTANTS: usize = 61;
/// The number of parameter sets in a motion: more than one block, and not a multiple of the block size.
const SETS: usize = 6;

macro_rules! plan_tests {
    (
        moving { $($moving:ident: $Moving:ident, $from:literal, $to:literal;)* }
        unassembled { $($other:ident: $Other:ident;)* }
    ) => {
        $(#[test]
        fn $moving() {
            let mechanism: &dyn Batched = &$Moving::default();
            if mechanism.model().plan.exists() {
                solves(mechanism, $from, $to);
                moves(mechanism, $from, $to);
            } else {
                refuses::<$Moving>();
            }
        })*
    };
}

every_mechanism!(plan_tests);

/// q, q̇ and q̈, or `None` where the plan has no solution.
type State = Option<[Vec<f64>; 3]>;

/// Random parameters near those of the mechanism, a list for every parameter.
fn drawn_parameters(mechanism: &dyn Batched, count: usize) -> Vec<Vec<f64>> {
    let mut random = Random::new(23);
    let own = mechanism.parameters();
    let lists = own.iter().map(|p| (0..count).map(|_| p * (1.0 + random.between(-1e-4, 1e-4))).collect());
    lists.collect()
}

/// `COUNT` configurations along the motion, each with its own parameters.
struct Drawn {
    parameters: Vec<Vec<f64>>,
    t: Vec<f64>,
    inputs: Vec<Signal<Vec<f64>>>,
    start: Vec<Vec<f64>>,
    modes: Vec<Vec<f64>>,
}

impl Drawn {
    fn new(mechanism: &dyn Batched, from: f64, to: f64) -> Self {
        let model = mechanism.model();
        let t: Vec<f64> = (0..COUNT).map(|k| from + 0.1 * (to - from) * k as f64 / COUNT as f64).collect();
        let inputs: Vec<Vec<Signal>> = t.iter().map(|t| mechanism.signals(*t)).collect();
        let at = |k: usize| Instant { t: t[k], inputs: &inputs[k] };
        let assembled = mechanism.assemble(&at(0));
        let mut planned = mechanism.planned(&at(0), &assembled).unwrap();
        let (mut start, mut modes) = (vec![vec![]; model.coordinates.len()], vec![vec![]; model.plan.modes.len()]);
        for k in 0..COUNT {
            planned.at(&at(k)).unwrap();
            let [q, ..] = planned.state();
            let signs = mechanism.modes(&at(k), q);
            start.iter_mut().zip(q).for_each(|(list, q)| list.push(*q));
            modes.iter_mut().zip(signs).for_each(|(list, sign)| list.push(sign));
        }
        let column = |of: fn(&Signal) -> f64, u: usize| inputs.iter().map(|list| of(&list[u])).collect();
        let columns = (0..model.inputs.len())
            .map(|u| Signal::new(column(|u| u.value, u), column(|u| u.rate, u), column(|u| u.acceleration, u)));
        let columns = columns.collect();
        Self { parameters: drawn_parameters(mechanism, COUNT), inputs: columns, t, start, modes }
    }

    fn batch(&self, mechanism: &dyn Batched, range: Range<usize>, of_start: bool) -> Box<dyn Results> {
        let columns = |lists: &'_ [Vec<f64>]| -> Vec<Vec<f64>> {
            lists.iter().map(|list| list[range.clone()].to_vec()).collect()
        };
        let [parameters, start, modes] = [&self.parameters, &self.start, &self.modes].map(|lists| columns(lists));
        let [parameters, start, modes] =
            [&parameters, &start, &modes].map(|lists| lists.iter().map(|x| Column::Each(x)).collect::<Vec<_>>());
        let inputs: Vec<_> = (self.inputs.iter())
            .map(|u| {
                let part = |list: &'_ Vec<f64>| list[range.clone()].to_vec();
                Signal::new(part(&u.value), part(&u.rate), part(&u.acceleration))
            })
            .collect();
        let inputs: Vec<_> = (inputs.iter())
            .map(|u| Signal::new(Column::Each(&u.value), Column::Each(&u.rate), Column::Each(&u.acceleration)))
            .collect();
        let problems = Problems {
            parameters: &parameters,
            t: Column::Each(&self.t[range.clone()]),
            inputs: &inputs,
            modes: if of_start { Modes::OfStart } else { Modes::Signs(&modes) },
            start: &start,
        };
        mechanism.solve(&problems, range.len())
    }

    /// The solution of one configuration in `f64`.
    fn one(&self, mechanism: &dyn Batched, place: usize) -> State {
        let of = |lists: &[Vec<f64>]| lists.iter().map(|list| list[place]).collect::<Vec<_>>();
        let inputs: Vec<_> =
            (self.inputs.iter()).map(|u| Signal::new(u.value[place], u.rate[place], u.acceleration[place])).collect();
        let at = Instant { t: self.t[place], inputs: &inputs };
        let model = mechanism.model();
        let [mut q, mut q_dot, mut q_ddot] = [(); 3].map(|()| vec![0.0; model.coordinates.len()]);
        let mut margins = vec![0.0; model.plan.margins];
        let solved = Solved { q: &mut q, q_dot: &mut q_dot, q_ddot: &mut q_ddot, margins: &mut margins };
        let (parameters, modes, start) = (of(&self.parameters), of(&self.modes), of(&self.start));
        mechanism.solve_one(&parameters, &at, &modes, &start, solved);
        margins.iter().all(|margin| *margin > Plan::SMALLEST_MARGIN).then_some([q, q_dot, q_ddot])
    }
}

/// All results of one configuration of a batch.
fn results(out: &dyn Results, place: usize) -> [Vec<f64>; 3] {
    let coordinates = 0..out.model().coordinates.len();
    [0, 1, 2].map(|order| coordinates.clone().map(|k| out.number(order, k, place).unwrap()).collect())
}

/// Whether every configuration of a batch is solved.
fn solved(out: &dyn Results) -> Vec<bool> {
    (0..).map_while(|place| out.solved(place)).collect()
}

/// The margins of all configurations of a batch.
fn margins(out: &dyn Results) -> Vec<f64> {
    (0..).map_while(|place| out.margin(place)).collect()
}

fn close(name: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= tolerance * size, "{name} {k}: {a:e} instead of {b:e}");
    }
}

fn iterates(model: &Model) -> bool {
    model.plan.steps.iter().any(|step| matches!(step.kind, StepKind::Newton(_)))
}

fn solves(mechanism: &dyn Batched, from: f64, to: f64) {
    let (name, coordinates) = (mechanism.model().name, mechanism.model().coordinates.len());
    let mut drawn = Drawn::new(mechanism, from, to);
    let whole = drawn.batch(mechanism, 0..COUNT, false);
    let of_whole = margins(&*whole);
    let mut count_solved = 0;
    for (place, good) in solved(&*whole).into_iter().enumerate() {
        let found = results(&*whole, place);
        let Some(expected) = drawn.one(mechanism, place) else {
            assert!(!good, "{name} {place}");
            continue;
        };
        assert!(good, "{name} {place}: {}", of_whole[place]);
        count_solved += 1;
        // The error grows with each derivative, depending on the margin.
        for (order, (found, expected)) in found.iter().zip(&expected).enumerate() {
            close(name, found, expected, 1e-12 / of_whole[place].powi(order as i32 + 1));
        }
    }
    assert!(2 * count_solved > COUNT, "{name}: {count_solved} of {COUNT} are solved");
    // The modes that are taken from the start are those that were given.
    let of_start = drawn.batch(mechanism, 0..COUNT, true);
    assert_eq!(solved(&*of_start), solved(&*whole), "{name}");
    for place in 0..COUNT {
        let last = |out: &dyn Results| out.number(0, coordinates - 1, place).expect("a configuration of the batch");
        assert!(last(&*of_start) == last(&*whole), "{name}");
    }
    // The position of a configuration in the batch and the size of the batch do not matter.
    for count in 0..=9 {
        let part = drawn.batch(mechanism, COUNT - count..COUNT, false);
        assert_eq!(count, part.count());
        assert_eq!(count, solved(&*part).len());
        for place in 0..count {
            same(mechanism.model(), results(&*part, place), results(&*whole, COUNT - count + place));
        }
    }
    // A configuration without a solution does not affect the others, and its results are 0 instead of NaN.
    drawn.t[2] = f64::NAN;
    let with_one = drawn.batch(mechanism, 0..COUNT, false);
    assert!(!with_one.solved(2).unwrap());
    assert!(margins(&*with_one).into_iter().all(f64::is_finite), "{name}");
    assert_eq!(Some(0.0), with_one.margin(2), "{name}: what is not known has no margin");
    assert_eq!([0.0; 3].map(|zero| vec![zero; coordinates]), results(&*with_one, 2), "{name}");
    for place in [0, 1, 3, 4] {
        assert_eq!(whole.solved(place), with_one.solved(place), "{name} {place}");
        same(mechanism.model(), results(&*with_one, place), results(&*whole, place));
    }
}

/// Asserts that results are equal to the last bit, or within the tolerance of an iteration.
fn same(model: &Model, found: [Vec<f64>; 3], expected: [Vec<f64>; 3]) {
    if iterates(model) {
        found.iter().zip(&expected).for_each(|(a, b)| close(model.name, a, b, 1e-10));
    } else {
        let bits = |lists: [Vec<f64>; 3]| lists.map(|list| list.into_iter().map(f64::to_bits).collect::<Vec<_>>());
        assert_eq!(bits(found), bits(expected), "{}", model.name);
    }
}

fn moves(mechanism: &dyn Batched, from: f64, to: f64) {
    let name = mechanism.model().name;
    let times: Vec<f64> = (0..INSTANTS).map(|k| from + (to - from) * k as f64 / (INSTANTS - 1) as f64).collect();
    let inputs: Vec<Vec<Signal>> = times.iter().map(|t| mechanism.signals(*t)).collect();
    let at = |k: usize| Instant { t: times[k], inputs: &inputs[k] };
    let q = mechanism.assemble(&at(0));
    let parameters = drawn_parameters(mechanism, SETS);
    let list = |of: fn(&Signal) -> f64, u: usize| inputs.iter().map(|list| of(&list[u])).collect::<Vec<_>>();
    let lists: Vec<_> = (0..mechanism.model().inputs.len())
        .map(|u| Signal::new(list(|u| u.value, u), list(|u| u.rate, u), list(|u| u.acceleration, u)))
        .collect();
    let signals: Vec<_> = (lists.iter())
        .map(|u| Signal::new(Column::Each(&u.value), Column::Each(&u.rate), Column::Each(&u.acceleration)))
        .collect();
    let columns: Vec<_> = parameters.iter().map(|list| Column::Each(list)).collect();
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let sweeps = Sweeps { parameters: &columns, times: &times, inputs: &signals, modes: Modes::OfStart, start: &start };
    let see = |seen: &mut Seen, moment: &Moment<'_>| {
        assert_eq!(seen.len(), moment.instant);
        // The parameters passed to the visitor are those of its sets.
        for lane in (0..Lanes::COUNT).filter(|lane| moment.first + lane < SETS && moment.moves(*lane)) {
            let own = parameters.iter().map(|list| list[moment.first + lane]);
            assert!(moment.parameters.iter().map(|x| x.to_array()[lane]).eq(own), "{name}");
        }
        seen.push([moment.q, moment.q_dot, moment.q_ddot, &[moment.margin]].map(<[Lanes]>::to_vec));
    };
    let (ends, blocks) = mechanism.sweep(&sweeps, SETS, &see).unwrap();
    for set in 0..SETS {
        let own = parameters.iter().map(|list| list[set]).collect::<Vec<_>>();
        let own = mechanism.with_parameters(&own);
        let seen = |instant: usize| {
            let state = &blocks[set / Lanes::COUNT][instant];
            state.each_ref().map(|list| list.iter().map(|x| x.to_array()[set % Lanes::COUNT]).collect::<Vec<_>>())
        };
        // A motion in a batch ends at the same instant and step of the plan as a single one.
        let ended = |instant: usize, error: PlanError| {
            assert_eq!(Some(instant), ends[set].map(|end| end.instant), "{name} {set}: {error}");
            let step = ends[set].and_then(|end| end.limit).map(|limit| limit.step);
            assert_eq!(error.limit().map(|limit| limit.step), step, "{name} {set}: {error}");
        };
        let mut planned = match own.planned(&at(0), &q) {
            Ok(planned) => planned,
            Err(error) => {
                ended(0, error);
                continue;
            }
        };
        for instant in 0..INSTANTS {
            if instant > 0
                && let Err(error) = planned.at(&at(instant))
            {
                ended(instant, error);
                break;
            }
            assert!(ends[set].is_none_or(|end| end.instant > instant), "{name} {set}: {:?}", ends[set]);
            let margin = planned.margins().iter().fold(1.0_f64, |least, margin| least.min(*margin));
            let expected = planned.state();
            let seen = seen(instant);
            assert!((seen[3][0] - margin).abs() < 1e-9, "{name} {set}: margin {} for {margin}", seen[3][0]);
            for (order, (found, expected)) in seen.iter().zip(expected).enumerate() {
                close(name, found, expected, 1e-11 / margin.powi(order as i32 + 1));
            }
        }
    }
}

fn refuses<M: Mechanism + Default + Sync>() {
    let why = BatchError::NoPlan(M::model().plan.absent.expect("it has none"));
    let (modes, start) = (Modes::OfStart, &[]);
    let problems = Problems { parameters: &[], t: Column::Shared(0.0), inputs: &[], modes, start };
    let mut out = Solutions::<M>::new(1);
    assert_eq!(Err(why), solve(&M::default(), Depth::Position, &problems, &mut out, &always));
    let sweeps = Sweeps { parameters: &[], times: &[0.0], inputs: &[], modes, start };
    let mut out = Motions::new(1, ());
    assert_eq!(Err(why), sweep(&M::default(), &sweeps, &mut out, &always, |(), _| ()));
    assert!(why.to_string().starts_with("no plan because "));
}
