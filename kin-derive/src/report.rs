//! The report: all errors of a description are collected, so that the compiler shows them together.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use std::cell::RefCell;
use std::fmt::Display;

/// Collects spanned errors. Dropping a report whose errors have not been read panics in debug builds.
#[derive(Debug, Default)]
pub(crate) struct Report {
    errors: RefCell<Vec<syn::Error>>,
}

impl Report {
    /// An empty report.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Adds `message` at the token at `span`.
    pub(crate) fn error(&self, span: Span, message: impl Display) {
        self.push(syn::Error::new(span, message));
    }

    /// Adds `message` at all tokens from `first` to `last`.
    pub(crate) fn error_between(&self, first: Span, last: Span, message: impl Display) {
        let ends = [first, last].map(|span| TokenTree::from(Ident::new("_", span)));
        self.push(syn::Error::new_spanned(TokenStream::from_iter(ends), message));
    }

    /// Adds an error that a parser returned.
    pub(crate) fn push(&self, error: syn::Error) {
        self.errors.borrow_mut().push(error);
    }

    /// The value of a result, or `None` after adding its error.
    pub(crate) fn ok<T>(&self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    /// The number of errors so far.
    pub(crate) fn count(&self) -> usize {
        self.errors.borrow().len()
    }

    /// All errors combined into one `syn::Error`.
    pub(crate) fn finish(self) -> syn::Result<()> {
        let combined = self.errors.take().into_iter().reduce(|mut all, error| {
            all.combine(error);
            all
        });
        combined.map_or(Ok(()), Err)
    }

    /// Drops all errors, because an expansion for an editor's completions does not show them.
    pub(crate) fn discard(self) {
        self.errors.take();
    }
}

impl Drop for Report {
    fn drop(&mut self) {
        let unread = !self.errors.get_mut().is_empty() && !std::thread::panicking();
        debug_assert!(!unread, "a report with errors was dropped unread");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_errors_are_combined_in_order() {
        let report = Report::new();
        report.error(Span::call_site(), "first");
        assert_eq!(report.ok(syn::parse_str::<syn::Ident>("name")).map(|i| i.to_string()), Some("name".into()));
        assert!(report.ok(syn::parse_str::<syn::Ident>("1")).is_none());
        assert_eq!(report.count(), 2);
        let messages: Vec<String> = report.finish().unwrap_err().into_iter().map(|e| e.to_string()).collect();
        assert_eq!(messages.len(), 2);
        assert_eq!(messages[0], "first");
    }

    #[test]
    fn an_empty_report_is_fine() {
        assert!(Report::new().finish().is_ok());
        let report = Report::new();
        report.error(Span::call_site(), "nobody reads this");
        report.discard();
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "dropped unread")]
    fn an_unread_report_panics() {
        Report::new().error(Span::call_site(), "lost");
    }
}
