//! Oracles of programs and plans: what generated code must give, computed by interpreters in double precision; and
//! the reference evaluator of expressions.

#![allow(dead_code, missing_docs, unreachable_pub, unused_imports, reason = "each test uses a part of it")]

mod evaluate;
mod plan;
mod program;
mod rolled;

pub use evaluate::*;
pub use plan::*;
pub use program::*;
pub use rolled::*;
