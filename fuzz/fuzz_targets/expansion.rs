//! The whole expansion on any tokens: it never panics. `cargo +nightly fuzz run expansion`, from this directory's parent.
//!
//! The first line of an input is the arguments of `#[mechanism(…)]`, the rest is the item. On a stable compiler the
//! fuzzer of kin-derive, `kin-derive/src/fuzz`, puts descriptions together and damages them.
#![no_main]
#![allow(dead_code, unreachable_pub, reason = "modules of another crate")]

use libfuzzer_sys::fuzz_target;

#[path = "../../kin-derive/src/analyse.rs"]
mod analyse;
#[path = "../../kin-derive/src/ast.rs"]
mod ast;
#[path = "../../kin-derive/src/derive.rs"]
mod derive;
#[path = "../../kin-derive/src/documentation.rs"]
mod documentation;
#[path = "../../kin-derive/src/expand/mod.rs"]
mod expand;
#[path = "../../kin-derive/src/fallback.rs"]
mod fallback;
#[path = "../../kin-derive/src/function.rs"]
mod function;
#[path = "../../kin-derive/src/lower/mod.rs"]
mod lower;
#[path = "../../kin-derive/src/parse/mod.rs"]
mod parse;
#[path = "../../kin-derive/src/report.rs"]
mod report;
#[path = "../../kin-derive/src/suggest.rs"]
mod suggest;

fuzz_target!(|source: &str| {
    let (args, item) = source.split_once('\n').unwrap_or(("", source));
    if let (Ok(args), Ok(item)) = (args.parse(), item.parse()) {
        derive::derive(args, item);
    }
});
