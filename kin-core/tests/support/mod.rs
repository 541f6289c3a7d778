//! Shared by the tests: random expressions, numbers of other kinds, derivatives by the textbook, and a reader of
//! printed expressions. Nothing here uses the library's own derivatives.

#![allow(dead_code, missing_docs, unreachable_pub, unused_imports, reason = "each test uses a part of it")]

pub mod chains;
mod direct;
mod free;
mod linkage;
mod number;
#[path = "../oracle/mod.rs"]
pub mod oracle;
mod partial;
mod random;
mod reader;
mod tree;

pub use direct::*;
pub use free::*;
pub use linkage::*;
pub use number::*;
pub use oracle::{Environment, evaluate, interpret, interpret_rolled};
pub use partial::*;
pub use random::*;
pub use reader::*;
pub use tree::*;
