//! `KinematicSystem` to Rust items. Cannot fail: everything that can be wrong has been reported before.
//!
//! Nothing iterates a hash map on the way here: the same description gives the same tokens.

mod handles;
mod kernel;
mod parameters;
mod program;
mod tables;

pub(crate) use handles::{mentions, placeholders};

use crate::ast::Flags;
use crate::lower::{FieldRole, Lowered};
use kernel::{Layout, kernel};
use kin_core::program::{Program, Slot, lower};
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

/// All items of a mechanism: the struct, its handles, the trait, and what the flags ask for.
pub(crate) fn expand(lowered: &Lowered, system: &KinematicSystem) -> TokenStream {
    let item = &lowered.item;
    let handles = handles::handles(lowered, system);
    let mechanism = mechanism(lowered, system);
    let default = parameters::default(lowered);
    let cross_check = cross_check(&item.ident, lowered.flags);
    quote! {
        #item
        const _: () = {
            use ::kin_runtime::private as __kin;
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
fn mechanism(lowered: &Lowered, system: &KinematicSystem) -> TokenStream {
    let item = &lowered.item;
    let set = &system.set;
    let name = &item.ident;
    let (impl_generics, type_generics, where_clause) = item.generics.split_for_impl();
    let constraints = Layout::new(&set.graph, &system.equations, &set.row_families);
    let observables = Layout::new(&set.graph, &system.observables, &[]);
    let all = constraints.program(&set.graph, |_| true);
    let tables = tables::model(&tables::Tables {
        mechanism: &lowered.mechanism,
        system,
        constraints: &constraints,
        observables: &observables,
        operations: all.operations(),
        doc: &lowered.docs.mechanism,
        allow_redundant: lowered.flags.allow_redundant,
    });
    let (n, s, p, u) = (set.coordinates.len(), set.rows.len(), set.parameters.len(), set.inputs.len());
    let (entries, seen, seen_entries) = (constraints.entries.len(), set.observables.len(), observables.entries.len());
    let parameters = parameters::read(lowered);
    let set_parameter = parameters::write(lowered);
    let values = values(lowered, system, &constraints);
    let evaluate = evaluate(lowered, system, &constraints, &all);
    let observe = observe(lowered, system, &observables);
    let geometry = list(lowered, system, set.geometry.iter().copied());
    let guesses = list(lowered, system, set.guesses.iter().map(|(_, value)| *value));
    quote! {
        type __Parameters<__T> = [__T; #p];
        type __Inputs<__T> = [__kin::Signal<__T>; #u];
        type __Coordinates<__T> = [__T; #n];

        #[automatically_derived]
        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        impl #impl_generics __kin::Mechanism for #name #type_generics #where_clause {
            const COORDINATES: usize = #n;
            const ROWS: usize = #s;
            const PARAMETERS: usize = #p;
            const INPUTS: usize = #u;
            type Parameters<__T: __kin::Scalar> = [__T; #p];
            type Coordinates<__T: __kin::Scalar> = [__T; #n];
            type Rows<__T: __kin::Scalar> = [__T; #s];
            type NonZeros<__T: __kin::Scalar> = [__T; #entries];
            type Observables<__T: __kin::Scalar> = [__T; #seen];
            type ObservableNonZeros<__T: __kin::Scalar> = [__T; #seen_entries];

            fn model() -> &'static __kin::Model {
                static MODEL: __kin::Model = #tables;
                &MODEL
            }

            #parameters
            #set_parameter

            fn constraints_with<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                phi: &mut [__T; #s],
            ) -> __kin::Result<(), __kin::LengthError> {
                #values
            }

            fn evaluate_with<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                subset: __kin::Subset,
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                q_dot: &[__T],
                workspace: &mut __kin::Workspace<Self, __T>,
            ) -> __kin::Result<(), __kin::LengthError> {
                #evaluate
            }

            fn observe_with<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                q_dot: &[__T],
                observations: &mut __kin::Observations<Self, __T>,
            ) -> __kin::Result<(), __kin::LengthError> {
                #observe
            }

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
        }
    }
}

/// The four arrays of an evaluation with their types.
fn targets(rows: usize, entries: usize) -> [(&'static str, TokenStream); 4] {
    [
        ("phi", quote! { [__T; #rows] }),
        ("phi_q", quote! { [__T; #entries] }),
        ("phi_t", quote! { [__T; #rows] }),
        ("gamma", quote! { [__T; #rows] }),
    ]
}

fn lengths() -> TokenStream {
    let position = position_lengths();
    quote! {
        #position
        let w: &__Coordinates<__T> = __kin::fixed("q_dot", q_dot)?;
    }
}

fn position_lengths() -> TokenStream {
    quote! {
        let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
        let u: &__Inputs<__T> = __kin::fixed("inputs", at.inputs)?;
        let q: &__Coordinates<__T> = __kin::fixed("q", q)?;
    }
}

/// Φ alone, in a function of its own: what is only evaluated for Φ (dual numbers) compiles nothing else.
fn values(lowered: &Lowered, system: &KinematicSystem, layout: &Layout) -> TokenStream {
    let program = layout.program(&system.set.graph, |slot| matches!(slot, Slot::Phi(_)));
    let targets = targets(system.set.rows.len(), layout.entries.len());
    let name = Ident::new("values", Span::call_site());
    let kernel = kernel(&name, &lowered.item.ident, &program, &functions(lowered), &targets);
    let (item, call, lengths) = (kernel.item, kernel.call, position_lengths());
    quote! {
        #item
        #lengths
        let _ = (p, u, q, &phi);
        #call
        __kin::Ok(())
    }
}

fn evaluate(lowered: &Lowered, system: &KinematicSystem, layout: &Layout, all: &Program) -> TokenStream {
    let graph = &system.set.graph;
    let targets = targets(system.set.rows.len(), layout.entries.len());
    let functions = functions(lowered);
    let named = |name: &str, program: &Program| {
        kernel(&Ident::new(name, Span::call_site()), &lowered.item.ident, program, &functions, &targets)
    };
    let position = layout.program(graph, |slot| matches!(slot, Slot::Phi(_) | Slot::PhiQ(_)));
    let position = named("values_and_jacobian", &position);
    let velocity = layout.program(graph, |slot| matches!(slot, Slot::PhiQ(_) | Slot::PhiT(_)));
    let velocity = named("jacobian_and_rates", &velocity);
    let all = named("everything", all);
    let items = [&position, &velocity, &all].map(|kernel| &kernel.item);
    let [position, velocity, all] = [&position, &velocity, &all].map(|kernel| &kernel.call);
    let lengths = lengths();
    quote! {
        #(#items)*
        #lengths
        let (phi, phi_q, phi_t, gamma) = workspace.parts_mut();
        let _ = (p, u, q, w, &phi, &phi_q, &phi_t, &gamma);
        if subset.gamma || subset.phi && subset.phi_t {
            #all
        } else if subset.phi_t {
            #velocity
        } else if subset.phi_q {
            #position
        } else if subset.phi {
            __kin::Mechanism::constraints_with(self, parameters, at, q, phi)?;
        }
        __kin::Ok(())
    }
}

fn observe(lowered: &Lowered, system: &KinematicSystem, layout: &Layout) -> TokenStream {
    let targets = targets(system.set.observables.len(), layout.entries.len());
    let program = layout.program(&system.set.graph, |_| true);
    let name = Ident::new("observe", Span::call_site());
    let kernel = kernel(&name, &lowered.item.ident, &program, &functions(lowered), &targets);
    let (item, call, lengths) = (kernel.item, kernel.call, lengths());
    quote! {
        #item
        #lengths
        let (phi, phi_q, phi_t, gamma) = observations.parts_mut();
        let _ = (p, u, q, w, &phi, &phi_q, &phi_t, &gamma);
        #call
        __kin::Ok(())
    }
}

/// A kernel that writes a plain list of expressions.
fn list(
    lowered: &Lowered,
    system: &KinematicSystem,
    values: impl Iterator<Item = kin_core::expr::ExprId>,
) -> TokenStream {
    let outputs: Vec<_> = values.enumerate().map(|(place, value)| (Slot::Entry(place), value)).collect();
    let count = outputs.len();
    let program = lower(&system.set.graph, &outputs);
    let name = Ident::new("write", Span::call_site());
    let kernel =
        kernel(&name, &lowered.item.ident, &program, &functions(lowered), &[("out", quote! { [__T; #count] })]);
    let (item, call) = (kernel.item, kernel.call);
    quote! {
        #item
        let out: &mut [__T; #count] = out;
        let _ = &out;
        #call
    }
}

/// The fields that hold supplied functions.
fn functions(lowered: &Lowered) -> Vec<Ident> {
    let is_function = |role| matches!(role, FieldRole::Function(_));
    lowered.fields.iter().filter(|field| is_function(field.role)).map(|field| field.ident.clone()).collect()
}

/// The test that `#[mechanism(cross_check)]` writes.
fn cross_check(name: &Ident, flags: Flags) -> TokenStream {
    if !flags.cross_check {
        return TokenStream::new();
    }
    let test = format_ident!("cross_check_of_{}", snake_case(&name.to_string()));
    let failure = "the closed forms and the dual numbers disagree";
    let name = name.to_token_stream();
    quote! {
        #[cfg(test)]
        #[test]
        fn #test() {
            let __checked = ::kin_runtime::private::cross_check(&<#name as ::core::default::Default>::default());
            if let ::core::result::Result::Err(__difference) = __checked {
                ::core::panic!("{}: {}", #failure, __difference);
            }
        }
    }
}

fn snake_case(name: &str) -> String {
    let mut out = String::new();
    for (place, c) in name.trim_start_matches("r#").char_indices() {
        if c.is_uppercase() && place > 0 && !out.ends_with('_') {
            out.push('_');
        }
        out.extend(c.to_lowercase());
    }
    out
}
