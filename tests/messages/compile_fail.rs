//! The compiler errors for wrong descriptions, with the tokens at which they are shown; valid parts must compile.
//!
//! `TRYBUILD=overwrite cargo test -p kin-tests-messages` writes the expected output.

#[test]
fn descriptions() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("compile_fail/*.rs");
}
