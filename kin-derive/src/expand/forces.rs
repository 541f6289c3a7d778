//! The static table that describes the numbers of the closed forms of forces; empty for a mechanism without loads.

use super::entries::{frame, optional};
use super::tables::operations;
use kin_core::Kernels;
use kin_core::loads::Forces;
use proc_macro2::TokenStream;
use quote::quote;

/// The static table as an item beside the trait's implementation.
pub(super) fn forces(forces: Option<&Forces>, kernels: &Kernels, rows: usize) -> TokenStream {
    let (Some(forces), Some(count)) = (forces, kernels.force_operations) else { return TokenStream::new() };
    let Forces { count: numbers, solved, efforts, reactions, springs, .. } = forces;
    let operations = operations(count);
    let efforts = efforts.iter().map(|effort| {
        let (name, place) = (&effort.name, effort.place);
        quote! { __kin::EffortInfo { name: #name, place: #place } }
    });
    let reactions = reactions.iter().map(|reaction| {
        let (name, on, place) = (&reaction.name, optional(reaction.on.map(frame)), reaction.place);
        let (has_force, has_moment) = (reaction.force.is_some(), reaction.moment.is_some());
        let couples = reaction.couples.iter().map(|(body, _)| frame(*body));
        let generalized = reaction.generalized.len();
        quote! {
            __kin::ReactionInfo {
                name: #name, on: #on, place: #place, has_force: #has_force, has_moment: #has_moment,
                couples: &[#(#couples),*], generalized: #generalized,
            }
        }
    });
    let springs = springs.iter().map(|spring| {
        let (name, turns, place) = (&spring.name, spring.turns, spring.place);
        quote! { __kin::SpringInfo { name: #name, turns: #turns, place: #place } }
    });
    // With a plan this type has already been defined.
    let multipliers = kernels.solution.is_none().then(|| quote! { type __Rows<__T> = [__T; #rows]; });
    quote! {
        #multipliers
        static __FORCES: __kin::ForceModel = __kin::ForceModel {
            count: #numbers,
            solved: #solved,
            operations: #operations,
            efforts: &[#(#efforts),*],
            reactions: &[#(#reactions),*],
            springs: &[#(#springs),*],
        };
    }
}
