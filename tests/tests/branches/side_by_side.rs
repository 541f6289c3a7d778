//! Follows the motions of a group in one batch.

use crate::case::{Answer, Branch, Group, Refusal};
use crate::ways::told;
use kin_runtime::batch::{BatchError, Column, End, Modes, Moment, Motions, Sweeps, always, sweep};
use kin_runtime::{Kinematics, Lanes, Signal};

/// The states of a block, instant by instant.
type Seen = Vec<[Vec<Lanes>; 3]>;

/// The ends of the sets, and the states of the blocks.
type Followed = (Vec<Option<End>>, Vec<Seen>);

pub(crate) fn in_a_batch<M: Kinematics + Sync>(group: &Group<M>) -> Vec<Answer> {
    let Group { times, cases, .. } = group;
    let (mut parameters, mut start, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
    for case in cases {
        parameters.push(case.mechanism.parameters::<f64>().as_ref().to_vec());
        start.push(first_of(&case.branch, times[0]));
    }
    for t in times {
        inputs.push(told(group, *t));
    }
    let mechanism = &cases[0].mechanism;
    let mut follow = |sweeps: &Sweeps<'_>| {
        let mut out = Motions::new(cases.len(), Seen::new());
        let see: &(dyn Fn(&mut Seen, &Moment<'_>) + Sync) = &see;
        sweep(mechanism, sweeps, &mut out, &always, see)?;
        Ok((out.ends().collect(), out.blocks().cloned().collect()))
    };
    match follow_all(times, [&parameters, &start], &inputs, &mut follow) {
        Ok(answers) => answers,
        Err(error) => panic!("a batch of {} does not run: {error:?}", M::model().name),
    }
}

/// Remembers a state.
fn see(seen: &mut Seen, moment: &Moment<'_>) {
    seen.push([moment.q, moment.q_dot, moment.q_ddot].map(<[Lanes]>::to_vec));
}

/// The first configuration of a known motion.
fn first_of(branch: &Branch, t: f64) -> Vec<f64> {
    branch(t, 0.0).unwrap_or_default().iter().map(|jet| jet.x).collect()
}

/// The motions of sets whose parameters and starts are given set by set, and the inputs of all instant by instant.
fn follow_all(
    times: &[f64],
    [parameters, start]: [&[Vec<f64>]; 2],
    inputs: &[Vec<Signal>],
    follow: &mut dyn FnMut(&Sweeps<'_>) -> Result<Followed, BatchError>,
) -> Result<Vec<Answer>, BatchError> {
    // Columns have a number per set.
    let columns = |sets: &[Vec<f64>]| -> Vec<Vec<f64>> {
        (0..sets[0].len()).map(|k| sets.iter().map(|list| list[k]).collect()).collect()
    };
    let (parameters, start) = (columns(parameters), columns(start));
    let list = |of: fn(&Signal) -> f64, u: usize| inputs.iter().map(|list| of(&list[u])).collect::<Vec<_>>();
    let lists: Vec<_> = (0..inputs[0].len())
        .map(|u| [list(|u| u.value, u), list(|u| u.rate, u), list(|u| u.acceleration, u)])
        .collect();
    let inputs: Vec<_> =
        lists.iter().map(|[u, v, a]| Signal::new(Column::Each(u), Column::Each(v), Column::Each(a))).collect();
    let parameters: Vec<_> = parameters.iter().map(|list| Column::Each(list)).collect();
    let start: Vec<_> = start.iter().map(|list| Column::Each(list)).collect();
    let sweeps = Sweeps { parameters: &parameters, times, inputs: &inputs, modes: Modes::OfStart, start: &start };
    let (ends, blocks) = follow(&sweeps)?;
    let answer = |(set, end): (usize, Option<End>)| {
        let until = end.map_or(times.len(), |end| end.instant);
        let lane = |list: &Vec<Lanes>| list.iter().map(|x| x.to_array()[set % Lanes::COUNT]).collect();
        let of = |state: &[Vec<Lanes>; 3]| state.each_ref().map(lane);
        let states = blocks[set / Lanes::COUNT].iter().take(until).map(of).collect();
        let refusal = end.map(|end| Refusal { t: None, typed: end.limit.is_some(), words: format!("{end:?}") });
        Answer { states, refusal }
    };
    Ok(ends.into_iter().enumerate().map(answer).collect())
}
