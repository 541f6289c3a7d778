//! The attribute macro as a function of token streams, so that tests and fuzzers can call it.

use crate::analyse::{Broken, analyse, derive_equations};
use crate::{documentation, expand, fallback};
use kin_core::kernels;
use kin_core::loads::forces;
use kin_core::plan::plan_and_linear;
use proc_macro2::TokenStream;

/// The items that replace `#[mechanism(args)] item`.
pub(crate) fn derive(args: TokenStream, item: TokenStream) -> TokenStream {
    let (cleaned, lowered) = analyse(args.clone(), item.clone());
    let derived = lowered.and_then(|lowered| match derive_equations(&lowered) {
        Ok((system, structure)) => {
            let (plan, linear) = plan_and_linear(&system, structure.rank, expand::DERIVATION_AS_TEXT);
            let forces = forces(&lowered.mechanism, &system, linear);
            let kernels = kernels(&system, &plan, forces.as_ref());
            let documentation = documentation::attribute(&args, &item);
            Ok(expand::expand(&lowered, &system, &structure, &plan, forces.as_ref(), &kernels, &documentation))
        }
        Err(error) => Err(Broken { error, lowered: Some(Box::new(lowered)) }),
    });
    derived.unwrap_or_else(|broken| fallback::fallback(cleaned.as_ref(), item, &broken))
}
