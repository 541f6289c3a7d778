//! Follows the motions of a group in one batch.

use crate::case::{Answer, Group, Refusal};
use crate::ways::told;
use kin_runtime::batch::{Column, End, Modes, Motions, Sweeps, always, sweep};
use kin_runtime::{Kinematics, Lanes, Signal};

/// The states of a block, instant by instant.
type Seen = Vec<[Vec<Lanes>; 3]>;

pub(crate) fn in_a_batch<M: Kinematics + Sync>(group: &Group<M>) -> Vec<Answer> {
    let Group { times, cases, .. } = group;
    let each = |of: &dyn Fn(usize) -> Vec<f64>, rows: usize| -> Vec<Vec<f64>> {
        let all: Vec<Vec<f64>> = (0..cases.len()).map(of).collect();
        (0..rows).map(|k| all.iter().map(|list| list[k]).collect()).collect()
    };
    let parameters = each(&|case| cases[case].mechanism.parameters::<f64>().as_ref().to_vec(), M::PARAMETERS);
    let first = |case: usize| {
        let jets = (cases[case].branch)(times[0], 0.0).unwrap_or_default();
        jets.iter().map(|jet| jet.x).collect()
    };
    let start = each(&first, M::COORDINATES);
    let inputs: Vec<Vec<Signal>> = times.iter().map(|t| told(group, *t)).collect();
    let list = |of: fn(&Signal) -> f64, u: usize| inputs.iter().map(|list| of(&list[u])).collect::<Vec<_>>();
    let lists: Vec<_> =
        (0..M::INPUTS).map(|u| [list(|u| u.value, u), list(|u| u.rate, u), list(|u| u.acceleration, u)]).collect();
    let inputs: Vec<_> =
        lists.iter().map(|[u, v, a]| Signal::new(Column::Each(u), Column::Each(v), Column::Each(a))).collect();
    let parameters: Vec<_> = parameters.iter().map(|list| Column::Each(list)).collect();
    let start: Vec<_> = start.iter().map(|list| Column::Each(list)).collect();
    let sweeps = Sweeps { parameters: &parameters, times, inputs: &inputs, modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(cases.len(), Seen::new());
    let done = sweep(&cases[0].mechanism, &sweeps, &mut out, &always, |seen: &mut Seen, moment| {
        seen.push([moment.q, moment.q_dot, moment.q_ddot].map(<[Lanes]>::to_vec));
    });
    assert!(done.is_ok(), "a batch of {} does not run: {done:?}", M::model().name);
    let blocks: Vec<&Seen> = out.blocks().collect();
    let answer = |(set, end): (usize, Option<End>)| {
        let until = end.map_or(times.len(), |end| end.instant);
        let lane = |list: &Vec<Lanes>| list.iter().map(|x| x.to_array()[set % Lanes::COUNT]).collect();
        let of = |state: &[Vec<Lanes>; 3]| state.each_ref().map(lane);
        let states = blocks[set / Lanes::COUNT].iter().take(until).map(of).collect();
        let refusal = end.map(|end| Refusal { t: None, typed: end.limit.is_some(), words: format!("{end:?}") });
        Answer { states, refusal }
    };
    out.ends().enumerate().map(answer).collect()
}
