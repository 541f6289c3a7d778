//! Users' names as they are written.

use syn::Ident;

/// A user's name, as written: emitted with its own span it keeps go-to-definition, hover and rename alive.
#[derive(Clone, Debug)]
pub(crate) struct Mention {
    pub(crate) kind: MentionKind,
    pub(crate) ident: Ident,
}

/// What a mentioned name is.
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

/// True for the identifier that an editor puts where it wants to know what could stand.
pub(super) fn is_completion_marker(ident: &Ident) -> bool {
    let name = ident.to_string();
    name.contains("raCompletionMarker") || name.contains("intellijRulezz")
}
