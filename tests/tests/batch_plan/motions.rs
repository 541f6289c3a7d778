//! Motions of many parameter sets: masks, ends, cancellation, and no allocations during the computation.

use allocation_counter::measure;
use kin_runtime::batch::{BatchError, Column, Modes, Moment, Motions, Progress, Sweeps, always, sweep};
use kin_runtime::plan::Plan;
use kin_runtime::{Instant, Kinematics, Lanes, Mechanism, Planned, mechanism};
use kin_tests::mechanisms::FourbarLectureMid;
use std::ops::ControlFlow;

/// A turn of the lecture's four-bar in steps of three degrees, for couplers of the given lengths.
fn couplers<S: Clone + Send>(
    lengths: &[f64],
    score: S,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
    visit: impl Fn(&mut S, &Moment<'_>) + Sync,
) -> (Result<(), BatchError>, Motions<S>) {
    let mechanism = FourbarLectureMid::default();
    let own = mechanism.parameters::<f64>();
    let coupler = FourbarLectureMid::model().parameters.iter().position(|p| p.name == "l2").expect("a coupler");
    let parameters: Vec<_> = (own.iter().enumerate())
        .map(|(k, p)| if k == coupler { Column::Each(lengths) } else { Column::Shared(*p) })
        .collect();
    let q = mechanism.solver().assemble(&Instant::at(0.0)).unwrap();
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let omega = mechanism.solver().state(&Instant::at(0.0)).unwrap().q_dot[2];
    let times: Vec<f64> = (0..=120).map(|k| (3.0 * f64::from(k)).to_radians() / omega).collect();
    let sweeps = Sweeps { parameters: &parameters, times: &times, inputs: &[], modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(lengths.len(), score);
    let result = sweep(&mechanism, &sweeps, &mut out, watch, visit);
    (result, out)
}

/// Counts how often a set is visited, and adds up the angles of its last body.
fn count(seen: &mut [Lanes; 2], moment: &Moment<'_>) {
    // Lanes of sets that do not move repeat the values of one that does.
    let lane = |lane: usize| {
        let lists = [moment.parameters, moment.q, moment.q_dot, moment.q_ddot, &[moment.margin]];
        lists.map(|list| list.iter().map(|x| x.to_array()[lane]).collect::<Vec<_>>())
    };
    let other = (0..Lanes::COUNT).find(|lane| moment.moves(*lane)).expect("one that moves");
    (0..Lanes::COUNT).filter(|k| !moment.moves(*k)).for_each(|k| assert_eq!(lane(other), lane(k)));
    let [number, sum] = *seen;
    seen[0] = moment.keep(number, number + 1.0.into());
    seen[1] = moment.keep(sum, sum + moment.q[8]);
}

#[test]
fn sets_at_their_limits_are_masked_and_leave_the_others_alone() {
    let mechanism = FourbarLectureMid::default();
    let own = mechanism.parameters::<f64>();
    let coupler = FourbarLectureMid::model().parameters.iter().position(|p| p.name == "l2").expect("a coupler");
    let good = own[coupler];
    let run = |lengths: &[f64]| {
        let (result, out) = couplers(lengths, [Lanes::default(); 2], &always, count);
        assert_eq!(Ok(()), result);
        let part = |k: usize| out.scores(move |score| score[k]).collect::<Vec<_>>();
        (part(0), part(1), out.ends().collect::<Vec<_>>())
    };
    let (all, sums, ends) = run(&[good; 5]);
    assert_eq!((vec![121.0; 5], vec![None; 5]), (all, ends));
    // One set never assembles, one has NaN, and some assemble for a part of the turn.
    let lengths: Vec<f64> = (0..40).map(|k| good * (0.3 + 0.05 * f64::from(k))).collect();
    let (seen, _, ends) = run(&lengths);
    assert!(ends.iter().any(|end| end.is_some_and(|end| end.instant == 0)), "{ends:?}");
    assert!(ends.iter().any(|end| end.is_some_and(|end| end.instant > 0)), "{ends:?}");
    assert!(ends.iter().any(Option::is_none), "{ends:?}");
    for (seen, end) in seen.iter().zip(&ends) {
        assert_eq!(*seen, end.map_or(121.0, |end| end.instant as f64));
        assert!(end.is_none_or(|end| end.margin <= Plan::SMALLEST_MARGIN));
    }
    for bad in [
        f64::NAN,
        f64::INFINITY,
        100.0 * good,
        lengths[ends.iter().position(|end| end.is_some_and(|end| end.instant > 0)).unwrap()],
    ] {
        let (seen, found, ends) = run(&[good, bad, good, good, good]);
        for place in [0, 2, 3, 4] {
            assert_eq!((None, 121.0), (ends[place], seen[place]));
            assert_eq!(sums[place].to_bits(), found[place].to_bits());
        }
        assert!(ends[1].is_some_and(|end| end.margin.is_finite() && end.instant as f64 == seen[1]), "{bad}: {ends:?}");
    }
    // Failing sets in the second of two interleaved groups, and all sets but the last of both groups.
    for closes in [[1, 1, 1, 1, 0, 1, 0, 1, 1], [0, 0, 0, 0, 0, 0, 0, 1, 1], [0, 1, 0, 0, 0, 0, 0, 0, 0]] {
        let length = |k: usize| if closes[k] == 1 { good + 1e-3 * k as f64 } else { 100.0 };
        let lengths: [f64; 9] = core::array::from_fn(length);
        assert_eq!(closes.map(|closes| 121.0 * f64::from(closes)).to_vec(), run(&lengths).0);
    }
    // All sets of a block fail.
    let (seen, sums, ends) = run(&[100.0; 4]);
    assert_eq!((vec![0.0; 4], vec![0.0; 4]), (seen, sums));
    assert!(ends.iter().all(|end| end.is_some_and(|end| end.instant == 0 && end.margin < 0.0)), "{ends:?}");
}

#[test]
fn motions_stop_when_told_to_and_take_no_memory_inside() {
    let good = vec![1.0; 400];
    let stop =
        |progress: Progress| if progress.done >= 40 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let (result, _) = couplers(&good, (), &stop, |(), _| ());
    assert!(
        matches!(result, Err(BatchError::Stopped(p)) if p.total == 400 && (40..400).contains(&p.done)),
        "{result:?}"
    );
    let [small, large] = [8, 400]
        .map(|count| measure(|| drop(couplers(&good[..count], Lanes::default(), &always, |_, _| ()))).count_total);
    assert_eq!(small, large);
}

#[test]
fn lanes_to_spare_repeat_the_last_set() {
    let lengths: Vec<f64> = (0..5).map(|k| 0.4 + 0.01 * f64::from(k)).collect();
    let see = |lanes: &mut Vec<[f64; 4]>, moment: &Moment<'_>| {
        let lists = [moment.parameters, moment.q, moment.q_dot, moment.q_ddot];
        lanes.extend(lists.into_iter().flatten().map(|x| x.to_array()));
    };
    let (result, out) = couplers(&lengths, Vec::new(), &always, see);
    assert_eq!(Ok(()), result);
    let [whole, ragged] = out.blocks().collect::<Vec<_>>()[..] else { panic!("two blocks") };
    assert!(whole.iter().any(|lanes| lanes[0] != lanes[1]));
    assert!(ragged.iter().all(|lanes| *lanes == [lanes[0]; 4]), "{ragged:?}");
}

/// Results of an earlier batch do not remain.
#[test]
fn room_is_used_again() {
    let mechanism = FourbarLectureMid::default();
    let q = mechanism.solver().assemble(&Instant::at(0.0)).unwrap();
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let own = mechanism.parameters::<f64>();
    let run = |factor: f64, out: &mut Motions<()>| {
        let parameters: Vec<_> = own.iter().map(|p| Column::Shared(*p)).collect();
        let long = FourbarLectureMid::model().parameters.iter().position(|p| p.name == "l2").expect("a coupler");
        let mut parameters = parameters;
        parameters[long] = Column::Shared(factor * own[long]);
        let (modes, start) = (Modes::Signs(&[Column::Shared(1.0)]), &start[..]);
        let sweeps = Sweeps { parameters: &parameters, times: &[0.0, 0.01], inputs: &[], modes, start };
        sweep(&mechanism, &sweeps, out, &always, |(), _| ()).unwrap();
        out.ends().flatten().count()
    };
    let mut out = Motions::new(5, ());
    assert_eq!([5, 0], [100.0, 1.0].map(|factor| run(factor, &mut out)));
}

/// In the stretched position, where the cylinder is as long as the foot and the boom together, φ̈ is unbounded.
#[mechanism]
#[bodies(boom)]
#[revolute(pin: ground @ (0, 0), boom @ (0, 0))]
#[distance(ram: ground @ (1, 0), boom @ (reach, 0), length = 0.9 + t)]
#[guess(boom.phi = 0.8)]
struct Boom {
    #[param(1.2)]
    reach: f64,
}

/// A pin in a slot with nearly the same pivot: the slot turns with the crank, faster and faster.
#[mechanism]
#[bodies(crank, slot)]
#[revolute(O: ground @ (0, 0), crank @ (0, 0))]
#[revolute(D: ground @ (0.0001, 0), slot @ (0, 0))]
#[point_on_line(pin: slot @ (0, 0), crank @ (1, 0), axis = (1, 0))]
#[driver(drive: crank.phi = speed * t + 50 * t * t)]
#[guess(slot.phi = 0.0001)]
struct Spinning {
    #[param(100)]
    speed: f64,
}

/// Asserts that every set moves as a single mechanism does, including the number of turns of its angles.
fn go_as_alone<M: Kinematics + Default + Sync>(values: &[f64], times: &[f64]) {
    let q = M::default().solver().assemble(&Instant::at(times[0])).unwrap();
    let start: Vec<_> = q.iter().map(|q| Column::Shared(*q)).collect();
    let (parameters, modes) = (&[Column::Each(values)], Modes::OfStart);
    let sweeps = Sweeps { parameters, times, inputs: &[], modes, start: &start };
    let mut out = Motions::new(values.len(), Vec::new());
    let see = |seen: &mut Vec<Vec<[f64; 4]>>, moment: &Moment<'_>| {
        seen.push(moment.q.iter().map(|x| x.to_array()).collect());
    };
    sweep(&M::default(), &sweeps, &mut out, &always, see).unwrap();
    let blocks: Vec<_> = out.blocks().collect();
    for (set, value) in values.iter().enumerate() {
        let mut own = M::default();
        assert!(own.set_parameter(0, *value));
        let mut planned = Planned::new(&own, &Instant::at(times[0]), &q).unwrap();
        for (instant, t) in times.iter().enumerate() {
            if instant > 0 {
                planned.at(&Instant::at(*t)).unwrap();
            }
            for (found, expected) in blocks[set / 4][instant].iter().zip(planned.q()) {
                assert!((found[set % 4] - expected).abs() < 1e-7, "{value} at {t}: {found:?} {expected}");
            }
        }
    }
}

