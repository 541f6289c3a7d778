//! The solution plan: its sections as kernels, and the methods that run them.

use super::evaluations::position_lengths;
use super::kernel::{Kernel, kernel, kernel_after};
use crate::lower::Lowered;
use kin_core::plan::{Depth, Section, SolutionPlan};
use kin_core::program::Program;
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// What a plan adds to a mechanism.
pub(super) struct Planned {
    /// Types and kernels, beside the trait.
    pub(super) items: TokenStream,
    /// Methods of the trait.
    pub(super) methods: TokenStream,
}

/// The code of a plan.
pub(super) fn planned(lowered: &Lowered, system: &KinematicSystem, plan: &SolutionPlan) -> Planned {
    if plan.absent.is_some() {
        return Planned { items: TokenStream::new(), methods: TokenStream::new() };
    }
    let (modes, held, rows) = (plan.modes.len(), plan.held as usize, system.set.rows.len());
    let solve = solve(lowered, system, plan);
    let at_q = |name: &str, program: &Program, outputs: usize| {
        kernel(name, lowered, program, &[("out", quote! { [__T; #outputs] })])
    };
    let closures = modes + plan.orientations.len();
    let tell = at_q("tell_modes", &plan.closures, closures);
    let factors = plan.factors;
    let factorise = kernel("factorise_rows", lowered, &plan.resolve[0], &[("held", quote! { __Factors<__T> })]);
    let n = system.set.coordinates.len();
    let resolve = kernel_after(
        "solve_rows",
        lowered,
        &plan.resolve[1],
        &[("out", quote! { [__T; #n] })],
        "__Factors",
        &quote! { #[inline] },
    );
    let kernels = solve.kernels.iter().chain([&tell.item, &factorise.item, &resolve.item]);
    let items = quote! {
        type __Modes<__T> = [__T; #modes];
        type __Closures<__T> = [__T; #closures];
        type __Held<__T> = [__T; #held];
        type __Rows<__T> = [__T; #rows];
        type __Factors<__T> = [__T; #factors];
        #(#kernels)*
    };
    let (start, end) = (plan.regular.start, plan.regular.end);
    let places = quote! { const REGULAR: (usize, usize) = (#start, #end); };
    let methods = [places, solve.method, closures_methods(&tell, plan), resolve_methods(&factorise, &resolve)];
    Planned { items, methods: quote! { #(#methods)* } }
}

/// Instructions of a plan whose parts become one function; a dyad has about two hundred.
const SHORT: usize = 1000;

/// Kernels, and the method that calls them.
struct Solve {
    kernels: Vec<TokenStream>,
    method: TokenStream,
}

fn solve(lowered: &Lowered, system: &KinematicSystem, plan: &SolutionPlan) -> Solve {
    let (n, margins, held) = (system.set.coordinates.len(), plan.margins, plan.held as usize);
    let coordinates = quote! { __Coordinates<__T> };
    let targets = [
        ("position", coordinates.clone()),
        ("velocity", coordinates.clone()),
        ("acceleration", coordinates),
        ("margins", quote! { [__T; #margins] }),
        ("held", quote! { __Held<__T> }),
    ];
    // The parts of a short plan are one function, in which what one part holds for another stays in registers.
    let instructions: usize = plan.sections.iter().map(|(section, _)| section.program().instructions.len()).sum();
    let inline = if instructions <= SHORT {
        quote! { #[inline(always)] }
    } else {
        quote! { #[inline] }
    };
    let (mut kernels, mut statements) = (Vec::new(), Vec::new());
    let mut before = Depth::Position;
    for (number, (section, depth)) in plan.sections.iter().enumerate() {
        if *depth != before {
            let last = depth_tokens(before);
            statements.push(quote! { if let #last = depth { return __kin::Ok(()); } });
            before = *depth;
        }
        let name = format!("solve_part_{number}");
        match section {
            Section::Closed(program) => {
                let kernel = kernel_after(&name, lowered, program, &targets, "__Held", &inline);
                kernels.push(kernel.item);
                statements.push(kernel.call);
            }
            Section::Newton { unknowns, correction, converged } => {
                let (places, count, converged) =
                    (unknowns.iter().map(|k| *k as usize), unknowns.len(), *converged as usize);
                let out = [("out", quote! { [__T; #count] })];
                let kernel = kernel_after(&name, lowered, correction, &out, "__Held", &inline);
                let call = kernel.call;
                let lengths = unknowns.iter().map(|&k| system.set.coordinates[k as usize].kind.is_length());
                kernels.push(kernel.item);
                statements.push(quote! {
                    let value = __kin::iterate(unknowns, [#(#places),*], [#(#lengths),*], |unknowns| {
                        let mut correction = [<__T as __kin::Scalar>::from_f64(0.0); #count];
                        let out = &mut correction;
                        #call
                        correction
                    });
                    held[#converged] = value;
                });
            }
        }
    }
    let lengths = position_lengths(&Ident::new("__T", Span::call_site()), "start");
    let method = quote! {
        #[inline]
        fn solve_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            modes: &[__T],
            start: &[__T],
            depth: __kin::Depth,
            solved: __kin::Solved<'_, __T>,
        ) -> __kin::Result<(), __kin::LengthError> {
            #lengths
            let modes: &__Modes<__T> = __kin::fixed("modes", modes)?;
            let position: &mut [__T; #n] = __kin::fixed_mut("q", solved.q)?;
            let velocity: &mut [__T; #n] = __kin::fixed_mut("q_dot", solved.q_dot)?;
            let acceleration: &mut [__T; #n] = __kin::fixed_mut("q_ddot", solved.q_ddot)?;
            let margins: &mut [__T; #margins] = __kin::fixed_mut("margins", solved.margins)?;
            let held: &mut __Held<__T> = &mut [<__T as __kin::Scalar>::from_f64(0.0); #held];
            let unknowns: &mut __Coordinates<__T> = &mut { *start };
            let _ = (p, u, modes, &position, &velocity, &acceleration, &margins, &held, &unknowns);
            #(#statements)*
            __kin::Ok(())
        }
    };
    Solve { kernels, method }
}

fn depth_tokens(depth: Depth) -> TokenStream {
    match depth {
        Depth::Position => quote! { __kin::Depth::Position },
        Depth::Velocity => quote! { __kin::Depth::Velocity },
        Depth::Acceleration => quote! { __kin::Depth::Acceleration },
    }
}

/// What tells modes apart, and what tells all branches apart where there are iterations, too.
fn closures_methods(kernel: &Kernel, plan: &SolutionPlan) -> TokenStream {
    let lengths = position_lengths(&Ident::new("__T", Span::call_site()), "q");
    let call = &kernel.call;
    let method = |name: &str, list: &str| {
        let [name, list_name] = [name, list].map(|name| Ident::new(name, Span::call_site()));
        quote! {
            #[inline]
            fn #name<__T: __kin::Scalar>(
                &self,
                parameters: &[__T],
                at: &__kin::Instant<'_, __T>,
                q: &[__T],
                #list_name: &mut [__T],
            ) -> __kin::Result<(), __kin::LengthError> {
                #lengths
                let out: &mut __Closures<__T> = __kin::fixed_mut(#list, #list_name)?;
                let _ = (p, u, q, &out);
                #call
                __kin::Ok(())
            }
        }
    };
    if plan.orientations.is_empty() {
        return method("closures_with", "closures");
    }
    let branches = method("branches_with", "branches");
    let (modes, all) = (plan.modes.len(), plan.modes.len() + plan.orientations.len());
    quote! {
        #branches

        #[inline]
        fn closures_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            q: &[__T],
            closures: &mut [__T],
        ) -> __kin::Result<(), __kin::LengthError> {
            let out: &mut __Modes<__T> = __kin::fixed_mut("closures", closures)?;
            let mut branches = [<__T as __kin::Scalar>::from_f64(0.0); #all];
            <Self as __kin::Mechanism>::branches_with(self, parameters, at, q, &mut branches)?;
            out.copy_from_slice(&branches[..#modes]);
            __kin::Ok(())
        }
    }
}

/// The factors of Φ_q, and x for one right side after another.
fn resolve_methods(factorise: &Kernel, solve: &Kernel) -> TokenStream {
    let lengths = position_lengths(&Ident::new("__T", Span::call_site()), "q");
    let (factorise, solve) = (&factorise.call, &solve.call);
    quote! {
        #[inline]
        fn factorise_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            q: &[__T],
            factors: &mut Self::Factors<__T>,
        ) -> __kin::Result<(), __kin::LengthError> {
            #lengths
            let held: &mut __Factors<__T> = factors;
            let _ = (p, u, q, &held);
            #factorise
            __kin::Ok(())
        }

        #[inline]
        fn solve_factorised<__T: __kin::Scalar>(
            factors: &Self::Factors<__T>,
            b: &[__T],
            x: &mut [__T],
        ) -> __kin::Result<(), __kin::LengthError> {
            let held: &__Factors<__T> = factors;
            let right: &__Rows<__T> = __kin::fixed("b", b)?;
            let out: &mut __Coordinates<__T> = __kin::fixed_mut("x", x)?;
            let _ = (held, right, &out);
            #solve
            __kin::Ok(())
        }
    }
}
