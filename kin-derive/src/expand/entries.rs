//! Building blocks for entries of the static model.

use kin_core::constraint::Frame;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// The variant `name` of the enum `path`.
pub(super) fn variant(path: &str, name: &str) -> TokenStream {
    let (path, name) = (Ident::new(path, Span::call_site()), Ident::new(name, Span::call_site()));
    quote! { __kin::#path::#name }
}

/// A frame.
pub(super) fn frame(frame: Frame) -> TokenStream {
    match frame {
        Frame::Ground => quote! { __kin::Frame::Ground },
        Frame::Body(body) => quote! { __kin::Frame::Body(#body) },
    }
}

/// `Some` or `None`.
pub(super) fn optional(value: Option<impl quote::ToTokens>) -> TokenStream {
    match value {
        Some(value) => quote! { __kin::Some(#value) },
        None => quote! { __kin::None },
    }
}
