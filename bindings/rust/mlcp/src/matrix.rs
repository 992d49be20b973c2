//! Sparse matrices on their way in and out.
use crate::constants::constants;
use crate::error::{Error, Result};
use crate::numbers::{check_length, lent};

constants! {
    /// The part of a symmetric matrix that is stored, as of compressed columns: whoever has the lower triangle in compressed rows says
    /// `Upper`.
    Triangle, sys::mlcp_triangle {
        /// Both triangles.
        Full = MLCP_FULL,
        /// The diagonal and what is below it.
        Lower = MLCP_LOWER,
        /// The diagonal and what is above it.
        Upper = MLCP_UPPER,
    }
}

/// A compressed matrix, by rows (CSR) or columns (CSC): line i holds entries `pointers[i] .. pointers[i + 1]`, in any order, none twice.
#[derive(Clone, Copy, Debug)]
pub struct Compressed<'a> {
    /// One more than there are lines; starts at 0 and never falls.
    pub pointers: &'a [i32],
    /// Column of every entry (CSR) or row (CSC).
    pub indices: &'a [i32],
    /// Value of every entry.
    pub values: &'a [f64],
}

impl Compressed<'_> {
    /// The pointers are as many as `lines` need, and none of the entries that they speak of is missing.
    pub(crate) fn check(&self, lines: usize) -> Result<()> {
        check_length("pointers", self.pointers.len(), lines + 1)?;
        let entries = self.pointers.last().copied().map_or(0, i64::from);
        for (name, length) in [("indices", self.indices.len()), ("values", self.values.len())] {
            if usize::try_from(entries).is_ok_and(|entries| entries > length) {
                return Err(Error::Range(format!("{name} has length {length}, but pointers end at {entries}")));
            }
        }
        Ok(())
    }
}

/// What the lines of a compressed matrix are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    /// Rows (CSR).
    Rows,
    /// Columns (CSC).
    Columns,
}

/// A sparse matrix that a [`Problem`](crate::Problem) lends: J by rows; M and Σ by columns, both triangles. In J and M the entries of a
/// line are not sorted in general.
#[derive(Clone, Copy, Debug)]
pub struct MatrixView<'a> {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// What the lines are.
    pub order: Order,
    /// Pointers, indices and values.
    pub entries: Compressed<'a>,
}

impl MatrixView<'_> {
    /// # Safety
    /// The view comes from the library and is in this order; what it points to does not change during the lifetime.
    pub(crate) unsafe fn new(view: &sys::mlcp_matrix_view, order: Order) -> Self {
        let size = crate::numbers::count;
        let lines = match order {
            Order::Rows => view.rows,
            Order::Columns => view.columns,
        };
        let entries = usize::try_from(view.entries).unwrap_or(0);
        // SAFETY: as promised by the caller, and lines + 1 pointers and `entries` entries are what the library lends.
        let entries = unsafe {
            Compressed {
                pointers: lent(view.pointers, size(lines) + 1),
                indices: lent(view.indices, entries),
                values: lent(view.values, entries),
            }
        };
        MatrixView { rows: size(view.rows), columns: size(view.columns), order, entries }
    }
}
