//! Matrices and vectors of sprs. Those with indices of type `i32` have the library's own layout and are read, and lent, where they are.
use sprs::errors::StructureError;
use sprs::{CsMat, CsMatI, CsMatView, CsMatViewI, CsVecI};

use super::{narrowed, widened};
use crate::numbers::int;
use crate::{Error, MatrixView, Order, Result, Solver, SparseMatrix};

impl<'a> From<CsMatViewI<'a, f64, i32>> for SparseMatrix<'a> {
    fn from(view: CsMatViewI<'a, f64, i32>) -> Self {
        let (shape, order) = (view.shape(), order(view.is_csr()));
        let (pointers, indices, values) = view.into_raw_storage();
        // some lines of a larger matrix have pointers that do not start at 0
        let pointers = match pointers.first() {
            Some(&offset) if offset != 0 => pointers.iter().map(|pointer| pointer - offset).collect(),
            _ => pointers.into(),
        };
        Self::new(shape, order, pointers, indices.into(), values)
    }
}

impl<'a> From<&'a CsMatI<f64, i32>> for SparseMatrix<'a> {
    fn from(matrix: &'a CsMatI<f64, i32>) -> Self {
        matrix.view().into()
    }
}

impl<'a> TryFrom<CsMatView<'a, f64>> for SparseMatrix<'a> {
    type Error = Error;

    fn try_from(view: CsMatView<'a, f64>) -> Result<Self> {
        let pointers = narrowed("an index pointer", &view.indptr().to_proper())?.into();
        let (shape, order) = (view.shape(), order(view.is_csr()));
        let (_, indices, values) = view.into_raw_storage();
        Ok(Self::new(shape, order, pointers, narrowed("an index", indices)?.into(), values))
    }
}

impl<'a> TryFrom<&'a CsMat<f64>> for SparseMatrix<'a> {
    type Error = Error;

    fn try_from(matrix: &'a CsMat<f64>) -> Result<Self> {
        matrix.view().try_into()
    }
}

fn order(is_csr: bool) -> Order {
    if is_csr { Order::Rows } else { Order::Columns }
}

/// Nothing is copied. The lines of J and M are sorted only where they were added so; [`Error::State`] where they are not.
impl<'a> TryFrom<MatrixView<'a>> for CsMatViewI<'a, f64, i32> {
    type Error = Error;

    fn try_from(view: MatrixView<'a>) -> Result<Self> {
        let (shape, entries) = ((view.rows, view.columns), view.entries);
        let made = match view.order {
            Order::Rows => Self::try_new(shape, entries.pointers, entries.indices, entries.values),
            Order::Columns => Self::try_new_csc(shape, entries.pointers, entries.indices, entries.values),
        };
        made.map_err(|(.., error)| refused(error))
    }
}

/// A copy with sorted lines.
impl TryFrom<MatrixView<'_>> for CsMatI<f64, i32> {
    type Error = Error;

    fn try_from(view: MatrixView<'_>) -> Result<Self> {
        let (pointers, indices) = (view.entries.pointers.to_vec(), view.entries.indices.to_vec());
        let (shape, values) = ((view.rows, view.columns), view.entries.values.to_vec());
        let made = match view.order {
            Order::Rows => Self::new_from_unsorted(shape, pointers, indices, values),
            Order::Columns => Self::new_from_unsorted_csc(shape, pointers, indices, values),
        };
        made.map_err(|(.., error)| refused(error))
    }
}

/// A copy with sorted lines and wide indices.
impl TryFrom<MatrixView<'_>> for CsMat<f64> {
    type Error = Error;

    fn try_from(view: MatrixView<'_>) -> Result<Self> {
        let (pointers, indices) = (widened(view.entries.pointers), widened(view.entries.indices));
        let (shape, values) = ((view.rows, view.columns), view.entries.values.to_vec());
        let made = match view.order {
            Order::Rows => Self::new_from_unsorted(shape, pointers, indices, values),
            Order::Columns => Self::new_from_unsorted_csc(shape, pointers, indices, values),
        };
        made.map_err(|(.., error)| refused(error))
    }
}

fn refused(error: StructureError) -> Error {
    Error::State(format!("a matrix that sprs refuses: {error}"))
}

impl Solver {
    /// The impulses that are not 0, N·s, as a sparse vector of sprs. Dense results go into `sprs::prod` as the slices that they are.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Problem, RowFields, Solver};
    /// use sprs::CsMatI;
    ///
    /// let mass = CsMatI::<f64, i32>::eye(2);
    /// let jacobian = CsMatI::<f64, i32>::eye(2); // the ground under each
    /// let problem = Problem::from_matrices(&mass, &[-1.0, 1.0], &jacobian, &RowFields::default())?;
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// assert_eq!(solver.impulses_not_zero()?.iter().collect::<Vec<_>>(), [(0, &1.0)]);
    /// # Ok(()) }
    /// ```
    pub fn impulses_not_zero(&self) -> Result<CsVecI<f64, i32>> {
        let impulses = self.impulses()?;
        let (mut indices, mut values) = (Vec::new(), Vec::new());
        for (row, &impulse) in impulses.iter().enumerate().filter(|(_, impulse)| **impulse != 0.0) {
            indices.push(int("row", row)?);
            values.push(impulse);
        }
        CsVecI::try_new(impulses.len(), indices, values).map_err(|(.., error)| refused(error))
    }
}
