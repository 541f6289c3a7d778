//! Mechanisms with known answers, and what the tests need to read and compare them.
#![deny(missing_docs, warnings)]

pub mod case;
pub mod compare;
pub mod mechanisms;
pub mod random;
pub mod stencil;

/// The README, whose code compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