#[test]
fn beside_a_limit_and_at_high_speed_turns_are_counted_as_alone() {
    go_as_alone::<Boom>(&[1.3, 1.2, 1.4, 1.25, 1.2], &[0.0, 0.6, 1.2, 1.3 - 1e-9, 0.4, 0.0]);
    let times: Vec<f64> = (0..20).map(|k| 0.2 * f64::from(k)).collect();
    go_as_alone::<Spinning>(&[100.0, 1.0, 200.0, 100.0, 50.0], &times);
}

/// A rack on a crank through a swinging guide; the plan iterates on it.
#[mechanism]
#[body(crank, x = 0, y = 0)]
#[body(guide, x = d, y = 0)]
#[body(pinion, x = d, y = 0)]
#[bodies(rack)]
#[revolute(A: crank @ (a, 0), rack @ (0, 0))]
#[translational(slide: guide @ (0, 0), rack @ (0, 0), axis = (1, 0))]
#[rack_pinion(mesh: guide @ (0, 0), rack @ (0, 0), axis = (1, 0), pinion = pinion, radius = r, offset = offset)]
#[driver(drive: pinion.phi = start + rate * t)]
struct SwungRack {
    d: f64,
    a: f64,
    r: f64,
    offset: f64,
    start: f64,
    rate: f64,
}

