//! Formulas in readable form: Unicode text, LaTeX and MathML, with the user's names.
//!
//! The input is the text that [`Shown`](crate::expr::Shown) prints of an expression. [`FormulaTree::parse`] reads it, and
//! each notation has a writer of its own.
//!
//! ```
//! use kin_core::notation::{FormulaTree, Notation};
//!
//! let formula = FormulaTree::parse("coupler.x - 0.5*l2*cos(coupler.phi) + l1/2")?.tidied();
//! assert_eq!(formula.write(Notation::Unicode), "x_coupler − (l₂/2) cos φ_coupler + l₁/2");
//! assert_eq!(
//!     formula.write(Notation::Latex),
//!     r"x_{\mathrm{coupler}} - \frac{l_{2}}{2}\,\cos\varphi_{\mathrm{coupler}} + \frac{l_{1}}{2}"
//! );
//! # Ok::<(), kin_core::notation::ParseError>(())
//! ```

mod latex;
mod lines;
mod markup;
mod mathml;
mod name;
mod parse;
mod parts;
mod tidy;
mod tree;
mod unicode;

pub(crate) use latex::{command, upright};
pub(crate) use markup::escaped;
pub(crate) use name::greek;
pub use name::{BaseSymbol, Name};
pub use parse::ParseError;
pub use tree::FormulaTree;

/// A notation for formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// Plain text with Greek letters, dots and subscripts.
    Unicode,
    /// LaTeX for math mode, which needs no package other than amsmath.
    Latex,
    /// Presentation MathML: elements to be placed inside a `<math>` element.
    MathMl,
}

impl FormulaTree {
    /// The formula in a notation.
    pub fn write(&self, notation: Notation) -> String {
        match notation {
            Notation::Unicode => unicode::write(self),
            Notation::Latex => latex::write(self),
            Notation::MathMl => mathml::write(self),
        }
    }
}

impl Name {
    /// The name in a notation.
    pub fn write(&self, notation: Notation) -> String {
        match notation {
            Notation::Unicode => unicode::name(self),
            Notation::Latex => latex::name(self),
            Notation::MathMl => mathml::name(self),
        }
    }
}

#[cfg(test)]
mod tests;
