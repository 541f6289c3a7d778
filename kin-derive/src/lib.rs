//! The `#[mechanism]` attribute.
use proc_macro::TokenStream;

/// Derives.
#[proc_macro_attribute]
pub fn mechanism(_args: TokenStream, item: TokenStream) -> TokenStream {
    item
}
