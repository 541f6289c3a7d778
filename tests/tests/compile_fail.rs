//! What is said about wrong descriptions, and on which token; what is right compiles.
//!
//! `TRYBUILD=overwrite cargo test -p kin-tests --test compile_fail` writes the expected output anew.

#[test]
fn descriptions() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("compile_fail/*.rs");
}
