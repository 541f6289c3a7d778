//! Oracles of programs and plans: what generated code must give, computed by interpreters in double precision.

#![allow(dead_code, missing_docs, unreachable_pub, unused_imports, reason = "each test uses a part of it")]

mod plan;
mod program;
mod rolled;

pub use plan::*;
pub use program::*;
pub use rolled::*;
