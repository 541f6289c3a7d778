//! The curves of joints, for a drawing.

use super::kernel::{Kernel, kernel};
use crate::lower::Lowered;
use kin_core::program::{Slot, lower};
use kin_core::system::KinematicSystem;
use proc_macro2::TokenStream;
use quote::quote;

/// The curves of joints, one kernel for each; nothing for a mechanism without.
pub(super) fn curves(lowered: &Lowered, system: &KinematicSystem) -> TokenStream {
    let set = &system.set;
    if set.curves.is_empty() {
        return TokenStream::new();
    }
    let arms = set.curves.iter().map(|curve| {
        let outputs: Vec<_> = curve.point.iter().enumerate().map(|(place, e)| (Slot::Entry(place), *e)).collect();
        let program = lower(&set.graph, &outputs);
        let Kernel { item, call } = kernel("write", lowered, &program, &[("out", quote! { [__T; 4] })]);
        let joint = curve.joint;
        quote! { #joint => { #item #call } }
    });
    quote! {
        fn curve_with<__T: __kin::Scalar>(
            &self,
            parameters: &[__T],
            at: &__kin::Instant<'_, __T>,
            joint: usize,
            s: __T,
        ) -> __kin::Result<__kin::Option<__kin::CurvePoint<__T>>, __kin::LengthError> {
            let p: &__Parameters<__T> = __kin::fixed("parameters", parameters)?;
            let u: &__Inputs<__T> = __kin::fixed("inputs", at.inputs)?;
            let out: &mut [__T; 4] = &mut [<__T as __kin::Scalar>::from_f64(0.0); 4];
            let _ = (p, u, s);
            match joint {
                #(#arms)*
                _ => return __kin::Ok(__kin::None),
            }
            __kin::Ok(__kin::Some(__kin::CurvePoint { r: [out[0], out[1]], tangent: [out[2], out[3]] }))
        }
    }
}