/// Where a set ends does not depend on its neighbours, wherever in the batch one of them ends. An iteration of a block
/// runs for all its sets together.
#[test]
fn sets_that_are_iterated_end_where_they_end_alone() {
    let long: ([f64; 6], [f64; 2]) = ([0.53, 0.48, 0.15, 0.9, 0.99, -1.0], [-1.75, 2.38]);
    let short: ([f64; 6], [f64; 2]) = ([0.54, 0.61, 0.17, -0.8, 1.57, -1.0], [-2.99, -1.46]);
    let of = |[d, a, r, offset, start, rate]: [f64; 6]| SwungRack { d, a, r, offset, start, rate };
    let starts = [&long, &short].map(|(numbers, [crank, guide])| {
        let mechanism = of(*numbers);
        let (x, y) = (numbers[1] * crank.cos(), numbers[1] * crank.sin());
        let guess = [*crank, *guide, numbers[4], x, y, *guide];
        mechanism.solver().state_from(&Instant::at(0.0), &guess).unwrap().q
    });
    let times: Vec<f64> = (0..160).map(|k| 0.03 * f64::from(k)).collect();
    let ends = |is_short: &dyn Fn(usize) -> bool, count: usize| {
        let column = |pick: &dyn Fn(usize) -> f64| (0..count).map(pick).collect::<Vec<f64>>();
        let parameters: Vec<_> =
            (0..6).map(|k| column(&|set| if is_short(set) { short.0[k] } else { long.0[k] })).collect();
        let start: Vec<_> = (0..6).map(|k| column(&|set| starts[usize::from(is_short(set))][k])).collect();
        let parameters: Vec<_> = parameters.iter().map(|column| Column::Each(column)).collect();
        let start: Vec<_> = start.iter().map(|column| Column::Each(column)).collect();
        let sweeps =
            Sweeps { parameters: &parameters, times: &times, inputs: &[], modes: Modes::OfStart, start: &start };
        let mut out = Motions::new(count, ());
        sweep(&of(long.0), &sweeps, &mut out, &always, |(), _| ()).unwrap();
        out.ends().collect::<Vec<_>>()
    };
    let (alone, neighbour) = (ends(&|_| false, 1)[0], ends(&|_| true, 1)[0]);
    let instants = [alone, neighbour].map(|end| end.map(|end| end.instant));
    assert!(instants[1].is_some() && instants[0].is_none_or(|end| Some(end) > instants[1]), "{instants:?}");
    for count in [2, 5, 8, 9, 17] {
        for place in 0..count {
            let all = ends(&|set| set == place, count);
            for (set, end) in all.iter().enumerate() {
                let expected = if set == place { instants[1] } else { instants[0] };
                assert_eq!(expected, end.map(|end| end.instant), "set {set} of {count}, the other one at {place}");
            }
        }
    }
}
