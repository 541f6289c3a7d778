//! Handles: associated constants for bodies, points, coordinates, defines and inputs. They have the spans of the user's
//! names, so that go-to-definition, hover and rename work at every mention.

use crate::lower::{Lowered, MentionKind};
use kin_core::Origin;
use kin_core::check::MAX_MEMBERS;
use kin_core::mechanism::Range;
use kin_core::system::KinematicSystem;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// An `impl` with one constant for every name.
pub(crate) fn handles(lowered: &Lowered, system: &KinematicSystem) -> TokenStream {
    let mechanism = &lowered.mechanism;
    let set = &system.set;
    let mut constants = TokenStream::new();
    for (family, body) in mechanism.bodies.iter().enumerate() {
        let indices = indices(set.bodies.iter().map(|b| b.family.0), family);
        constants.extend(constant(lowered, &body.name, body.origin, counted(body.len), "Body", &indices));
    }
    let mut index = set.coordinates.len() - mechanism.scalars.iter().map(|s| s.len.unwrap_or(1)).sum::<usize>();
    for scalar in &mechanism.scalars {
        let indices: Vec<usize> = (index..index + scalar.len.unwrap_or(1)).collect();
        index += indices.len();
        constants.extend(constant(lowered, &scalar.name, scalar.origin, counted(scalar.len), "Coordinate", &indices));
    }
    for (family, point) in mechanism.points.iter().enumerate() {
        let indices = indices(set.points.iter().map(|p| p.family.0), family);
        constants.extend(constant(lowered, &point.name, point.origin, point.range, "Point", &indices));
    }
    for (family, define) in mechanism.defines.iter().enumerate() {
        let indices = indices(set.defines.iter().map(|d| d.family.0), family);
        constants.extend(constant(lowered, &define.name, define.origin, define.range, "Quantity", &indices));
    }
    let mut index = 0;
    for input in &mechanism.inputs {
        let indices: Vec<usize> = (index..index + input.len.unwrap_or(1)).collect();
        index += indices.len();
        constants.extend(constant(lowered, &input.name, input.origin, counted(input.len), "Input", &indices));
    }
    let name = &lowered.item.ident;
    let (impl_generics, type_generics, where_clause) = lowered.item.generics.split_for_impl();
    quote! {
        // Handles have the names that the user has given, whatever their case.
        #[allow(non_upper_case_globals)]
        impl #impl_generics #name #type_generics #where_clause {
            #constants
        }
    }
}

/// The constants for a description with errors: all names, with meaningless indices.
pub(crate) fn placeholders(lowered: &Lowered) -> TokenStream {
    let mechanism = &lowered.mechanism;
    let range = |range: Option<Range>| range.map(|range| range.indices().count());
    let bodies = mechanism.bodies.iter().map(|b| (&b.name, b.origin, b.len, "Body"));
    let scalars = mechanism.scalars.iter().map(|s| (&s.name, s.origin, s.len, "Coordinate"));
    let inputs = mechanism.inputs.iter().map(|i| (&i.name, i.origin, i.len, "Input"));
    let points = mechanism.points.iter().map(|p| (&p.name, p.origin, range(p.range), "Point"));
    let defines = mechanism.defines.iter().map(|d| (&d.name, d.origin, range(d.range), "Quantity"));
    // If two things have the same name, the constant belongs to the first.
    let mut seen = std::collections::BTreeSet::new();
    (bodies.chain(scalars).chain(inputs).chain(points).chain(defines))
        .filter(|(name, ..)| seen.insert(name.as_str()))
        .map(|(name, origin, len, ty)| {
            let span = lowered.span(origin);
            let (handle, ty) = (handle_name(name, span, lowered), Ident::new(ty, Span::call_site()));
            // A family of unknown length gets the largest allowed length.
            let len = if lowered.boundless.contains(name) { Some(MAX_MEMBERS) } else { len };
            let (ty, value) = match len {
                None => (quote! { __kin::#ty }, quote! { __kin::#ty(0) }),
                Some(len) => (quote! { [__kin::#ty; #len] }, quote! { [__kin::#ty(0); #len] }),
            };
            let visibility = &lowered.item.vis;
            quote! { #visibility const #handle: #ty = #value; }
        })
        .collect()
}

/// The indices of a family's members.
fn indices(families: impl Iterator<Item = usize>, family: usize) -> Vec<usize> {
    families.enumerate().filter(|(_, f)| *f == family).map(|(index, _)| index).collect()
}

/// The range of a family with a length.
fn counted(len: Option<usize>) -> Option<Range> {
    len.map(|len| Range { start: 0, end: i64::try_from(len).unwrap_or(i64::MAX) })
}

fn constant(
    lowered: &Lowered,
    name: &str,
    origin: Origin,
    range: Option<Range>,
    ty: &str,
    indices: &[usize],
) -> TokenStream {
    let visibility = &lowered.item.vis;
    let span = lowered.span(origin);
    let handle = handle_name(name, span, lowered);
    let written = lowered.docs.names.iter().find(|(documented, _)| documented == name).map(|(_, doc)| doc.clone());
    let mut doc = written.unwrap_or_else(|| format!(" The {} `{name}`.", ty.to_lowercase()));
    if let Some(Range { start, end }) = range.filter(|range| range.start > 0) {
        let last = end - 1;
        doc.push_str(&format!(
            "\n\n The elements of this array are counted from 0: the first is `{name}[{start}]` of the description, the \
             last `{name}[{last}]`."
        ));
    }
    let ty = Ident::new(ty, Span::call_site());
    let (ty, value) = match range.map(|_| indices.len()) {
        None => (quote! { __kin::#ty }, quote! { #(__kin::#ty(#indices))* }),
        Some(len) => (quote! { [__kin::#ty; #len] }, quote! { [#(__kin::#ty(#indices)),*] }),
    };
    quote! {
        #[doc = #doc]
        #visibility const #handle: #ty = #value;
    }
}

/// The name of the constant: the user's name, as a raw identifier if it is a keyword. A handle named `default` would
/// hide `Default::default` in `Name::default()`, so underscores are appended until the name is unique.
fn handle_name(name: &str, span: Span, lowered: &Lowered) -> Ident {
    if name == "default" {
        let mut free = "default_".to_owned();
        while lowered.mentions.iter().any(|mention| mention.ident == free.as_str()) {
            free.push('_');
        }
        return Ident::new(&free, span);
    }
    // `gen` is a keyword since edition 2024. These four are no raw identifiers, which the compiler says itself.
    match syn::parse_str::<Ident>(name) {
        _ if matches!(name, "self" | "Self" | "super" | "crate") => Ident::new(&format!("{name}_"), span),
        Ok(_) if name != "gen" => Ident::new(name, span),
        _ => Ident::new_raw(name, span),
    }
}

/// Statements that mention every name with the span of the user's mention, in blocks that are small enough for rustc.
pub(crate) fn mentions(lowered: &Lowered) -> TokenStream {
    let mentions: Vec<TokenStream> = (lowered.mentions.iter())
        .filter(|mention| mention.ident != "default")
        .map(|mention| {
            let ident = &mention.ident;
            match mention.kind {
                MentionKind::Parameter | MentionKind::Function => quote! { let _ = &self.#ident; },
                _ => quote! { let _ = Self::#ident; },
            }
        })
        .collect();
    mentions.chunks(100).map(|chunk| quote! { { #(#chunk)* } }).collect()
}
