//! Evaluations of rows: kernels as items beside the trait, and the statements that call them.

use super::kernel::{Kernel, Layout, kernel};
use crate::lower::Lowered;
use kin_core::expr::ExprId;
use kin_core::program::{Program, Slot, lower};
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// The four arrays of an evaluation with their types.
fn targets(rows: usize, entries: usize) -> [(&'static str, TokenStream); 4] {
    [
        ("phi", quote! { [__T; #rows] }),
        ("phi_q", quote! { [__T; #entries] }),
        ("phi_t", quote! { [__T; #rows] }),
        ("gamma", quote! { [__T; #rows] }),
    ]
}

pub(super) fn lengths(scalar: &Ident) -> TokenStream {
    let position = position_lengths(scalar, "q");
    quote! {
        #position
        let w: &__Coordinates<#scalar> = __kin::fixed("q_dot", q_dot)?;
    }
}

pub(super) fn position_lengths(scalar: &Ident, q: &str) -> TokenStream {
    let name = Ident::new(q, Span::call_site());
    quote! {
        let p: &__Parameters<#scalar> = __kin::fixed("parameters", parameters)?;
        let u: &__Inputs<#scalar> = __kin::fixed("inputs", at.inputs)?;
        let #name: &__Coordinates<#scalar> = __kin::fixed(#q, #name)?;
    }
}

/// Kernels as items beside the trait, and the statements that call them.
pub(super) struct Evaluations {
    pub(super) evaluate: Kernel,
    pub(super) observe: Kernel,
    /// Parameters, rows, non-zeros, observables, and non-zeros of these.
    pub(super) counts: [usize; 5],
}

/// Φ alone, in a function of its own: what is only evaluated for Φ (dual numbers) compiles nothing else.
pub(super) fn values(lowered: &Lowered, system: &KinematicSystem, layout: &Layout) -> Kernel {
    let program = layout.program(|slot| matches!(slot, Slot::Phi(_)));
    let targets = targets(system.set.rows.len(), layout.rows.entries.len());
    kernel("values", lowered, &program, &targets)
}

/// η of the rows of velocity level, where there are any.
pub(super) fn velocity_constraints(lowered: &Lowered, system: &KinematicSystem, lengths: &TokenStream) -> TokenStream {
    let set = &system.set;
    if set.rows.iter().all(|row| row.velocity.is_none()) {
        return TokenStream::new();
    }
    let s = set.rows.len();
    let etas = set.rows.iter().enumerate().filter_map(|(row, info)| Some((row, info.velocity?.eta)));
    let outputs: Vec<_> = etas.map(|(row, eta)| (Slot::Entry(row), eta)).collect();
    let program = lower(&set.graph, &outputs);
    let kernel = kernel("rates", lowered, &program, &[("out", quote! { [__T; #s] })]);
    let (item, call) = (kernel.item, kernel.call);
    quote! {
        fn velocity_constraints_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            q: &[__T],
            q_dot: &[__T],
            eta: &mut [__T; #s],
        ) -> __kin::Result<(), __kin::LengthError> {
            #item
            #lengths
            let out = eta;
            *out = [__kin::Scalar::from_f64(0.0); #s];
            let _ = (p, u, q, w, &out);
            #call
            __kin::Ok(())
        }
    }
}

pub(super) fn evaluate(
    lowered: &Lowered,
    system: &KinematicSystem,
    layout: &Layout,
    all: &Program,
    values: &Kernel,
) -> Kernel {
    let targets = targets(system.set.rows.len(), layout.rows.entries.len());
    let named = |name: &str, program: &Program| kernel(name, lowered, program, &targets);
    let position = layout.program(|slot| matches!(slot, Slot::Phi(_) | Slot::PhiQ(_)));
    let position = named("values_and_jacobian", &position);
    let velocity = layout.program(|slot| matches!(slot, Slot::PhiQ(_) | Slot::PhiT(_)));
    let velocity = named("jacobian_and_rates", &velocity);
    let all = named("everything", all);
    let items = [&position, &velocity, &all].map(|kernel| &kernel.item);
    let [values, position, velocity, all] = [values, &position, &velocity, &all].map(|kernel| &kernel.call);
    Kernel {
        item: quote! { #(#items)* },
        call: quote! {
            let (phi, phi_q, phi_t, gamma) = workspace.parts_mut();
            let _ = (p, u, q, w, &phi, &phi_q, &phi_t, &gamma);
            if subset.gamma || subset.phi && subset.phi_t {
                #all
            } else if subset.phi_t {
                #velocity
            } else if subset.phi_q {
                #position
            } else if subset.phi {
                #values
            }
        },
    }
}

pub(super) fn observe(lowered: &Lowered, system: &KinematicSystem, layout: &Layout) -> Kernel {
    let targets = targets(system.set.observables.len(), layout.rows.entries.len());
    let program = layout.program(|_| true);
    let Kernel { item, call } = kernel("observe", lowered, &program, &targets);
    Kernel {
        item,
        call: quote! {
            let (phi, phi_q, phi_t, gamma) = observations.parts_mut();
            let _ = (p, u, q, w, &phi, &phi_q, &phi_t, &gamma);
            #call
        },
    }
}

/// A kernel that writes a plain list of expressions.
pub(crate) fn list(lowered: &Lowered, system: &KinematicSystem, values: impl Iterator<Item = ExprId>) -> TokenStream {
    let outputs: Vec<_> = values.enumerate().map(|(place, value)| (Slot::Entry(place), value)).collect();
    let count = outputs.len();
    let program = lower(&system.set.graph, &outputs);
    let kernel = kernel("write", lowered, &program, &[("out", quote! { [__T; #count] })]);
    let (item, call) = (kernel.item, kernel.call);
    quote! {
        #item
        let out: &mut [__T; #count] = out;
        let _ = &out;
        #call
    }
}
