//! Whole matrices with their shape, from wherever they are.
use std::borrow::Cow;
use std::convert::Infallible;
use std::ops::Range;

use crate::error::{Error, Result};
use crate::matrix::{Compressed, MatrixView, Order, Triangle};
use crate::numbers::check_length;
use crate::rows::RowFields;
use crate::{Body, Problem};

/// A sparse matrix with its shape, for the calls that take matrices as a whole. Pointers, indices and values are borrowed where their layout
/// is the library's, which has 32-bit indices; 64-bit ones are narrowed into a copy, values never copied.
///
/// A [`MatrixView`] of another problem is one; with the features `nalgebra-sparse` and `sprs` so are references to their matrices.
#[derive(Clone, Debug)]
pub struct SparseMatrix<'a> {
    rows: usize,
    columns: usize,
    order: Order,
    pointers: Cow<'a, [i32]>,
    indices: Cow<'a, [i32]>,
    values: &'a [f64],
}

impl<'a> SparseMatrix<'a> {
    /// A matrix in compressed rows.
    pub fn csr(rows: usize, columns: usize, entries: Compressed<'a>) -> Result<Self> {
        entries.check(rows)?;
        Ok(Self::borrowed(rows, columns, Order::Rows, entries))
    }

    /// A matrix in compressed columns.
    pub fn csc(rows: usize, columns: usize, entries: Compressed<'a>) -> Result<Self> {
        entries.check(columns)?;
        Ok(Self::borrowed(rows, columns, Order::Columns, entries))
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Whether pointers and indices are the caller's own memory.
    pub fn is_borrowed(&self) -> bool {
        matches!((&self.pointers, &self.indices), (Cow::Borrowed(_), Cow::Borrowed(_)))
    }

    fn borrowed(rows: usize, columns: usize, order: Order, entries: Compressed<'a>) -> Self {
        let Compressed { pointers, indices, values } = entries;
        SparseMatrix { rows, columns, order, pointers: pointers.into(), indices: indices.into(), values }
    }

    #[cfg(any(feature = "nalgebra-sparse", feature = "sprs"))]
    pub(crate) fn new(
        (rows, columns): (usize, usize),
        order: Order,
        pointers: Cow<'a, [i32]>,
        indices: Cow<'a, [i32]>,
        values: &'a [f64],
    ) -> Self {
        SparseMatrix { rows, columns, order, pointers, indices, values }
    }

    fn compressed(&self) -> Compressed<'_> {
        Compressed { pointers: &self.pointers, indices: &self.indices, values: self.values }
    }

    fn check_square(&self, name: &str) -> Result<()> {
        let (rows, columns) = (self.rows, self.columns);
        if rows == columns { Ok(()) } else { Err(Error::Range(format!("{name} is {rows} x {columns}, but must be square"))) }
    }

    /// The library means triangles of compressed columns; those of compressed rows are the others.
    fn triangle(&self, stored: Triangle) -> Triangle {
        match (self.order, stored) {
            (Order::Rows, Triangle::Lower) => Triangle::Upper,
            (Order::Rows, Triangle::Upper) => Triangle::Lower,
            _ => stored,
        }
    }
}

impl<'a> From<MatrixView<'a>> for SparseMatrix<'a> {
    fn from(view: MatrixView<'a>) -> Self {
        Self::borrowed(view.rows, view.columns, view.order, view.entries)
    }
}

