//! The pattern of the factor.
use std::mem::MaybeUninit;

use crate::Solver;
use crate::error::{Result, check};
use crate::numbers::{count, index, lent};

/// Pattern of L of the last analysis, every enabled row in: `K = [M Jᵀ; J −Σ]` in elimination order. What couples to nothing is not in
/// it. An island is a range of positions that ends with a column without entries. Lent until the solver is used again.
#[derive(Clone, Copy, Debug)]
pub struct Factor<'a> {
    /// What stands at each position: velocity j as j, row i as n + i.
    pub nodes: &'a [i32],
    /// Compressed columns: one more than there are positions.
    pub pointers: &'a [i64],
    /// Positions below the diagonal, ascending in each column.
    pub rows: &'a [i32],
}

impl<'a> Factor<'a> {
    /// Number of positions.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// Entries below the diagonal of a column, by position; empty for a column that there is not.
    pub fn column(&self, position: usize) -> &'a [i32] {
        let pointer = |at: usize| self.pointers.get(at).and_then(|&pointer| usize::try_from(pointer).ok());
        let (Some(begin), Some(end)) = (pointer(position), position.checked_add(1).and_then(pointer)) else { return &[] };
        self.rows.get(begin..end).unwrap_or(&[])
    }

    /// The parent of a position in the elimination tree: the first entry of its column, `None` for a root.
    pub fn parent(&self, position: usize) -> Option<usize> {
        self.column(position).first().and_then(|&parent| index(parent))
    }
}

impl Solver {
    /// The pattern of the factor. [`Error::State`](crate::Error::State) where there is none: before the first analysis or
    /// solve, after [`Solver::trim`], and as long as [`Method::Auto`](crate::Method::Auto) has met small islands alone, which it solves without.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// # use mlcp::{Problem, Row, Solver};
    /// let mut problem = Problem::new()?;
    /// problem.add_bodies(1, &[1.0, 1.0])?;
    /// problem.add_row(&Row::bilateral(&[0, 1], &[1.0, -1.0]))?;
    /// let mut solver = Solver::new()?;
    /// solver.analyze(&problem, None)?;
    ///
    /// // two velocities and a row: the path from any position ends at the one root
    /// let factor = solver.factor()?;
    /// assert_eq!(factor.size(), 3);
    /// let path = std::iter::successors(Some(0), |&position| factor.parent(position));
    /// assert_eq!(path.last(), Some(2));
    /// # Ok(()) }
    /// ```
    pub fn factor(&self) -> Result<Factor<'_>> {
        let mut view = MaybeUninit::<sys::mlcp_factor_view>::uninit();
        // SAFETY: the init function fills the struct, every field; then a live handle and a view that says its size. What it points to is
        // lent until the solver is used again, for which it must not be borrowed.
        unsafe {
            sys::mlcp_factor_view_init(view.as_mut_ptr(), size_of_val(&view));
            check(sys::mlcp_solver_factor(self.as_ptr(), view.as_mut_ptr()))?;
            let view = view.assume_init();
            let (size, entries) = (count(view.size), usize::try_from(view.entries).unwrap_or(0));
            Ok(Factor { nodes: lent(view.nodes, size), pointers: lent(view.pointers, size + 1), rows: lent(view.rows, entries) })
        }
    }
}
