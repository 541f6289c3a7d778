//! The derivation as text in the static model, only with the feature `equations`, so that programs for controllers do
//! not contain it.

use kin_core::loads;
use kin_core::mechanism::Mechanism;
use kin_core::plan::{Line, SolutionPlan};
use kin_core::system::KinematicSystem;
use proc_macro2::TokenStream;
use quote::quote;

/// Whether the derivation is written. In tests it is not, so that snapshots do not depend on the features that other
/// crates of a workspace enable.
pub(crate) const DERIVATION_AS_TEXT: bool = cfg!(feature = "equations") && !cfg!(test);

/// The text of Φ, Φ_q, Φ_t and γ, row by row.
pub(super) fn equations(system: &KinematicSystem) -> Vec<TokenStream> {
    if !DERIVATION_AS_TEXT {
        return Vec::new();
    }
    let set = &system.set;
    (set.rows.iter().zip(&system.equations))
        .map(|(row, equation)| {
            let value = row.velocity.map_or(equation.phi, |velocity| velocity.eta);
            let (name, phi) = (&row.name, set.show(value));
            let (phi_t, gamma) = (set.show(equation.phi_t), set.show(equation.gamma));
            let entries = equation.phi_q.iter().map(|(k, e)| {
                let (coordinate, e) = (set.coordinate_name(*k), set.show(*e));
                quote! { (#coordinate, #e) }
            });
            quote! {
                __kin::EquationText {
                    row: #name, phi: #phi, phi_q: &[#(#entries),*], phi_t: #phi_t, gamma: #gamma,
                }
            }
        })
        .collect()
}

/// The text of M and Q: entries of M that are not 0, and all of Q.
pub(super) fn dynamics(mechanism: &Mechanism, system: &KinematicSystem) -> [Vec<TokenStream>; 2] {
    let Some(texts) = DERIVATION_AS_TEXT.then(|| loads::dynamics(mechanism, system)).flatten() else {
        return Default::default();
    };
    let mass = texts.mass.iter().map(|(row, column, entry)| quote! { (#row, #column, #entry) });
    [mass.collect(), texts.forces.iter().map(|force| quote! { #force }).collect()]
}

/// The text of the plan's closed forms, step by step.
pub(super) fn solution(plan: &SolutionPlan) -> impl Iterator<Item = TokenStream> {
    plan.formulas.iter().map(|formulas| {
        let (step, description) = (formulas.step.index(), &formulas.what);
        let lines = formulas.lines.iter().map(|lines| {
            let lines = lines.iter().map(line);
            quote! { &[#(#lines),*] }
        });
        quote! { __kin::StepText { step: #step, what: #description, lines: [#(#lines),*] } }
    })
}

fn line(line: &Line) -> TokenStream {
    match line {
        Line::Equation { left, right } => {
            quote! { __kin::LineText::Equation { left: #left, right: #right } }
        }
        Line::Zero { left, right } => quote! { __kin::LineText::Zero { left: #left, right: #right } },
        Line::System { matrix, unknowns, right } => {
            let matrix = matrix.iter().map(|row| quote! { &[#(#row),*] });
            quote! {
                __kin::LineText::System {
                    matrix: &[#(#matrix),*], unknowns: &[#(#unknowns),*], right: &[#(#right),*],
                }
            }
        }
    }
}
