//! The structs have the layout of mlcp.h.
use std::fs;
use std::mem::MaybeUninit;
use std::path::Path;

use mlcp_sys::*;

fn read(file: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap()
}

/// The assertions are bindgen's: they hold or this does not compile. None may be missing.
#[test]
fn every_struct_of_the_header_has_assertions_of_its_layout() {
    let (header, bindings) = (read("vendor/capi/mlcp.h"), read("src/bindings.rs"));
    let structs: Vec<&str> = header.lines().filter_map(|line| line.strip_prefix("typedef struct ")?.strip_suffix(" {")).collect();
    assert!(structs.contains(&"mlcp_report") && structs.len() >= 8, "{structs:?}");
    for name in structs {
        for what in ["Size of", "Alignment of"] {
            assert!(bindings.contains(&format!("\"{what} {name}\"")), "no assertion: {what} {name}");
        }
        let start = bindings.find(&format!("pub struct {name} {{")).unwrap();
        let fields = bindings[start..].split("\n}").next().unwrap();
        for field in fields.lines().filter_map(|line| line.strip_prefix("    pub ")?.split(':').next()) {
            assert!(bindings.contains(&format!("\"Offset of field: {name}::{field}\"")), "no assertion: {name}::{field}");
        }
    }
}

/// Calls an init function on a struct full of ones.
fn initialised<T>(init: unsafe extern "C" fn(*mut T, usize)) -> T {
    let mut value = MaybeUninit::<T>::uninit();
    // SAFETY: any bytes will do for a struct to be filled, and the init function fills all of it.
    unsafe {
        value.as_mut_ptr().write_bytes(0xff, 1);
        init(value.as_mut_ptr(), size_of::<T>());
        value.assume_init()
    }
}

#[test]
fn the_library_fills_structs_from_the_first_field_to_the_last() {
    let settings = initialised(mlcp_settings_init);
    assert_eq!((settings.struct_size, settings.method, settings.tolerance), (size_of_val(&settings), MLCP_METHOD_AUTO, 1e-9));
    assert!(settings.progress.is_none() && settings.parallel_context.is_null());
    let rows = initialised(mlcp_rows_init);
    assert!(rows.struct_size == size_of_val(&rows) && rows.count == 0 && rows.body_a.is_null() && rows.key_stride == 0);
    let rows = initialised(mlcp_rows_f32_init);
    assert!(rows.struct_size == size_of_val(&rows) && rows.count == 0 && rows.body_a.is_null() && rows.key_stride == 0);
    let report = initialised(mlcp_report_init);
    assert_eq!((report.struct_size, report.outcome, report.fallbacks), (size_of_val(&report), MLCP_SOLVED, 0));
    let view = initialised(mlcp_matrix_view_init);
    assert!(view.struct_size == size_of_val(&view) && view.rows == 0 && view.values.is_null());
}

#[test]
fn the_library_that_is_linked_has_the_abi_and_the_version_of_the_bindings() {
    // SAFETY: neither function has conditions; the text is static.
    let (abi, version) = unsafe { (mlcp_abi_version(), std::ffi::CStr::from_ptr(mlcp_version())) };
    assert_eq!(abi, MLCP_ABI_VERSION);
    assert_eq!(version.to_str(), Ok(env!("CARGO_PKG_VERSION")));
}
