//! Prints kernels and tables as Rust items. This stage cannot fail, because all errors have been reported before, and
//! it computes nothing, because `kin_core::kernels` has finished every program.
//!
//! No hash map is iterated here, so that the same description always gives the same tokens.

mod code;
mod derivation;
mod elements;
mod entries;
mod forces;
mod functions;
mod generics;
mod handles;
mod instructions;
mod joints;
mod kernel;
mod lists;
mod own_scalar;
mod parameters;
mod plan;
mod rows;
mod statements;
mod steps;
mod supplied;
mod table;
mod tables;
mod test;

pub(crate) use derivation::DERIVATION_AS_TEXT;
pub(crate) use handles::{mentions, placeholders};
#[cfg(test)]
pub(crate) use instructions::literal;
pub(crate) use own_scalar::placeholder;

use crate::lower::Lowered;
use kin_core::Kernels;
use kin_core::loads::Forces;
use kin_core::plan::SolutionPlan;
use kin_core::structure::Structure;
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use rows::{Evaluations, evaluations, lengths, method, position_lengths};

/// All items of a mechanism: the struct, its handles, the implementation of the trait, and the test that a flag
/// requests.
pub(crate) fn expand(
    lowered: &Lowered,
    system: &KinematicSystem,
    structure: &Structure,
    plan: &SolutionPlan,
    forces: Option<&Forces>,
    kernels: &Kernels,
    documentation: &TokenStream,
) -> TokenStream {
    let item = &lowered.item;
    let handles = handles::handles(lowered, system);
    let mechanism = mechanism(lowered, system, structure, plan, forces, kernels);
    let default = parameters::default(lowered);
    let cross_check = test::cross_check(lowered);
    // Placed after the user's documentation, because doc attributes are joined in their order.
    let (attributes, bare) = (&item.attrs, syn::ItemStruct { attrs: Vec::new(), ..item.clone() });
    quote! {
        #(#attributes)*
        #documentation
        #bare
        // The user's numbers may resemble a rounded π, which is not an error. What is deprecated is so for its users.
        #[allow(clippy::all, clippy::pedantic, clippy::nursery, deprecated)]
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
fn mechanism(
    lowered: &Lowered,
    system: &KinematicSystem,
    structure: &Structure,
    plan: &SolutionPlan,
    forces: Option<&Forces>,
    kernels: &Kernels,
) -> TokenStream {
    let (item, set) = (&lowered.item, &system.set);
    let name = &item.ident;
    let generics = generics::bounded(lowered, "Parameter");
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let (n, u) = (set.coordinates.len(), set.inputs.len());
    let evaluations = evaluations(lowered, kernels, set.parameters.len());
    let generic = own_scalar::own(lowered, &evaluations);
    let Evaluations { items: row_items, values, evaluate, observe, counts } = evaluations;
    let [p, s, entries, seen, seen_entries] = counts;
    let planned = plan::planned(lowered, kernels, plan, n);
    let force_items = forces::forces(forces, kernels, &lowered.mechanism, system);
    let (factors, plan_items, plan_methods) = (plan.factors, planned.items, planned.methods);
    let tables = tables::model(&tables::Tables {
        mechanism: &lowered.mechanism,
        system,
        kernels,
        doc: &lowered.docs.mechanism,
        allow_redundant: lowered.flags.allow_redundant,
        structure,
        plan,
    });
    let [read, write] = [parameters::read(lowered), parameters::write(lowered)];
    let (helpers, functions) = (supplied::helpers(lowered), supplied::access(lowered));
    let scalar = Ident::new("__T", Span::call_site());
    let [position_lengths, lengths] = [position_lengths(&scalar, "q"), lengths(&scalar)];
    let (lists, curves, kept_lengths) =
        (lists::lists(lowered, kernels), lists::curves(lowered, kernels), set.kept_lengths().count());
    let turning = kernels.turns_rows().then(|| quote! { const ROWS_TURN: bool = true; });
    let distances = (!plan.closeness.outputs.is_empty()).then(|| quote! { const DISTANCES_IN_ROWS: bool = true; });
    let within = plan.looks_within.then(|| quote! { const CLOSED_ROWS_TURN: bool = true; });
    let curving = plan.iterates_on_curves.then(|| quote! { const ROWS_CURVE: bool = true; });
    let (known_curves, in_curves) = (plan.known_curves.program.outputs.len(), &plan.known_curves.supplied);
    let hiding = plan.known_curves.hide_motion.then(|| quote! { const KNOWN_VALUES_CURVE: bool = true; });
    let bent = plan.known_curves.inputs_curve.then(|| quote! { const INPUTS_CURVE: bool = true; });
    let in_curves =
        (!in_curves.is_empty()).then(|| quote! { const FUNCTIONS_IN_CURVES: &'static [usize] = &[#(#in_curves),*]; });
    let constraints_with = method(
        &TokenStream::new(),
        "constraints_with",
        &quote! { q: &[__T], phi: &mut [__T; #s], },
        &quote! { #position_lengths let _ = (p, u, q, &phi); #values __kin::Ok(()) },
    );
    let evaluate_with = quote! {
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
    };
    let observe_with = method(
        &quote! { #[inline] },
        "observe_with",
        &quote! { q: &[__T], q_dot: &[__T], observations: &mut __kin::Observations<Self, __T>, },
        &quote! { #lengths #observe __kin::Ok(()) },
    );
    quote! {
        type __Parameters<__T> = [__T; #p];
        type __Inputs<__T> = [__kin::Signal<__T>; #u];
        type __Coordinates<__T> = [__T; #n];

        #tables

        #helpers

        #row_items

        #plan_items

        #force_items

        #generic

        #[automatically_derived]
        impl #impl_generics __kin::Mechanism for #name #type_generics #where_clause {
            const COORDINATES: usize = #n;
            const ROWS: usize = #s;
            const PARAMETERS: usize = #p;
            const INPUTS: usize = #u;
            const LENGTHS: usize = #kept_lengths;
            #turning #distances #within
            #curving
            #hiding
            #bent
            #in_curves
            type Parameters<__T: __kin::Scalar> = [__T; #p];
            type Inputs<__T: __kin::Scalar> = [__kin::Signal<__T>; #u];
            type Coordinates<__T: __kin::Scalar> = [__T; #n];
            type Rows<__T: __kin::Scalar> = [__T; #s];
            type NonZeros<__T: __kin::Scalar> = [__T; #entries];
            type Observables<__T: __kin::Scalar> = [__T; #seen];
            type ObservableNonZeros<__T: __kin::Scalar> = [__T; #seen_entries];
            type Factors<__T: __kin::Scalar> = [__T; #factors];
            type KnownCurves<__T: __kin::Scalar> = [__T; #known_curves];

            fn model() -> &'static __kin::Model {
                &__MODEL
            }

            #read
            #write
            #functions

            #constraints_with
            #plan_methods
            #evaluate_with
            #observe_with
            #lists

            #curves
        }
    }
}
