//! Mentions of the user's names.

use syn::Ident;

/// A name as the user wrote it. Printed with its own span in the expansion, it lets editors find definitions and
/// rename.
#[derive(Clone, Debug)]
pub(crate) struct Mention {
    pub(crate) kind: MentionKind,
    pub(crate) ident: Ident,
}

/// The kind of a mentioned name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MentionKind {
    Parameter,
    Body,
    Scalar,
    Point,
    Define,
    Input,
    Function,
}

/// True for the identifier that an editor inserts at the cursor to request completions.
pub(super) fn is_completion_marker(ident: &Ident) -> bool {
    let name = ident.to_string();
    name.contains("raCompletionMarker") || name.contains("intellijRulezz")
}
