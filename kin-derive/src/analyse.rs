//! From tokens to a checked model: first the description is parsed and its names are resolved, then the rules of
//! [`kin_core::check`] are applied. The errors of both are reported together. [`derive_equations`] then checks the
//! structure of the equations of the model.

use crate::lower::{Lowered, Outcome, lower};
use crate::parse::parse;
use crate::report::Report;
use kin_core::check::{check, check_parts, is_resolved};
use kin_core::{KinematicSystem, ModelError, Structure};
use proc_macro2::{Span, TokenStream};
use syn::ItemStruct;

/// A description with errors: all of them, and the parts that could be read.
pub(crate) struct Broken {
    /// All errors.
    pub(crate) error: syn::Error,
    /// The names and other parts that could be read; parts with errors are missing.
    pub(crate) lowered: Option<Box<Lowered>>,
}

/// Reads `#[mechanism(args)] item`. Returns the struct without the attributes of kin, even if there are errors, and the
/// description.
pub(crate) fn analyse(args: TokenStream, item: TokenStream) -> (Option<ItemStruct>, Result<Lowered, Broken>) {
    let report = Report::new();
    let (item, description) = parse(args, item, &report);
    let lowered = match (&item, description) {
        (Some(item), Some(description)) => {
            let Outcome { lowered, completing } = lower(description, item.clone(), &report);
            if completing {
                report.discard();
                return (Some(item.clone()), Ok(lowered));
            }
            check_model(&lowered, &report);
            Some(lowered)
        }
        _ => None,
    };
    let result = match (report.finish(), lowered) {
        (Err(error), lowered) => Err(Broken { error, lowered: lowered.map(Box::new) }),
        (Ok(()), Some(lowered)) => Ok(lowered),
        (Ok(()), None) => {
            let error = syn::Error::new(Span::call_site(), "a mechanism is a struct; its fields are the parameters");
            Err(Broken { error, lowered: None })
        }
    };
    (item, result)
}

/// Applies the rules. Parts with errors are missing in the model; then only the rules that examine a single part apply.
fn check_model(lowered: &Lowered, report: &Report) {
    let mechanism = &lowered.mechanism;
    let is_complete = report.count() == 0;
    let mut errors = if is_complete { check(mechanism) } else { check_parts(mechanism) };
    // Errors that only `check` finds, such as a body without joints, do not concern the rows.
    let rows_are_correct = errors.is_empty() || (is_complete && check_parts(mechanism).is_empty());
    let has_units = kin_core::units::are_written(mechanism) && is_resolved(mechanism);
    let units = if has_units { kin_core::units::check(mechanism) } else { Vec::new() };
    if rows_are_correct {
        if !is_complete || !units.is_empty() {
            // A statement that is degenerate, such as a length that is computed as 0, is so whatever is missing, and
            // whatever its units are.
            errors.extend(kin_core::assemble(mechanism).err().unwrap_or_default());
        } else if !errors.is_empty() {
            // Without errors, `derive_equations` checks the structure. A row whose units do not agree is probably wrong,
            // and errors about its structure would mislead.
            errors.extend(checked_equations(lowered).err().unwrap_or_default());
        }
    }
    for error in errors.into_iter().chain(units) {
        report.error(lowered.span(error.origin), error.message);
    }
}

/// Differentiates the equations and checks their structure. An equation that cannot be assembled is an error.
pub(crate) fn derive_equations(lowered: &Lowered) -> syn::Result<(KinematicSystem, Structure)> {
    checked_equations(lowered).map_err(|errors| {
        let spanned = errors.into_iter().map(|error| syn::Error::new(lowered.span(error.origin), error));
        let joined = spanned.reduce(|mut all, error| {
            all.combine(error);
            all
        });
        joined.unwrap_or_else(|| syn::Error::new(Span::call_site(), "the mechanism cannot be assembled"))
    })
}

/// The equations and their structure, or the errors of either; redundant rows are errors unless they are allowed.
fn checked_equations(lowered: &Lowered) -> Result<(KinematicSystem, Structure), Vec<ModelError>> {
    let system = kin_core::assemble(&lowered.mechanism).and_then(kin_core::differentiate)?;
    let structure = kin_core::diagnose(&system);
    let redundant = match lowered.flags.allow_redundant {
        true => Vec::new(),
        false => kin_core::structure::explain(&lowered.mechanism, &system, &structure),
    };
    if redundant.is_empty() { Ok((system, structure)) } else { Err(redundant) }
}

#[cfg(test)]
mod tests;
