//! `KinematicSystem` to Rust items. Cannot fail: everything that can be wrong has been reported before.
//!
//! Nothing iterates a hash map on the way here: the same description gives the same tokens.

mod curves;
mod derivation;
mod entries;
mod evaluations;
mod functions;
mod generics;
mod handles;
mod instructions;
mod joints;
mod kernel;
mod own_scalar;
mod packed;
mod parameters;
mod plan;
mod program;
mod rolled;
mod statements;
mod steps;
mod supplied;
mod tables;
mod test;

pub(crate) use derivation::WRITTEN;
pub(crate) use handles::{mentions, placeholders};
#[cfg(test)]
pub(crate) use instructions::literal;
pub(crate) use own_scalar::placeholder;

use crate::lower::Lowered;
use evaluations::{Evaluations, evaluate, lengths, list, observe, position_lengths, values, velocity_constraints};
use kernel::Layout;
use kin_core::plan::SolutionPlan;
use kin_core::structure::Structure;
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// All items of a mechanism: the struct, its handles, the trait, and what the flags ask for.
pub(crate) fn expand(
    lowered: &Lowered,
    system: &KinematicSystem,
    structure: &Structure,
    plan: &SolutionPlan,
    documentation: &TokenStream,
) -> TokenStream {
    let item = &lowered.item;
    let handles = handles::handles(lowered, system);
    let mechanism = mechanism(lowered, system, structure, plan);
    let default = parameters::default(lowered);
    let cross_check = test::cross_check(lowered);
    // After the user's own text: attributes of documentation are one text in their order.
    let (attributes, bare) = (&item.attrs, syn::ItemStruct { attrs: Vec::new(), ..item.clone() });
    quote! {
        #(#attributes)*
        #documentation
        #bare
        // Numbers of the user's that look like a rounded π are the user's business.
        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        const _: () = {
            use ::kin_runtime::private as __kin;
            // Not every mechanism uses all of them.
            #[allow(unused_imports)]
            use __kin::locals::*;
            #handles
            #mechanism
            #default
        };
        #cross_check
    }
}

