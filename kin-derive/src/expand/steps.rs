//! The solution plan in the static model: its steps and its modes.

use super::entries::variant;
use super::table::{Cell, Writer};
use kin_core::plan::{Mode, SolutionPlan, Step};
use kin_core::vocabulary::StepKind;
use proc_macro2::TokenStream;
use quote::quote;

/// The table of the plan.
pub(super) fn table(plan: &SolutionPlan, writer: Writer) -> TokenStream {
    if let Some(why) = &plan.absent {
        return quote! { __kin::Plan::absent(#why) };
    }
    let steps = steps(plan, writer);
    let [modes, orientations] = [&plan.modes, &plan.orientations].map(|list| modes(list, writer));
    let iterations = plan.steps.iter().filter(|step| matches!(step.kind, StepKind::Newton(_))).count();
    let margins = plan.margins;
    quote! {
        __kin::Plan {
            steps: #steps, modes: #modes, orientations: #orientations, iterations: #iterations,
            margins: #margins, absent: __kin::None,
        }
    }
}

fn steps(plan: &SolutionPlan, writer: Writer) -> TokenStream {
    let steps = &plan.steps;
    let joints = steps.iter().map(|step| step.joints.iter().map(|joint| ((), [Cell::Word(*joint)])).collect());
    let joints = writer.lists("numbers", joints, |(), [joint]| joint);
    let given = |step: &Step| {
        let given = step.coordinates.iter().map(|(k, joint)| ((), [Cell::Word(*k as usize), Cell::Word(*joint)]));
        given.collect()
    };
    let coordinates = writer.lists("entries", steps.iter().map(given), |(), [k, joint]| quote! { (#k, #joint) });
    let entries = steps.iter().zip(joints.cells.into_iter().zip(coordinates.cells));
    let entries = entries.map(|(step, (joints, coordinates))| {
        let [modes, margins] = [&step.modes, &step.margins].map(|range| [range.start, range.end].map(Cell::Word));
        let ([first_mode, end_of_modes], [first_margin, end_of_margins]) = (modes, margins);
        let redundant = (step.kind == StepKind::RedundantRows).then_some(&step.rows);
        let kind = (step.kind, redundant, &step.group, &step.singular);
        (kind, [joints, coordinates, first_mode, end_of_modes, first_margin, end_of_margins])
    });
    let lists = [joints.whole, coordinates.whole];
    writer.with_lists("steps", entries, lists, |(kind, redundant, group, singular), cells| {
        let [joints, coordinates, first_mode, end_of_modes, first_margin, end_of_margins] = cells;
        let (name, unknowns) = (variant("StepKind", kind.variant()), kind.unknowns().map(|n| quote! { (#n) }));
        let rows = redundant.iter().flat_map(|rows| rows.iter());
        quote! {
            __kin::PlanStep {
                kind: #name #unknowns, rows: &[#(#rows),*], group: #group, joints: #joints, coordinates: #coordinates,
                modes: (#first_mode, #end_of_modes), margins: (#first_margin, #end_of_margins), singular: #singular,
            }
        }
    })
}

fn modes(modes: &[Mode], writer: Writer) -> TokenStream {
    let entries = modes.iter().map(|mode| {
        let [step, margin] = [mode.step.index(), mode.margin].map(Cell::Word);
        [Cell::Name(&mode.name), step, margin]
    });
    writer.alike("modes", entries, |[name, step, margin]| {
        quote! { __kin::ModeInfo { name: #name, step: #step, margin: #margin } }
    })
}
