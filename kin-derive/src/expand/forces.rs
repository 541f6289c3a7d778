//! The static table that describes the numbers computed by the programs of forces; empty for a mechanism without loads.

use super::derivation::dynamics;
use super::entries::{frame, optional};
use super::tables::operations;
use kin_core::Kernels;
use kin_core::loads::Forces;
use kin_core::mechanism::Mechanism;
use kin_core::system::KinematicSystem;
use kin_core::units::{ForceUnits, force_units};
use proc_macro2::TokenStream;
use quote::quote;

/// The static table as an item beside the trait's implementation.
pub(super) fn forces(
    forces: Option<&Forces>,
    kernels: &Kernels,
    mechanism: &Mechanism,
    system: &KinematicSystem,
) -> TokenStream {
    let (Some(forces), Some(count)) = (forces, kernels.force_operations) else { return TokenStream::new() };
    let Forces { count: numbers, of_multipliers, efforts, reactions, springs, masses, loads, .. } = forces;
    let solved = of_multipliers.is_some();
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
        let [has_normal, has_tangential, has_tension] =
            [reaction.normal, reaction.tangential, reaction.tension].map(|component| component.is_some());
        quote! {
            __kin::ReactionInfo {
                name: #name, on: #on, place: #place, has_force: #has_force, has_moment: #has_moment,
                couples: &[#(#couples),*], generalized: #generalized,
                has_normal: #has_normal, has_tangential: #has_tangential, has_tension: #has_tension,
            }
        }
    });
    let springs = springs.iter().map(|spring| {
        let (name, turns, place) = (&spring.name, spring.turns, spring.place);
        quote! { __kin::SpringInfo { name: #name, turns: #turns, place: #place } }
    });
    let masses = masses.iter().map(|mass| {
        let (on, place) = (frame(mass.on), mass.place);
        quote! { __kin::MassInfo { on: #on, place: #place } }
    });
    let loads = loads.iter().map(|load| {
        let (name, on, place, is_force) = (&load.name, frame(load.on), load.place, load.is_force);
        quote! { __kin::LoadInfo { name: #name, on: #on, place: #place, is_force: #is_force } }
    });
    let ForceUnits { force, moment, energy, power } = force_units(mechanism);
    let [force, moment, energy, power] = [force, moment, energy, power].map(optional);
    let rows = system.set.rows.len();
    let [mass_matrix, generalized] = dynamics(mechanism, system);
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
            masses: &[#(#masses),*],
            loads: &[#(#loads),*],
            units: __kin::ForceUnits { force: #force, moment: #moment, energy: #energy, power: #power },
            mass_matrix: &[#(#mass_matrix),*],
            generalized: &[#(#generalized),*],
        };
    }
}
