//! Shared by the tests: random expressions, numbers of other kinds, derivatives by the textbook, and a reader of
//! printed expressions. Nothing here uses the library's own derivatives.

#![allow(dead_code, missing_docs, unreachable_pub, unused_imports)]

mod linkage;
mod number;
mod partial;
mod reader;
mod tree;

pub use linkage::*;
pub use number::*;
pub use partial::*;
pub use reader::*;
pub use tree::*;
