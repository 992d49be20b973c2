//! Lengths and indices are `usize` here and 32-bit in the library.
use crate::error::{Error, Result};

/// A length or an index on its way in.
pub(crate) fn int(name: &str, value: usize) -> Result<i32> {
    i32::try_from(value).map_err(|_| Error::Range(format!("{name} = {value} does not fit 32 bits")))
}

/// A count from the library.
pub(crate) fn count(value: i32) -> usize {
    usize::try_from(value).unwrap_or(0)
}

/// An index from the library, where −1 stands for none.
pub(crate) fn index(value: i32) -> Option<usize> {
    usize::try_from(value).ok()
}

pub(crate) fn check_length(name: &str, length: usize, needed: usize) -> Result<()> {
    if length == needed { Ok(()) } else { Err(Error::Range(format!("{name} has length {length}, but {needed} is needed"))) }
}

/// # Safety
/// `data` is NULL, or points to `count` values that live and do not change during `'a`.
pub(crate) unsafe fn lent<'a, T>(data: *const T, count: usize) -> &'a [T] {
    if data.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: as promised by the caller.
    unsafe { std::slice::from_raw_parts(data, count) }
}
