//! Reading a problem back.
use std::mem::MaybeUninit;
use std::ptr::null_mut;

use super::Problem;
use crate::error::{Result, check};
use crate::matrix::{MatrixView, Order};
use crate::numbers::{check_length, int};
use crate::rows::RowFieldsMut;

/// NULL where an array is not wanted.
fn pointer<T>(array: Option<&mut [T]>) -> *mut T {
    array.map_or(null_mut(), <[T]>::as_mut_ptr)
}

impl Problem {
    /// Copies k into n numbers.
    pub fn read_momentum(&self, k: &mut [f64]) -> Result<()> {
        check_length("k", k.len(), self.velocity_count())?;
        // SAFETY: room for n numbers.
        check(unsafe { sys::mlcp_problem_get_momentum(self.as_ptr(), int("n", k.len())?, k.as_mut_ptr()) })
    }

    /// Copies what rows have besides their entries of J, into arrays of m values each.
    pub fn read_rows(&self, to: RowFieldsMut<'_>) -> Result<()> {
        let rows = self.row_count();
        to.check(rows)?;
        let [r, lo, hi, compliance] = [to.r, to.lo, to.hi, to.compliance].map(pointer);
        // SAFETY: room for m values in what is not NULL.
        check(unsafe { sys::mlcp_problem_get_rows(self.as_ptr(), int("m", rows)?, r, lo, hi, compliance, pointer(to.key)) })
    }

    /// M, lent until the problem changes.
    pub fn mass(&self) -> Result<MatrixView<'_>> {
        let view = self.view(sys::mlcp_problem_mass)?;
        // SAFETY: by columns, and unchanged while the problem is borrowed.
        Ok(unsafe { MatrixView::new(&view, Order::Columns) })
    }

    /// J, lent until the problem changes.
    pub fn jacobian(&self) -> Result<MatrixView<'_>> {
        let view = self.view(sys::mlcp_problem_jacobian)?;
        // SAFETY: by rows, and unchanged while the problem is borrowed.
        Ok(unsafe { MatrixView::new(&view, Order::Rows) })
    }

    /// Σ, lent until the problem changes.
    pub fn compliance(&self) -> Result<MatrixView<'_>> {
        let view = self.view(sys::mlcp_problem_compliance)?;
        // SAFETY: by columns, and unchanged while the problem is borrowed.
        Ok(unsafe { MatrixView::new(&view, Order::Columns) })
    }

    fn view(
        &self,
        get: unsafe extern "C" fn(*const sys::mlcp_problem, *mut sys::mlcp_matrix_view) -> sys::mlcp_status,
    ) -> Result<sys::mlcp_matrix_view> {
        let mut view = MaybeUninit::uninit();
        // SAFETY: the init function fills the struct, every field; then a live handle and a view that says its size.
        unsafe {
            sys::mlcp_matrix_view_init(view.as_mut_ptr(), size_of_val(&view));
            check(get(self.as_ptr(), view.as_mut_ptr()))?;
            Ok(view.assume_init())
        }
    }
}