/// The implementation of the trait.
fn mechanism(lowered: &Lowered, system: &KinematicSystem, structure: &Structure, plan: &SolutionPlan) -> TokenStream {
    let item = &lowered.item;
    let set = &system.set;
    let name = &item.ident;
    let generics = generics::bounded(lowered, "Parameter");
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let constraints = Layout::new(&set.graph, &system.equations, &set.row_families);
    let observables = Layout::new(&set.graph, &system.observables, &[]);
    let all = constraints.program(|_| true);
    let planned = plan::planned(lowered, system, plan);
    let tables = tables::model(&tables::Tables {
        mechanism: &lowered.mechanism,
        system,
        constraints: &constraints,
        observables: &observables,
        operations: all.operations(),
        doc: &lowered.docs.mechanism,
        allow_redundant: lowered.flags.allow_redundant,
        structure,
        plan,
    });
    let (n, s, p, u) = (set.coordinates.len(), set.rows.len(), set.parameters.len(), set.inputs.len());
    let (entries, seen, seen_entries) =
        (constraints.rows.entries.len(), set.observables.len(), observables.rows.entries.len());
    let parameters = parameters::read(lowered);
    let set_parameter = parameters::write(lowered);
    let (helpers, functions) = (supplied::helpers(lowered), supplied::access(lowered, system));
    let values = values(lowered, system, &constraints);
    let evaluations = Evaluations {
        evaluate: evaluate(lowered, system, &constraints, &all, &values),
        observe: observe(lowered, system, &observables),
        counts: [p, s, entries, seen, seen_entries],
    };
    let generic = own_scalar::own(lowered, &evaluations);
    let scalar = Ident::new("__T", Span::call_site());
    let [position_lengths, lengths] = [position_lengths(&scalar, "q"), lengths(&scalar)];
    let Evaluations { evaluate, observe, .. } = &evaluations;
    let factors = plan.factors;
    let (plan_items, plan_methods) = (&planned.items, &planned.methods);
    let kernels = [&values.item, &evaluate.item, &observe.item];
    let [values, evaluate, observe] = [&values.call, &evaluate.call, &observe.call];
    let velocity_constraints = velocity_constraints(lowered, system, &lengths);
    let geometry = list(lowered, system, set.geometry.iter().copied());
    let kept_lengths = kept_lengths(lowered, system);
    let curves = curves::curves(lowered, system);
    let guesses = list(lowered, system, set.guesses.iter().map(|(_, value)| *value));
    quote! {
        type __Parameters<__T> = [__T; #p];
        type __Inputs<__T> = [__kin::Signal<__T>; #u];
        type __Coordinates<__T> = [__T; #n];

        #tables

        #helpers

        #(#kernels)*

        #plan_items

        #generic

        #[automatically_derived]
        impl #impl_generics __kin::Mechanism for #name #type_generics #where_clause {
            const COORDINATES: usize = #n;
            const ROWS: usize = #s;
            const PARAMETERS: usize = #p;
            const INPUTS: usize = #u;
            type Parameters<__T: __kin::Scalar> = [__T; #p];
            type Inputs<__T: __kin::Scalar> = [__kin::Signal<__T>; #u];
            type Coordinates<__T: __kin::Scalar> = [__T; #n];
            type Rows<__T: __kin::Scalar> = [__T; #s];
            type NonZeros<__T: __kin::Scalar> = [__T; #entries];
            type Observables<__T: __kin::Scalar> = [__T; #seen];
            type ObservableNonZeros<__T: __kin::Scalar> = [__T; #seen_entries];
            type Factors<__T: __kin::Scalar> = [__T; #factors];

            fn model() -> &'static __kin::Model {
                &__MODEL
            }

            #parameters
            #set_parameter
            #functions

            fn constraints_with<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                phi: &mut [__T; #s],
            ) -> __kin::Result<(), __kin::LengthError> {
                #position_lengths
                let _ = (p, u, q, &phi);
                #values
                __kin::Ok(())
            }

            #velocity_constraints

            #plan_methods

            #[inline(always)]
            fn evaluate_with<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                subset: __kin::Subset,
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                q_dot: &[__T],
                workspace: &mut __kin::Workspace<Self, __T>,
            ) -> __kin::Result<(), __kin::LengthError> {
                #lengths
                #evaluate
                __kin::Ok(())
            }

            #[inline]
            fn observe_with<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                q_dot: &[__T],
                observations: &mut __kin::Observations<Self, __T>,
            ) -> __kin::Result<(), __kin::LengthError> {
                #lengths
                #observe
                __kin::Ok(())
            }

            #[inline]
            fn write_geometry<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                at: &__kin::Instant<'_, __T>,
                geometry: &mut [__T],
            ) -> __kin::Result<(), __kin::LengthError> {
                let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
                let u: &__Inputs<__T> = __kin::fixed("inputs", at.inputs)?;
                let out = __kin::fixed_mut("geometry", geometry)?;
                let _ = (p, u);
                #geometry
                __kin::Ok(())
            }

            #kept_lengths

            fn write_guesses<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                guesses: &mut [__T],
            ) -> __kin::Result<(), __kin::LengthError> {
                let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
                let out = __kin::fixed_mut("guesses", guesses)?;
                let _ = p;
                #guesses
                __kin::Ok(())
            }

            #curves
        }
    }
}

/// The lengths that joints keep, where there are any.
fn kept_lengths(lowered: &Lowered, system: &KinematicSystem) -> TokenStream {
    let count = system.set.kept_lengths().count();
    if count == 0 {
        return TokenStream::new();
    }
    let lengths = list(lowered, system, system.set.kept_lengths());
    quote! {
        const LENGTHS: usize = #count;

        #[inline]
        fn lengths_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            lengths: &mut [__T],
        ) -> __kin::Result<(), __kin::LengthError> {
            let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
            let u: &__Inputs<__T> = __kin::fixed("inputs", at.inputs)?;
            let out = __kin::fixed_mut("lengths", lengths)?;
            let _ = (p, u);
            #lengths
            __kin::Ok(())
        }
    }
}
