//! Kernels: the functions that evaluate a set of rows, one for every subset worth its own code.

use super::functions::{Supplied, functions};
use super::instructions::{function_names, target_name};
use super::program::{Reads, body};
use crate::lower::Lowered;
use kin_core::constraint::Family;
use kin_core::expr::Graph;
use kin_core::program::{Program, Slot};
use kin_core::rows::Rows;
use kin_core::system::Equation;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

/// The rows of a system as outputs, with the pattern of its Jacobian.
pub(crate) struct Layout {
    pub(crate) rows: Rows,
    families: Vec<Family>,
}

impl Layout {
    /// Lays out equations.
    pub(crate) fn new(graph: &Graph, equations: &[Equation], families: &[Family]) -> Self {
        Self { rows: Rows::new(graph, equations, families), families: families.to_vec() }
    }

    /// The program of the outputs that `keep` keeps; each to the last bit what the program of all of them gives.
    pub(crate) fn program(&self, keep: impl Fn(Slot) -> bool) -> Program {
        let mut program = self.rows.program.only(keep);
        for family in &self.families {
            let layout = [family.first, family.members, family.stride];
            program.note_family(&family.name, layout, |slot| self.row_of(slot));
        }
        program
    }

    /// The row that an output belongs to.
    fn row_of(&self, slot: Slot) -> Option<usize> {
        match slot {
            Slot::Phi(row) | Slot::PhiT(row) | Slot::Gamma(row) => Some(row),
            Slot::PhiQ(place) => self.rows.entries.get(place).map(|entry| entry.0),
            _ => None,
        }
    }
}

/// A kernel as a function item, and the call of it.
pub(crate) struct Kernel {
    pub(crate) item: TokenStream,
    pub(crate) call: TokenStream,
}

/// The kernel `name` of `program`; `targets` are the arrays it may write: (name, type), in the caller's scope.
///
/// A kernel stands outside of the struct's generics, so that it takes supplied functions as arguments of any type.
pub(crate) fn kernel(name: &str, lowered: &Lowered, program: &Program, targets: &[(&str, TokenStream)]) -> Kernel {
    kernel_after(name, lowered, program, targets, "__Held", &quote! { #[inline] })
}

/// A kernel that reads values held in an array of the type `held`, and says with `inline` where its code goes.
pub(crate) fn kernel_after(
    name: &str,
    lowered: &Lowered,
    program: &Program,
    targets: &[(&str, TokenStream)],
    held: &str,
    inline: &TokenStream,
) -> Kernel {
    let held = Ident::new(held, Span::call_site());
    let name = Ident::new(name, Span::call_site());
    let reads = Reads::of(program);
    let writes = |target: &str| program.outputs.iter().any(|(slot, _)| target_name(*slot) == target);
    let inputs = [
        (reads.parameters, "p", quote! { &__Parameters<__T> }, quote! { p }),
        (reads.time, "t", quote! { __T }, quote! { at.t }),
        (reads.inputs, "u", quote! { &__Inputs<__T> }, quote! { u }),
        (reads.coordinates, "q", quote! { &__Coordinates<__T> }, quote! { q }),
        (reads.argument, "s", quote! { __T }, quote! { s }),
        (reads.rates, "w", quote! { &__Coordinates<__T> }, quote! { w }),
        (reads.modes, "modes", quote! { &__Modes<__T> }, quote! { modes }),
        (reads.start, "start", quote! { &__Coordinates<__T> }, quote! { start }),
        (reads.unknowns, "unknowns", quote! { &__Coordinates<__T> }, quote! { unknowns }),
        // What a kernel both reads and leaves is one array.
        (reads.held && !writes("held"), "held", quote! { &#held<__T> }, quote! { held }),
        (reads.right, "right", quote! { &__Rows<__T> }, quote! { right }),
    ];
    let (mut arguments, mut values) = (Vec::new(), Vec::new());
    for (_, argument, ty, value) in inputs.into_iter().filter(|(used, ..)| *used) {
        let argument = Ident::new(argument, Span::call_site());
        arguments.push(quote! { #argument: #ty });
        values.push(value);
    }
    let mut types = Vec::new();
    let functions = if reads.functions.is_empty() { Vec::new() } else { functions(lowered) };
    for number in &reads.functions {
        let Some(function) = functions.get(*number as usize) else { continue };
        let [argument, higher] = function_names(*number);
        let [ty, higher_ty] = [format_ident!("__Function{number}"), format_ident!("__Derivatives{number}")];
        arguments.push(quote! { #argument: &#ty, #higher: &#higher_ty });
        let Supplied { value, derivatives } = function;
        values.push(quote! { &#value, &#derivatives });
        types.push(quote! { #ty: ::core::ops::Fn(f64) -> [f64; 3] });
        types.push(quote! { #higher_ty: ::core::ops::Fn(f64, &mut [f64]) -> usize });
    }
    for (target, ty) in targets {
        if writes(target) {
            let target = Ident::new(target, Span::call_site());
            arguments.push(quote! { #target: &mut #ty });
            values.push(quote! { #target });
        }
    }
    if arguments.is_empty() {
        return Kernel { item: TokenStream::new(), call: TokenStream::new() };
    }
    let statements = body(program);
    Kernel {
        item: quote! {
            #inline
            fn #name<__T: __kin::Scalar #(, #types)*>(#(#arguments),*) { #statements }
        },
        call: quote! { #name(#(#values),*); },
    }
}
