//! Matrices of nalgebra-sparse and vectors of nalgebra. Indices have 64 bits there, so that they are copied; values in matrices on their
//! way in and all vectors are not.
use nalgebra_sparse::na::DVectorView;
use nalgebra_sparse::{CscMatrix, CsrMatrix, SparseFormatError};

use super::{narrowed, widened};
use crate::{Error, MatrixView, Order, Result, Solver, SparseMatrix};

impl<'a> TryFrom<&'a CsrMatrix<f64>> for SparseMatrix<'a> {
    type Error = Error;

    fn try_from(matrix: &'a CsrMatrix<f64>) -> Result<Self> {
        let pointers = narrowed("a row offset", matrix.row_offsets())?.into();
        let indices = narrowed("a column index", matrix.col_indices())?.into();
        Ok(Self::new((matrix.nrows(), matrix.ncols()), Order::Rows, pointers, indices, matrix.values()))
    }
}

impl<'a> TryFrom<&'a CscMatrix<f64>> for SparseMatrix<'a> {
    type Error = Error;

    fn try_from(matrix: &'a CscMatrix<f64>) -> Result<Self> {
        let pointers = narrowed("a column offset", matrix.col_offsets())?.into();
        let indices = narrowed("a row index", matrix.row_indices())?.into();
        Ok(Self::new((matrix.nrows(), matrix.ncols()), Order::Columns, pointers, indices, matrix.values()))
    }
}

fn refused(error: SparseFormatError) -> Error {
    Error::Internal(format!("a matrix that nalgebra-sparse refuses: {error}"))
}

/// A copy with sorted lines.
impl TryFrom<MatrixView<'_>> for CsrMatrix<f64> {
    type Error = Error;

    fn try_from(view: MatrixView<'_>) -> Result<Self> {
        match view.order {
            Order::Rows => {
                let (pointers, indices) = (widened(view.entries.pointers), widened(view.entries.indices));
                let values = view.entries.values.to_vec();
                Self::try_from_unsorted_csr_data(view.rows, view.columns, pointers, indices, values).map_err(refused)
            }
            Order::Columns => CscMatrix::try_from(view).map(|matrix| Self::from(&matrix)),
        }
    }
}

/// A copy with sorted lines.
impl TryFrom<MatrixView<'_>> for CscMatrix<f64> {
    type Error = Error;

    fn try_from(view: MatrixView<'_>) -> Result<Self> {
        match view.order {
            Order::Columns => {
                let (pointers, indices) = (widened(view.entries.pointers), widened(view.entries.indices));
                let values = view.entries.values.to_vec();
                Self::try_from_unsorted_csc_data(view.rows, view.columns, pointers, indices, values).map_err(refused)
            }
            Order::Rows => CsrMatrix::try_from(view).map(|matrix| Self::from(&matrix)),
        }
    }
}

impl Solver {
    /// v as a vector of nalgebra, lent.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Problem, RowFields, Solver};
    /// use nalgebra_sparse::{CooMatrix, CscMatrix, CsrMatrix, na::DVector};
    ///
    /// let mass = CscMatrix::identity(2);
    /// let mut jacobian = CooMatrix::new(1, 2);
    /// jacobian.push(0, 0, 1.0);
    /// jacobian.push(0, 1, -1.0);
    /// let (jacobian, momentum) = (CsrMatrix::from(&jacobian), DVector::from_column_slice(&[-1.0, 1.0]));
    /// let problem = Problem::from_matrices(&mass, momentum.as_slice(), &jacobian, &RowFields::default())?;
    ///
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// let (v, gamma) = (solver.velocity_vector()?, solver.impulse_vector()?);
    /// assert!((&mass * v - jacobian.transpose() * gamma - momentum).norm() < 1e-15);
    /// # Ok(()) }
    /// ```
    pub fn velocity_vector(&self) -> Result<DVectorView<'_, f64>> {
        self.velocities().map(vector)
    }

    /// γ as a vector of nalgebra, lent.
    pub fn impulse_vector(&self) -> Result<DVectorView<'_, f64>> {
        self.impulses().map(vector)
    }

    /// w as a vector of nalgebra, lent.
    pub fn slack_vector(&self) -> Result<DVectorView<'_, f64>> {
        self.slacks().map(vector)
    }
}

fn vector(values: &[f64]) -> DVectorView<'_, f64> {
    DVectorView::from_slice(values, values.len())
}