impl From<Infallible> for Error {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

impl Problem {
    /// A problem from its matrices: one body of all velocities with the mass M, both triangles, its momentum k, and the rows J. Bodies with a mass
    /// each ([`add_body`](Self::add_body)) are islands of their own where no row couples them, velocities of one body never are.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Compressed, Problem, RowFields, Solver, SparseMatrix};
    ///
    /// let mass = Compressed { pointers: &[0, 1, 2], indices: &[0, 1], values: &[2.0, 1.0] };
    /// let jacobian = Compressed { pointers: &[0, 2], indices: &[0, 1], values: &[1.0, -1.0] };
    /// let problem = Problem::from_matrices(
    ///     SparseMatrix::csc(2, 2, mass)?,
    ///     &[-2.0, 1.0], // two bodies that approach each other at 2 m/s
    ///     SparseMatrix::csr(1, 2, jacobian)?,
    ///     &RowFields::default(),
    /// )?;
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// assert!(solver.velocities()?.iter().all(|v| (v + 1.0 / 3.0).abs() < 1e-15));
    /// # Ok(()) }
    /// ```
    pub fn from_matrices<'a, M, J>(mass: M, momentum: &[f64], jacobian: J, fields: &RowFields<'_>) -> Result<Self>
    where
        M: TryInto<SparseMatrix<'a>>,
        J: TryInto<SparseMatrix<'a>>,
        Error: From<M::Error> + From<J::Error>,
    {
        let mut problem = Problem::new()?;
        problem.add_matrix_body(mass, Triangle::Full)?;
        check_length("momentum", momentum.len(), problem.velocity_count())?;
        problem.set_momentum(0, momentum)?;
        problem.add_matrix_rows(jacobian, fields)?;
        Ok(problem)
    }

    /// A reduced problem: no bodies, `w = A γ − r`. A, the Delassus matrix, is m × m and symmetric, and `triangle` says which part of it is
    /// stored; r is −b where the problem is written `w = A z + b`. Fields with a compliance are refused, because A stands in its place.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Compressed, Problem, RowFields, Solver, SparseMatrix, Triangle};
    /// let lower = Compressed { pointers: &[0, 2, 3], indices: &[0, 1, 1], values: &[2.0, 1.0, 2.0] };
    /// let fields = RowFields { r: Some(&[5.0, 6.0]), ..RowFields::default() };
    /// let problem = Problem::reduced(SparseMatrix::csc(2, 2, lower)?, Triangle::Lower, &fields)?;
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// let z = solver.impulses()?;
    /// assert!((z[0] - 4.0 / 3.0).abs() < 1e-14 && (z[1] - 7.0 / 3.0).abs() < 1e-14);
    /// # Ok(()) }
    /// ```
    pub fn reduced<'a, A>(a: A, triangle: Triangle, fields: &RowFields<'_>) -> Result<Self>
    where
        A: TryInto<SparseMatrix<'a>>,
        Error: From<A::Error>,
    {
        if fields.compliance.is_some() {
            return Err(Error::Argument("compliance: a reduced problem has its matrix there".into()));
        }
        let a: SparseMatrix<'_> = a.try_into()?;
        a.check_square("the matrix of a reduced problem")?;
        let mut problem = Problem::new()?;
        let without_entries = Compressed { pointers: &vec![0; a.rows + 1], indices: &[], values: &[] };
        problem.add_rows_csr(without_entries, fields)?;
        problem.set_compliance_matrix(a.compressed(), a.triangle(triangle))?;
        Ok(problem)
    }

    /// Adds one body whose mass is a sparse matrix, as [`add_sparse_body`](Self::add_sparse_body) does; `triangle`: the part of it that is
    /// stored.
    pub fn add_matrix_body<'a, M>(&mut self, mass: M, triangle: Triangle) -> Result<Body>
    where
        M: TryInto<SparseMatrix<'a>>,
        Error: From<M::Error>,
    {
        let mass: SparseMatrix<'_> = mass.try_into()?;
        mass.check_square("mass")?;
        self.add_sparse_body(mass.rows, mass.compressed(), mass.triangle(triangle))
    }

    /// Adds the rows of a matrix with a column for every velocity; returns their indices.
    pub fn add_matrix_rows<'a, J>(&mut self, jacobian: J, fields: &RowFields<'_>) -> Result<Range<usize>>
    where
        J: TryInto<SparseMatrix<'a>>,
        Error: From<J::Error>,
    {
        let jacobian: SparseMatrix<'_> = jacobian.try_into()?;
        if jacobian.columns != self.velocity_count() {
            let (columns, n) = (jacobian.columns, self.velocity_count());
            return Err(Error::Range(format!("jacobian has {columns} columns, but there are {n} velocities")));
        }
        match jacobian.order {
            Order::Rows => self.add_rows_csr(jacobian.compressed(), fields),
            Order::Columns => self.add_rows_csc(jacobian.rows, jacobian.compressed(), fields),
        }
    }
}
