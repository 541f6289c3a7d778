//! The solution plan: its parts as kernels, and the methods that call them.

use super::entries::variant;
use super::kernel::kernel;
use super::rows::{method, position_lengths};
use crate::lower::Lowered;
use kin_core::kernels::{Iteration, Kernels, SolutionKernels};
use kin_core::plan::SolutionPlan;
use kin_core::vocabulary::Depth;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// The code that a plan adds to a mechanism.
#[derive(Default)]
pub(super) struct Planned {
    /// Types and kernels, beside the trait's implementation.
    pub(super) items: TokenStream,
    /// Methods of the trait.
    pub(super) methods: TokenStream,
}

/// The code of a plan.
pub(super) fn planned(lowered: &Lowered, kernels: &Kernels, plan: &SolutionPlan, n: usize) -> Planned {
    let Some(solution) = &kernels.solution else { return Planned::default() };
    let (modes, rows) = (plan.modes.len(), kernels.constraint_pattern.rows);
    let solve = solve(lowered, solution, n, plan.margins);
    let resolve = resolve(lowered, solution, plan.factors, n);
    let (solve_items, resolve_items) = (solve.items, resolve.items);
    let items = quote! {
        type __Modes<__T> = [__T; #modes];
        type __Rows<__T> = [__T; #rows];
        #solve_items
        #resolve_items
    };
    let (start, end) = (plan.regular.start, plan.regular.end);
    let places = quote! { const REGULAR: (usize, usize) = (#start, #end); };
    let methods = [places, solve.methods, resolve.methods];
    Planned { items, methods: quote! { #(#methods)* } }
}

fn solve(lowered: &Lowered, solution: &SolutionKernels, n: usize, margins: usize) -> Planned {
    let (mut items, mut statements) = (TokenStream::new(), TokenStream::new());
    let mut before = Depth::Position;
    for part in &solution.parts {
        if part.depth != before {
            let last = variant("Depth", before.variant());
            statements.extend(quote! { if let #last = depth { return __kin::Ok(()); } });
            before = part.depth;
        }
        let printed = kernel(lowered, &part.kernel);
        let call = printed.call;
        items.extend(printed.item);
        statements.extend(match &part.iteration {
            None => call,
            Some(Iteration { unknowns, kinds, converged }) => {
                let count = unknowns.len();
                let kinds = kinds.iter().map(|kind| variant("UnknownKind", kind.variant()));
                quote! {
                    let value = __kin::iterate(unknowns, [#(#unknowns),*], [#(#kinds),*], |unknowns| {
                        let mut correction = [<__T as __kin::Scalar>::from_f64(0.0); #count];
                        let out = &mut correction;
                        #call
                        correction
                    });
                    saved[#converged] = value;
                }
            }
        });
    }
    statements.extend(quote! { __kin::Ok(()) });
    let is_inlined = solution.parts.iter().all(|part| part.kernel.inlined);
    let solved = if is_inlined {
        quote! { <__T as __kin::Scalar>::dispatch(#[inline(always)] || { #statements }) }
    } else {
        statements
    };
    let (saved, lengths) = (solution.saved, position_lengths(&Ident::new("__T", Span::call_site()), "start"));
    let arguments = quote! {
        modes: &[__T], start: &[__T], depth: __kin::Depth, solved: __kin::Solved<'_, __T>,
    };
    let statements = quote! {
        #lengths
        let modes: &__Modes<__T> = __kin::fixed("modes", modes)?;
        let position: &mut [__T; #n] = __kin::fixed_mut("q", solved.q)?;
        let velocity: &mut [__T; #n] = __kin::fixed_mut("q_dot", solved.q_dot)?;
        let acceleration: &mut [__T; #n] = __kin::fixed_mut("q_ddot", solved.q_ddot)?;
        let margins: &mut [__T; #margins] = __kin::fixed_mut("margins", solved.margins)?;
        let saved: &mut [__T; #saved] = &mut [<__T as __kin::Scalar>::from_f64(0.0); #saved];
        let unknowns: &mut __Coordinates<__T> = &mut { *start };
        let _ = (p, u, modes, &position, &velocity, &acceleration, &margins, &saved, &unknowns);
        #solved
    };
    let methods = method(&quote! { #[inline] }, "solve_with", &arguments, &statements);
    Planned { items, methods }
}

/// The methods that factorise Φ_q and that solve for one right-hand side after another.
fn resolve(lowered: &Lowered, solution: &SolutionKernels, factors: usize, n: usize) -> Planned {
    let lengths = position_lengths(&Ident::new("__T", Span::call_site()), "q");
    let [factorise, solve] = [&solution.factorise, &solution.solve].map(|program| kernel(lowered, program));
    let items = [factorise.item, solve.item];
    let (factorise, solve) = (factorise.call, solve.call);
    let factorise = method(
        &quote! { #[inline] },
        "factorise_with",
        &quote! { q: &[__T], factors: &mut Self::Factors<__T>, },
        &quote! {
            #lengths
            let saved: &mut [__T; #factors] = factors;
            let _ = (p, u, q, &saved);
            #factorise
            __kin::Ok(())
        },
    );
    let methods = quote! {
        #factorise

        #[inline]
        fn solve_factorised<__T: __kin::Scalar>(
            factors: &Self::Factors<__T>,
            b: &[__T],
            x: &mut [__T],
        ) -> __kin::Result<(), __kin::LengthError> {
            let saved: &[__T; #factors] = factors;
            let right: &__Rows<__T> = __kin::fixed("b", b)?;
            let out: &mut [__T; #n] = __kin::fixed_mut("x", x)?;
            let _ = (saved, right, &out);
            #solve
            __kin::Ok(())
        }
    };
    Planned { items: quote! { #(#items)* }, methods }
}
