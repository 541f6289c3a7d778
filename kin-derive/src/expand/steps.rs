//! The solution plan in the static model: its steps and its modes.

use super::packed::Packed;
use kin_core::plan::{Mode, SolutionPlan, Step};
use kin_core::vocabulary::StepKind;
use proc_macro2::TokenStream;
use quote::quote;

/// The table of a plan.
pub(super) fn table(plan: &SolutionPlan, packed: bool) -> TokenStream {
    if let Some(why) = &plan.absent {
        return quote! { __kin::Plan::absent(#why) };
    }
    let steps = if packed { packed_steps(plan) } else { steps(plan) };
    let [modes, orientations] =
        [&plan.modes, &plan.orientations].map(|list| if packed { packed_modes(list) } else { modes(list) });
    let margins = plan.margins;
    quote! {
        __kin::Plan {
            steps: #steps, modes: #modes, orientations: #orientations, margins: #margins, absent: __kin::None,
        }
    }
}

/// A step with these joints, coordinates, modes and margins.
fn step(step: &Step, [joints, coordinates, modes, margins]: [&TokenStream; 4]) -> TokenStream {
    let kind = match step.kind {
        StepKind::Explicit => quote! { __kin::StepKind::Explicit },
        StepKind::Linear(n) => quote! { __kin::StepKind::Linear(#n) },
        StepKind::Closure => quote! { __kin::StepKind::Closure },
        StepKind::Newton(n) => quote! { __kin::StepKind::Newton(#n) },
        StepKind::Watched => quote! { __kin::StepKind::Watched },
    };
    let (group, singular) = (&step.group, &step.singular);
    let rows = step.rows.iter().filter(|_| step.kind == StepKind::Watched);
    quote! {
        __kin::PlanStep {
            kind: #kind, rows: &[#(#rows),*], group: #group, joints: #joints, coordinates: #coordinates,
            modes: #modes, margins: #margins, singular: #singular,
        }
    }
}

fn steps(plan: &SolutionPlan) -> TokenStream {
    let steps = plan.steps.iter().map(|of| {
        let joints = &of.joints;
        let coordinates = of.coordinates.iter().map(|(k, joint)| {
            let k = *k as usize;
            quote! { (#k, #joint) }
        });
        let [modes, margins] = [&of.modes, &of.margins].map(|range| {
            let (start, end) = (range.start, range.end);
            quote! { (#start, #end) }
        });
        step(of, [&quote! { &[#(#joints),*] }, &quote! { &[#(#coordinates),*] }, &modes, &margins])
    });
    quote! { &[#(#steps),*] }
}

fn modes(modes: &[Mode]) -> TokenStream {
    let modes = modes.iter().map(|mode| {
        let (name, step, margin) = (&mode.name, mode.step.index(), mode.margin);
        quote! { __kin::ModeInfo { name: #name, step: #step, margin: #margin } }
    });
    quote! { &[#(#modes),*] }
}

/// Steps that are alike but for their places.
struct Alike<'p>(&'p Step);

impl PartialEq for Alike<'_> {
    fn eq(&self, other: &Self) -> bool {
        let (step, other) = (self.0, other.0);
        let alike = step.kind == other.kind && step.group == other.group && step.singular == other.singular;
        alike && (step.kind != StepKind::Watched || step.rows == other.rows)
    }
}

fn packed_steps(plan: &SolutionPlan) -> TokenStream {
    let mut packed = Packed::new(plan.steps.len());
    let mut joints = Packed::<()>::new(plan.steps.iter().map(|step| step.joints.len()).sum());
    let mut coordinates = Packed::<()>::new(plan.steps.iter().map(|step| step.coordinates.len()).sum());
    for step in &plan.steps {
        packed.kind(Alike(step));
        packed.word(step.joints.len());
        packed.word(step.coordinates.len());
        for end in [step.modes.start, step.modes.end, step.margins.start, step.margins.end] {
            packed.word(end);
        }
        step.joints.iter().for_each(|joint| joints.word(*joint));
        for (k, joint) in &step.coordinates {
            coordinates.word(*k as usize);
            coordinates.word(*joint);
        }
    }
    let nothing = quote! { &[] };
    let nowhere = quote! { (0, 0) };
    let kinds = packed.kinds(|alike| step(alike.0, [&nothing, &nothing, &nowhere, &nowhere]));
    let joints = joints.unpacked("numbers", &TokenStream::new());
    let coordinates = coordinates.unpacked("entries", &TokenStream::new());
    packed.unpacked("steps", &quote! { , #kinds, #joints, #coordinates })
}

fn packed_modes(modes: &[Mode]) -> TokenStream {
    let mut packed = Packed::<()>::new(modes.len());
    for mode in modes {
        packed.name(&mode.name);
        packed.word(mode.step.index());
        packed.word(mode.margin);
    }
    packed.unpacked("modes", &TokenStream::new())
}
