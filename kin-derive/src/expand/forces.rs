//! The table of forces: what the numbers are that their closed forms write. Nothing for a mechanism without loads.

use super::entries::{frame, optional};
use super::tables::operations;
use kin_core::Kernels;
use kin_core::loads::Forces;
use proc_macro2::TokenStream;
use quote::quote;

/// What forces add to a mechanism.
pub(super) struct ForceTokens {
    /// Types and tables, beside the trait.
    pub(super) items: TokenStream,
    /// Methods of the trait.
    pub(super) methods: TokenStream,
}

/// The static table and the method that gives it.
pub(super) fn forces(forces: Option<&Forces>, kernels: &Kernels, rows: usize) -> ForceTokens {
    let (Some(forces), Some(count)) = (forces, kernels.force_operations) else {
        return ForceTokens { items: TokenStream::new(), methods: TokenStream::new() };
    };
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
    // With a plan there is such a type.
    let multipliers = kernels.solution.is_none().then(|| quote! { type __Rows<__T> = [__T; #rows]; });
    ForceTokens {
        items: quote! {
            #multipliers
            static __FORCES: __kin::ForceModel = __kin::ForceModel {
                count: #numbers,
                solved: #solved,
                operations: #operations,
                efforts: &[#(#efforts),*],
                reactions: &[#(#reactions),*],
                springs: &[#(#springs),*],
            };
        },
        methods: quote! {
            fn force_model() -> __kin::Option<&'static __kin::ForceModel> {
                __kin::Some(&__FORCES)
            }
        },
    }
}
