//! The attribute on token streams of any origin, so that tests and fuzzers can call it.

use crate::analyse::{Broken, analyse};
use crate::lower::Lowered;
use crate::{documentation, expand, fallback};
use kin_core::plan::{plan_of_rank, plan_with_formulas};
use proc_macro2::{Span, TokenStream};

/// The items of `#[mechanism(args)] item`.
pub(crate) fn derive(args: TokenStream, item: TokenStream) -> TokenStream {
    let (cleaned, lowered) = analyse(args.clone(), item.clone());
    let derived = lowered.and_then(|lowered| match system(&lowered) {
        Ok((system, structure)) => {
            let planned = if expand::WRITTEN { plan_with_formulas } else { plan_of_rank };
            let plan = planned(&system, structure.rank);
            let documentation = documentation::attribute(&args, &item);
            Ok(expand::expand(&lowered, &system, &structure, &plan, &documentation))
        }
        Err(error) => Err(Broken { error, lowered: Some(Box::new(lowered)) }),
    });
    derived.unwrap_or_else(|broken| fallback::fallback(cleaned.as_ref(), item, &broken))
}

/// The differentiated equations and what their structure says; errors where the rules of the model were not enough.
pub(crate) fn system(lowered: &Lowered) -> syn::Result<(kin_core::KinematicSystem, kin_core::Structure)> {
    let spanned = |errors: Vec<kin_core::ModelError>| {
        let spanned = errors.into_iter().map(|error| syn::Error::new(lowered.span(error.origin), error));
        spanned.reduce(|mut all, error| {
            all.combine(error);
            all
        })
    };
    let system = kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate).map_err(|errors| {
        spanned(errors).unwrap_or_else(|| syn::Error::new(Span::call_site(), "the mechanism cannot be assembled"))
    })?;
    let structure = kin_core::diagnose(&system);
    if !lowered.flags.allow_redundant {
        let errors = kin_core::structure::explain(&lowered.mechanism, &system, &structure);
        spanned(errors).map_or(Ok(()), Err)?;
    }
    Ok((system, structure))
}
