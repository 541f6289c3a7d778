//! The error ledger: every mistake of a description is collected, so that all are shown at once.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use std::cell::RefCell;
use std::fmt::Display;

/// Collects spanned errors; whoever drops one without reading it hears about it in debug builds.
#[derive(Debug, Default)]
pub(crate) struct Report {
    errors: RefCell<Vec<syn::Error>>,
}

impl Report {
    /// An empty ledger.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Notes `message` on the token at `span`.
    pub(crate) fn error(&self, span: Span, message: impl Display) {
        self.push(syn::Error::new(span, message));
    }

    /// Notes `message` on everything from the token at `first` to the one at `last`.
    pub(crate) fn error_between(&self, first: Span, last: Span, message: impl Display) {
        let ends = [first, last].map(|span| TokenTree::from(Ident::new("_", span)));
        self.push(syn::Error::new_spanned(TokenStream::from_iter(ends), message));
    }

    /// Notes an error that a parser returned.
    pub(crate) fn push(&self, error: syn::Error) {
        self.errors.borrow_mut().push(error);
    }

    /// The value, or `None` with the error noted.
    pub(crate) fn ok<T>(&self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    /// How many errors there are so far.
    pub(crate) fn count(&self) -> usize {
        self.errors.borrow().len()
    }

    /// Everything that was noted, as one error that shows all of them.
    pub(crate) fn finish(self) -> syn::Result<()> {
        let combined = self.errors.take().into_iter().reduce(|mut all, error| {
            all.combine(error);
            all
        });
        combined.map_or(Ok(()), Err)
    }

    /// Forgets everything: nobody reads the errors of an expansion that only serves completion.
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
