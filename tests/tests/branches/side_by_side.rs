//! Follows the motions of a group in one batch.

use crate::case::{Answer, Refusal};
use crate::moving::{AnyGroup, Seen};
use kin_runtime::batch::{Column, End, Modes, Motions, Sweeps};
use kin_runtime::{Lanes, Signal};

pub(crate) fn in_a_batch(group: &AnyGroup<'_>) -> Vec<Answer> {
    let AnyGroup { times, cases, .. } = group;
    let model = cases[0].mechanism.model();
    let each = |of: &dyn Fn(usize) -> Vec<f64>, rows: usize| -> Vec<Vec<f64>> {
        let all: Vec<Vec<f64>> = (0..cases.len()).map(of).collect();
        (0..rows).map(|k| all.iter().map(|list| list[k]).collect()).collect()
    };
    let parameters = each(&|case| cases[case].mechanism.own_parameters(), model.parameters.len());
    let first = |case: usize| {
        let jets = (cases[case].branch)(times[0], 0.0).unwrap_or_default();
        jets.iter().map(|jet| jet.x).collect()
    };
    let start = each(&first, model.coordinates.len());
    let inputs: Vec<Vec<Signal>> = times.iter().map(|t| group.told(model, *t)).collect();
    let list = |of: fn(&Signal) -> f64, u: usize| inputs.iter().map(|list| of(&list[u])).collect::<Vec<_>>();
    let lists: Vec<_> = (0..model.inputs.len())
        .map(|u| [list(|u| u.value, u), list(|u| u.rate, u), list(|u| u.acceleration, u)])
        .collect();
    let inputs: Vec<_> =
        lists.iter().map(|[u, v, a]| Signal::new(Column::Each(u), Column::Each(v), Column::Each(a))).collect();
    let parameters: Vec<_> = parameters.iter().map(|list| Column::Each(list)).collect();
    let start: Vec<_> = start.iter().map(|list| Column::Each(list)).collect();
    let sweeps = Sweeps { parameters: &parameters, times, inputs: &inputs, modes: Modes::OfStart, start: &start };
    let mut out = Motions::new(cases.len(), Seen::new());
    let done = cases[0].mechanism.sweep_batch(&sweeps, &mut out);
    assert!(done.is_ok(), "a batch of {} does not run: {done:?}", model.name);
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
