//! Adding, changing and removing rows.
use std::ops::Range;
use std::ptr::null;

use super::Problem;
use crate::error::Result;
use crate::matrix::{Compressed, Triangle};
use crate::numbers::{check_length, count, int};
use crate::real::Real;
use crate::rows::{Row, RowFields, Rows};

/// NULL where an array is not given.
pub(super) fn pointer<T>(array: Option<&[T]>) -> *const T {
    array.map_or(null(), <[T]>::as_ptr)
}

impl Problem {
    /// Adds rows between bodies; returns their indices. All of a body's velocities become entries of the row, zeros included.
    pub fn add_rows<T: Real>(&mut self, rows: &Rows<'_, T>) -> Result<Range<usize>> {
        let strides = rows.check(|body| self.dimension(body))?;
        let (added, mut first) = (int("count", rows.count())?, 0);
        // SAFETY: the arrays were checked.
        self.edit(|raw| unsafe { T::add_rows(raw, added, rows, strides, &mut first) })?;
        Ok(range(first, rows.count()))
    }

    /// Adds one row; returns its index.
    pub fn add_row(&mut self, row: &Row<'_>) -> Result<usize> {
        check_length("values", row.values.len(), row.columns.len())?;
        let (entries, mut index) = (int("the length of columns", row.columns.len())?, 0);
        // SAFETY: that many columns and values.
        self.edit(|raw| unsafe {
            let (columns, values) = (row.columns.as_ptr(), row.values.as_ptr());
            sys::mlcp_problem_row_add(raw, entries, columns, values, row.r, row.lo, row.hi, row.compliance, row.key, &mut index)
        })?;
        Ok(count(index))
    }

    /// Adds rows over the velocities, compressed by rows; returns their indices.
    pub fn add_rows_csr(&mut self, jacobian: Compressed<'_>, fields: &RowFields<'_>) -> Result<Range<usize>> {
        let lines = jacobian.pointers.len().saturating_sub(1);
        jacobian.check(lines)?;
        let (rows, mut first) = (fields.check(lines)?, 0);
        let (pointers, columns, values) = (jacobian.pointers.as_ptr(), jacobian.indices.as_ptr(), jacobian.values.as_ptr());
        let [r, lo, hi, compliance] = [fields.r, fields.lo, fields.hi, fields.compliance].map(pointer);
        let key = pointer(fields.key);
        // SAFETY: rows + 1 pointers, the entries that they speak of, and a value a row in what is not NULL.
        self.edit(|raw| unsafe {
            sys::mlcp_problem_rows_add_csr(raw, rows, pointers, columns, values, r, lo, hi, compliance, key, &mut first)
        })?;
        Ok(range(first, lines))
    }

    /// Adds `rows` rows over the velocities, compressed by columns, all n of them; returns their indices.
    pub fn add_rows_csc(&mut self, rows: usize, jacobian: Compressed<'_>, fields: &RowFields<'_>) -> Result<Range<usize>> {
        jacobian.check(self.velocity_count())?;
        let (added, mut first) = (fields.check(rows)?, 0);
        let (pointers, indices, values) = (jacobian.pointers.as_ptr(), jacobian.indices.as_ptr(), jacobian.values.as_ptr());
        let [r, lo, hi, compliance] = [fields.r, fields.lo, fields.hi, fields.compliance].map(pointer);
        let key = pointer(fields.key);
        // SAFETY: n + 1 pointers, the entries that they speak of, and a value a row in what is not NULL.
        self.edit(|raw| unsafe {
            sys::mlcp_problem_rows_add_csc(raw, added, pointers, indices, values, r, lo, hi, compliance, key, &mut first)
        })?;
        Ok(range(first, rows))
    }

    /// Σ as a whole, m × m and symmetric, in place of every compliance. Diagonal entries are not negative on rows with an entry of J.
    /// Rows that are added later have only their diagonal.
    pub fn set_compliance_matrix(&mut self, compliance: Compressed<'_>, triangle: Triangle) -> Result<()> {
        let lines = compliance.pointers.len().saturating_sub(1);
        compliance.check(lines)?;
        let (rows, triangle) = (int("the size of the compliance", lines)?, triangle.raw());
        let (pointers, indices, values) = (compliance.pointers.as_ptr(), compliance.indices.as_ptr(), compliance.values.as_ptr());
        // SAFETY: rows + 1 pointers and the entries that they speak of.
        self.edit(|raw| unsafe { sys::mlcp_problem_set_compliance_matrix(raw, rows, pointers, indices, values, triangle) })
    }

    /// New right-hand sides, m/s, from row `first` on. The pattern stays and nothing is analyzed again, here and in what follows.
    pub fn set_r(&mut self, first: usize, r: &[f64]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of r", r.len())?);
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_set_r(raw, first, rows, r.as_ptr()) })
    }

    /// New bounds, N·s, from row `first` on.
    pub fn set_bounds(&mut self, first: usize, lo: &[f64], hi: &[f64]) -> Result<()> {
        check_length("hi", hi.len(), lo.len())?;
        let (first, rows) = (int("first", first)?, int("the length of lo", lo.len())?);
        // SAFETY: that many numbers in both.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_set_bounds(raw, first, rows, lo.as_ptr(), hi.as_ptr()) })
    }

    /// A new diagonal of Σ, m/(N·s), from row `first` on.
    pub fn set_compliance(&mut self, first: usize, compliance: &[f64]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of compliance", compliance.len())?);
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_set_compliance(raw, first, rows, compliance.as_ptr()) })
    }

    /// New keys from row `first` on.
    pub fn set_keys(&mut self, first: usize, keys: &[u64]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of keys", keys.len())?);
        // SAFETY: that many keys.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_set_keys(raw, first, rows, keys.as_ptr()) })
    }

    /// New entries of J in one row, all of them in the order they were added: the block of the first body, then that of the second.
    pub fn set_jacobian(&mut self, row: usize, values: &[f64]) -> Result<()> {
        let (row, entries) = (int("row", row)?, int("the length of values", values.len())?);
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_problem_row_set_jacobian(raw, row, values.as_ptr(), entries) })
    }

    /// Removes different rows; those behind move up, their order stays.
    pub fn remove_rows(&mut self, rows: &[i32]) -> Result<()> {
        let removed = int("the length of rows", rows.len())?;
        // SAFETY: that many indices.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_remove(raw, removed, rows.as_ptr()) })
    }

    /// Removes all rows; bodies stay. O(1).
    pub fn clear_rows(&mut self) -> Result<()> {
        // SAFETY: a live handle.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_clear(raw) })
    }
}

pub(super) fn range(first: i32, rows: usize) -> Range<usize> {
    count(first)..count(first) + rows
}
