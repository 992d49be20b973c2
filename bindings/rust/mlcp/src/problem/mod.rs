//! Bodies, rows and their numbers.
mod bodies;
mod contacts;
mod read;
mod rows;

use std::fmt;
use std::ptr::{NonNull, null_mut};

use crate::body::Body;
use crate::error::{Result, check, check_with, text_of};
use crate::library::check_abi;
use crate::memory::ALLOCATOR;
use crate::numbers::{count, int};

/// A problem: bodies with their masses and momenta, and constraint rows between them.
///
/// A body is a block of velocities (3 in the plane, 6 in space) with its mass matrix. The velocities of all bodies stand in v and k in
/// ascending order of body id; rows are numbered in order of adding. Input is copied. A call that fails changes nothing.
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// use mlcp::{Body, Problem, Rows};
///
/// let mut problem = Problem::new()?;
/// let body = problem.add_body(3, &[2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.1])?;
/// let rows = problem.add_rows(&Rows::new(2).body_a(&[body, body]).jacobian_a(&[0.0, 1.0, -0.2, 0.0, 1.0, 0.2]))?;
/// assert_eq!(rows, 0..2);
/// assert_eq!((problem.velocity_count(), problem.row_count()), (3, 2));
///
/// let refused = problem.set_bounds(0, &[0.0, 3.0], &[1.0, 2.0]);
/// assert_eq!(refused.unwrap_err().to_string(), "bad argument: lo[1] = 3 is above hi[1] = 2");
/// # Ok(()) }
/// ```
pub struct Problem {
    raw: NonNull<sys::mlcp_problem>,
    /// By body id, 0 for removed ones. The library has it too; here it makes the check of a bulk call cheap.
    dimensions: Vec<usize>,
}

// SAFETY: a problem belongs to no thread, its memory neither.
unsafe impl Send for Problem {}
// SAFETY: any number of threads may read one problem; what changes it needs &mut.
unsafe impl Sync for Problem {}

impl Drop for Problem {
    fn drop(&mut self) {
        // SAFETY: made by the library, and nobody has it any more.
        unsafe { sys::mlcp_problem_destroy(self.raw.as_ptr()) }
    }
}

impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Problem")
            .field("bodies", &self.body_count())
            .field("velocities", &self.velocity_count())
            .field("rows", &self.row_count())
            .finish_non_exhaustive()
    }
}

impl Problem {
    /// An empty problem.
    pub fn new() -> Result<Self> {
        check_abi()?;
        let mut raw = null_mut();
        // SAFETY: the library copies the hooks.
        check(unsafe { sys::mlcp_problem_create(&ALLOCATOR, &mut raw) })?;
        // SAFETY: just made.
        unsafe { Self::adopt(raw) }
    }

    /// Takes over a handle, with whatever it holds.
    ///
    /// # Safety
    /// The library made it with hooks that any thread can call, and nobody else has it.
    pub(crate) unsafe fn adopt(raw: *mut sys::mlcp_problem) -> Result<Self> {
        let raw = NonNull::new(raw).ok_or_else(|| crate::Error::Internal("no problem was made".into()))?;
        let mut problem = Problem { raw, dimensions: Vec::new() };
        for body in problem.bodies()? {
            let dimension = problem.body_range(body)?.len();
            problem.note_dimension(body, dimension);
        }
        Ok(problem)
    }

    /// A deep copy.
    pub fn try_clone(&self) -> Result<Self> {
        let mut raw = null_mut();
        // SAFETY: a live handle and a place for the new one.
        check(unsafe { sys::mlcp_problem_clone(self.as_ptr(), &mut raw) })?;
        // SAFETY: just made, with the hooks of this one.
        unsafe { Self::adopt(raw) }
    }

    /// Number of velocities, n.
    pub fn velocity_count(&self) -> usize {
        // SAFETY: a live handle.
        count(unsafe { sys::mlcp_problem_velocity_count(self.as_ptr()) })
    }

    /// Number of rows, m.
    pub fn row_count(&self) -> usize {
        // SAFETY: a live handle.
        count(unsafe { sys::mlcp_problem_row_count(self.as_ptr()) })
    }

    /// Number of bodies.
    pub fn body_count(&self) -> usize {
        // SAFETY: a live handle.
        count(unsafe { sys::mlcp_problem_body_count(self.as_ptr()) })
    }

    /// Number of stored entries of J.
    pub fn entry_count(&self) -> usize {
        // SAFETY: a live handle.
        usize::try_from(unsafe { sys::mlcp_problem_entry_count(self.as_ptr()) }).unwrap_or(0)
    }

    /// Makes room for that many bodies, velocities, rows and entries of J, so that adding them allocates nothing.
    pub fn reserve(&mut self, bodies: usize, velocities: usize, rows: usize, entries: usize) -> Result<()> {
        let (bodies, velocities, rows) = (int("bodies", bodies)?, int("velocities", velocities)?, int("rows", rows)?);
        let entries = i64::from(int("entries", entries)?);
        // SAFETY: a live handle.
        self.edit(|raw| unsafe { sys::mlcp_problem_reserve(raw, bodies, velocities, rows, entries) })
    }

    /// Gives unused memory back.
    pub fn trim(&mut self) -> Result<()> {
        // SAFETY: a live handle.
        self.edit(|raw| unsafe { sys::mlcp_problem_trim(raw) })
    }

    /// Back to empty; memory is kept.
    pub fn clear(&mut self) -> Result<()> {
        // SAFETY: a live handle.
        self.edit(|raw| unsafe { sys::mlcp_problem_clear(raw) })?;
        self.dimensions.clear();
        Ok(())
    }

    pub(crate) fn as_ptr(&self) -> *const sys::mlcp_problem {
        self.raw.as_ptr()
    }

    /// A call that changes the problem or says why not.
    pub(crate) fn edit(&mut self, call: impl FnOnce(*mut sys::mlcp_problem) -> sys::mlcp_status) -> Result<()> {
        let raw = self.raw.as_ptr();
        // SAFETY: a live handle, whose text stays until the next call.
        check_with(call(raw), || unsafe { text_of(sys::mlcp_problem_error(raw)) })
    }

    fn note_dimension(&mut self, body: Body, dimension: usize) {
        let Some(id) = crate::numbers::index(body.id()) else { return };
        if id >= self.dimensions.len() {
            self.dimensions.resize(id + 1, 0);
        }
        if let Some(known) = self.dimensions.get_mut(id) {
            *known = dimension;
        }
    }

    /// Number of velocities of a body; 0 for the world and for one that there is not.
    fn dimension(&self, body: Body) -> usize {
        crate::numbers::index(body.id()).and_then(|id| self.dimensions.get(id)).copied().unwrap_or(0)
    }
}
