//! The test that the flag `cross_check` requests.

use super::generics;
use crate::lower::Lowered;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

/// The test that `#[mechanism(cross_check)]` generates; a generic scalar is `f64` in it.
pub(super) fn cross_check(lowered: &Lowered) -> TokenStream {
    if !lowered.flags.cross_check {
        return TokenStream::new();
    }
    let name = &lowered.item.ident;
    let test = format_ident!("cross_check_of_{}", snake_case(&name.to_string()));
    let failure = "the closed forms and the dual numbers disagree";
    let arguments = generics::in_numbers(lowered);
    quote! {
        #[cfg(test)]
        #[test]
        #[allow(deprecated)]
        fn #test() {
            let __checked =
                ::kin_runtime::private::cross_check(&<#name #arguments as ::core::default::Default>::default());
            if let ::core::result::Result::Err(__difference) = __checked {
                ::core::panic!("{}: {}", #failure, __difference);
            }
        }
    }
}

fn snake_case(name: &str) -> String {
    let mut out = String::new();
    for (index, c) in name.trim_start_matches("r#").char_indices() {
        if c.is_uppercase() && index > 0 && !out.ends_with('_') {
            out.push('_');
        }
        out.extend(c.to_lowercase());
    }
    out
}
