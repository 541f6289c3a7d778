//! All combinations of signs of a plan in which every group has a closed form.

use crate::assembly::Undecided;
use crate::model::Model;
use crate::plan::Plan;
use crate::planned::{Sign, Step};

/// Largest number of combinations that are examined.
pub(crate) const MAX_COMBINATIONS: usize = 1 << 16;

/// A combination of signs, solved by the plan.
pub(crate) enum Closing<C> {
    /// A closure.
    Closed(C),
    /// The first margin that is not positive, and whether it is proven that there is no closure.
    Open {
        /// Its index among the margins.
        margin: usize,
        /// True if its interval is negative.
        excluded: bool,
    },
    /// It is proven that the only solution of the plan violates rows that the plan leaves out.
    Violated,
}

/// Goes through the combinations of signs, mode by mode in the order of the plan. If a group does not close, the signs
/// of later groups need not be varied. The results are the closures, and what is undecided.
pub(crate) fn combinations<C>(
    model: &'static Model,
    solve: &mut dyn FnMut(&[f64]) -> Closing<C>,
) -> (Vec<C>, Vec<Undecided>) {
    let plan: &Plan = &model.plan;
    let count = plan.modes.len();
    let mut signs = vec![1.0; count];
    let (mut closed, mut undecided) = (Vec::new(), Vec::new());
    for seen in 0.. {
        if seen == MAX_COMBINATIONS {
            undecided.push(Undecided::Unfinished { seen });
            break;
        }
        let decisive = match solve(&signs) {
            Closing::Closed(closure) => {
                closed.push(closure);
                count
            }
            Closing::Violated => count,
            Closing::Open { margin, excluded } => {
                let step = plan.step_of_margin(margin).unwrap_or(plan.steps.len());
                let decisive = decisive(plan, margin);
                if !excluded {
                    let named = plan.modes.iter().zip(&signs).take(decisive);
                    let modes = named.filter_map(|(mode, &sign)| Some((mode.name, Sign::of(sign)?))).collect();
                    let joints = Step::new(model, step).map_or_else(Vec::new, |step| step.joints().collect());
                    undecided.push(Undecided::Modes { modes, joints });
                }
                decisive
            }
        };
        if !advance(&mut signs, decisive) {
            break;
        }
    }
    (closed, undecided)
}

/// The number of modes on whose signs this margin depends.
pub(crate) fn decisive(plan: &Plan, margin: usize) -> usize {
    let step = plan.step_of_margin(margin).unwrap_or(plan.steps.len());
    plan.modes.iter().filter(|mode| mode.step <= step).count()
}

/// Goes on to the next combination of signs that differs in the first `decisive` ones; false after the last.
pub(crate) fn advance(signs: &mut [f64], decisive: usize) -> bool {
    // Flip the last of these signs that is +, and reset all later ones.
    let Some(last) = signs[..decisive].iter().rposition(|&sign| sign > 0.0) else { return false };
    signs[last] = -1.0;
    signs[last + 1..].fill(1.0);
    true
}
