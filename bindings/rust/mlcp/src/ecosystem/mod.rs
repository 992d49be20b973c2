//! What other crates work with, behind a feature for each.
#[cfg(feature = "nalgebra-sparse")]
mod nalgebra_sparse;
#[cfg(feature = "rayon")]
mod rayon;
#[cfg(feature = "serde")]
pub(crate) mod serde;
#[cfg(feature = "sprs")]
mod sprs;

/// 64-bit pointers or indices on their way in.
#[cfg(any(feature = "nalgebra-sparse", feature = "sprs"))]
fn narrowed(name: &str, wide: &[usize]) -> crate::Result<Vec<i32>> {
    wide.iter().map(|&value| crate::numbers::int(name, value)).collect()
}

/// Pointers or indices of the library on their way out.
#[cfg(any(feature = "nalgebra-sparse", feature = "sprs"))]
fn widened(narrow: &[i32]) -> Vec<usize> {
    narrow.iter().map(|&value| crate::numbers::count(value)).collect()
}
