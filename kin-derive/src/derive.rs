//! The attribute on token streams of any origin, so that tests and fuzzers can call it.

use crate::analyse::{Broken, analyse, system};
use crate::{documentation, expand, fallback};
use kin_core::kernels;
use kin_core::plan::{plan_of_rank, plan_with_formulas};
use proc_macro2::TokenStream;

/// The items of `#[mechanism(args)] item`.
pub(crate) fn derive(args: TokenStream, item: TokenStream) -> TokenStream {
    let (cleaned, lowered) = analyse(args.clone(), item.clone());
    let derived = lowered.and_then(|lowered| match system(&lowered) {
        Ok((system, structure)) => {
            let planned = if expand::WRITTEN { plan_with_formulas } else { plan_of_rank };
            let plan = planned(&system, structure.rank);
            let kernels = kernels(&system, &plan);
            let documentation = documentation::attribute(&args, &item);
            Ok(expand::expand(&lowered, &system, &structure, &plan, &kernels, &documentation))
        }
        Err(error) => Err(Broken { error, lowered: Some(Box::new(lowered)) }),
    });
    derived.unwrap_or_else(|broken| fallback::fallback(cleaned.as_ref(), item, &broken))
}
