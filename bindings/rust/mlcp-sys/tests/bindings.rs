//! The committed bindings are what bindgen makes of mlcp.h.
#![cfg(feature = "bindgen")]
use std::{env, fs, path::Path};

/// `MLCP_WRITE_BINDINGS=1` writes them instead.
#[test]
fn committed_bindings_are_those_of_the_header() {
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/bindings.rs");
    let generated = include_str!(concat!(env!("OUT_DIR"), "/bindings.rs"));
    if env::var_os("MLCP_WRITE_BINDINGS").is_some() {
        fs::write(&committed, generated).unwrap();
    }
    let same = fs::read_to_string(&committed).is_ok_and(|text| text == generated);
    assert!(same, "{} is not what bindgen makes of mlcp.h: MLCP_WRITE_BINDINGS=1 writes it", committed.display());
}
