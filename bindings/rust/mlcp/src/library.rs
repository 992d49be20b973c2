//! The library that is loaded.
use crate::error::{Error, Result, text_of};

/// "major.minor.patch" of the library that is loaded, which may be newer than this crate.
pub fn version() -> String {
    // SAFETY: a string of static storage.
    unsafe { text_of(sys::mlcp_version()) }
}

/// Every constructor asks this first: the structs of another ABI would be read wrongly.
pub(crate) fn check_abi() -> Result<()> {
    // SAFETY: the function has no conditions.
    let library = unsafe { sys::mlcp_abi_version() };
    let needed = sys::MLCP_ABI_VERSION;
    if library == needed { Ok(()) } else { Err(Error::Abi { library, needed }) }
}
