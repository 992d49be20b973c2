//! Misuse does not compile, for the reason beside it. A file that cannot compile for another one is seen in its error.
#[test]
fn misuse_does_not_compile() {
    trybuild::TestCases::new().compile_fail("tests/misuse/*.rs");
}
