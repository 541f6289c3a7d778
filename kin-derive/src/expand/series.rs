//! Kernels of power series: Φ, the rows of velocity level and the observables in an arithmetic of the caller's.
//!
//! What depends on parameters alone is a number and computed once; everything else is a value of the arithmetic
//! (`kin_runtime::series::Arithmetic`), which may be a whole power series or one more coefficient of it. So a product
//! with a constant is no product of series.

use super::functions::series_closures;
use super::generics;
use super::kernel::Layout;
use super::program::{Reads, function_name};
use super::series_statements::Emitter;
use super::statements::BLOCK;
use crate::lower::Lowered;
use kin_core::program::{Program, Slot, lower};
use kin_core::rows;
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

/// The implementation of `PowerSeries`.
pub(super) fn implementation(lowered: &Lowered, system: &KinematicSystem, observables: &Layout) -> TokenStream {
    let name = &lowered.item.ident;
    let generics = generics::bounded(lowered, "Parameter");
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let set = &system.set;
    let phi = method(lowered, "constraint_series", &rows::values(&set.graph, &system.equations));
    let etas = set.rows.iter().enumerate().filter_map(|(row, info)| Some((Slot::Entry(row), info.velocity?.eta)));
    let etas: Vec<_> = etas.collect();
    let eta = (!etas.is_empty()).then(|| method(lowered, "velocity_series", &lower(&set.graph, &etas)));
    let seen = method(lowered, "observable_series", &observables.program(|slot| matches!(slot, Slot::Phi(_))));
    quote! {
        #[automatically_derived]
        impl #impl_generics __kin::PowerSeries for #name #type_generics #where_clause {
            #phi
            #eta
            #seen
        }
    }
}

/// A method of `PowerSeries` that runs `program`.
fn method(lowered: &Lowered, name: &str, program: &Program) -> TokenStream {
    let name = Ident::new(name, Span::call_site());
    let reads = Reads::of(program);
    let closures = if reads.functions.is_empty() { Vec::new() } else { series_closures(lowered) };
    let (mut arguments, mut types, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for number in &reads.functions {
        let Some(closure) = closures.get(*number as usize) else { continue };
        let (argument, ty) = (function_name(*number), format_ident!("__Function{number}"));
        arguments.push(quote! { #argument: &#ty });
        types.push(quote! { #ty: ::core::ops::Fn(f64, &mut [f64]) -> usize });
        values.push(quote! { &#closure });
    }
    let statements = body(program);
    quote! {
        #[inline(always)]
        fn #name<__X: __kin::Arithmetic>(
            &self,
            parameters: &[f64],
            x: &mut __X,
        ) -> __kin::Result<(), __kin::LengthError> {
            #[inline(always)]
            fn write<__X: __kin::Arithmetic #(, #types)*>(p: &__Parameters<f64>, x: &mut __X #(, #arguments)*) {
                let _ = (p, &x);
                #statements
            }
            write(__kin::fixed("parameters", parameters)?, x #(, #values)*);
            __kin::Ok(())
        }
    }
}

/// The statements of `program`: constants, then everything else, in blocks that hand out what later ones need.
fn body(program: &Program) -> TokenStream {
    if let Some(tokens) = super::rolled_series::body(program) {
        return tokens;
    }
    let emitter = Emitter::new(program);
    let (constants, mut others) = emitter.statements();
    emitter.place_outputs(&mut others);
    let (mut chunks, one) = (Vec::new(), others.len() <= BLOCK);
    chunks.extend(constants.chunks(BLOCK).map(|block| (true, block)));
    chunks.extend(others.chunks(BLOCK).map(|block| (false, block)));
    let mut block_of = vec![0_usize; program.instructions.len()];
    for (number, (_, block)) in chunks.iter().enumerate() {
        block.iter().flat_map(|s| &s.defines).for_each(|value| block_of[value.index()] = number);
    }
    // Constants that are rows themselves are written in the last block.
    let mut last_use = vec![0_usize; program.instructions.len()];
    for (_, value) in program.outputs.iter().filter(|(_, value)| emitter.constant[value.index()]) {
        last_use[emitter.holder(*value).index()] = chunks.len();
    }
    for (place, instruction) in program.instructions.iter().enumerate() {
        // Parts of pairs and triples have no statement: whoever uses a part uses the whole.
        instruction.for_each_operand(|operand| {
            let operand = emitter.holder(operand);
            last_use[operand.index()] = last_use[operand.index()].max(block_of[place]);
        });
    }
    let mut out = TokenStream::new();
    for (number, (constant, block)) in chunks.into_iter().enumerate() {
        let tokens = block.iter().map(|s| &s.tokens);
        if !constant && one {
            out.extend(quote! { #(#tokens)* });
            continue;
        }
        let leaving: Vec<Ident> = (block.iter().flat_map(|s| &s.defines))
            .filter(|value| last_use[value.index()] > number)
            .flat_map(|value| emitter.names(*value))
            .collect();
        out.extend(match (constant, leaving.is_empty()) {
            (_, true) => quote! { { #(#tokens)* } },
            (true, false) => {
                quote! { let [#(#leaving),*] = __kin::Arithmetic::constants(x, || { #(#tokens)* [#(#leaving),*] }); }
            }
            (false, false) => quote! { let [#(#leaving),*] = { #(#tokens)* [#(#leaving),*] }; },
        });
    }
    out
}
