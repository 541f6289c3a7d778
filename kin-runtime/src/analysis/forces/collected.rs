//! Converts the numbers of forces into [`Forces`].

use super::numbers::{Numbers, Sharing};
use crate::forces::{Effort, Forces, Reaction, SpringForce, Wrench};
use crate::model::forces::TOTALS;
use crate::model::{EffortInfo, ForceModel, Model, ReactionInfo};
use crate::state::State;

/// The numbers as efforts, reactions, springs, energies and powers; those of inputs are left out.
pub(crate) fn collected(model: &'static Model, info: &ForceModel, state: &State, numbers: &Numbers) -> Forces {
    let Numbers { values, determined, given, sharing, .. } = numbers;
    let shown: Vec<bool> = determined.iter().map(|determined| *determined || *sharing == Sharing::LeastNorm).collect();
    let wrench = |index: usize| Wrench { force: [values[index], values[index + 1]], moment: values[index + 2] };
    let known = |index: usize| shown[index].then(|| values[index]);
    let effort = |info: &EffortInfo| Effort {
        name: info.name,
        effort: known(info.place),
        rate: values[info.place + 1],
        determined: determined[info.place],
    };
    let of_given = given.iter().map(|&(name, effort, rate, determined)| {
        let shown = determined || *sharing == Sharing::LeastNorm;
        Effort { name, effort: shown.then_some(effort), rate, determined }
    });
    let rows = model.rows.len();
    let powers_of_given: f64 = given.iter().map(|(_, effort, rate, _)| effort * rate).sum();
    Forces {
        t: state.t,
        model,
        efforts: info.efforts.iter().map(effort).chain(of_given).collect(),
        inputs: Vec::new(),
        reactions: info.reactions.iter().map(|reaction| reaction_of(reaction, values, determined, &shown)).collect(),
        springs: info
            .springs
            .iter()
            .map(|spring| SpringForce {
                name: spring.name,
                turns: spring.turns,
                length: values[spring.place],
                rate: values[spring.place + 1],
                force: values[spring.place + 2],
                energy: values[spring.place + 3],
                damper_power: values[spring.place + 4],
            })
            .collect(),
        shaking: wrench(0),
        inertia: wrench(3),
        kinetic: values[6],
        gravity: values[7],
        elastic: values[8],
        driver_power: values[9] + powers_of_given,
        applied_power: values[10],
        damper_power: values[11],
        energy_rate: values[12],
        multipliers: values[TOTALS..TOTALS + rows].to_vec(),
    }
}

fn reaction_of(info: &ReactionInfo, values: &[f64], determined: &[bool], shown: &[bool]) -> Reaction {
    let mut index = info.place;
    let mut next = |count: usize| {
        index += count;
        index - count
    };
    let (point, force) = if info.has_force { (Some(next(2)), Some(next(2))) } else { (None, None) };
    let moment = info.has_moment.then(|| next(1));
    let couples: Vec<usize> = info.couples.iter().map(|_| next(1)).collect();
    let generalized: Vec<usize> = (0..info.generalized).map(|_| next(1)).collect();
    let [normal, tangential, tension] =
        [info.has_normal, info.has_tangential, info.has_tension].map(|is_present| is_present.then(|| next(1)));
    let known = |places: &[usize]| places.iter().all(|&index| shown[index]);
    let pair = |index: usize| [values[index], values[index + 1]];
    let all: Vec<usize> = (info.place..index).collect();
    let couples_known = known(&couples);
    let generalized_known = known(&generalized);
    Reaction {
        name: info.name,
        on: info.on,
        point: point.map(pair),
        force: force.filter(|&index| known(&[index, index + 1])).map(pair),
        moment: moment.filter(|&index| known(&[index])).map(|index| values[index]),
        couples: match couples_known {
            true => info.couples.iter().zip(couples).map(|(frame, index)| (*frame, values[index])).collect(),
            false => Vec::new(),
        },
        generalized: if generalized_known {
            generalized.iter().map(|&index| values[index]).collect()
        } else {
            Vec::new()
        },
        normal: normal.filter(|&index| known(&[index])).map(|index| values[index]),
        tangential: tangential.filter(|&index| known(&[index])).map(|index| values[index]),
        tension: tension.filter(|&index| known(&[index])).map(|index| values[index]),
        determined: all.iter().all(|&index| determined[index]),
    }
}
