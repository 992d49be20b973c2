//! Solving, and the results of the last solve.
use std::fmt;
use std::path::{Path, PathBuf};
use std::ptr::{NonNull, null, null_mut};

use crate::body::Body;
use crate::callbacks::Callbacks;
use crate::contacts::ContactState;
use crate::error::{Error, Result, check, check_with, text_of};
use crate::library::check_abi;
use crate::mask::MaskRef;
use crate::memory::ALLOCATOR;
use crate::numbers::{count, int, lent};
use crate::pivot::Pivot;
use crate::problem::Problem;
use crate::report::{Outcome, Report};
use crate::request::Request;
use crate::settings::Settings;
use crate::snapshot::c_path;
use crate::strided::StridedMut;

/// A solver: settings, ordering, factor, results and history. Keep one and use it again, so that it knows what it learned.
///
/// Results are lent until the solver is used again. Before the first solve asking for them is [`Error::State`].
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// use mlcp::{Problem, Row, Solver};
///
/// // a body of 2 kg that falls at 1 m/s onto the ground
/// let mut problem = Problem::new()?;
/// problem.add_body(1, &[2.0])?;
/// problem.set_momentum(0, &[-2.0])?;
/// problem.add_row(&Row::unilateral(&[0], &[1.0]))?;
///
/// let mut solver = Solver::new()?;
/// let report = solver.solve(&problem)?;
/// assert!(report.is_solved());
/// assert_eq!(solver.velocities()?, [0.0]);
/// assert_eq!(solver.impulses()?, [2.0]);
/// # Ok(()) }
/// ```
///
/// A step that follows starts from the last one: rows with keys do by themselves ([`Settings::warm_start`]), or a mask carries the states over.
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// # use mlcp::{Mask, Problem, Row, RowState, Solver};
/// # let (mut problem, mut solver) = (Problem::new()?, Solver::new()?);
/// # problem.add_body(1, &[2.0])?;
/// # problem.set_momentum(0, &[-2.0])?;
/// # problem.add_row(&Row::unilateral(&[0], &[1.0]).key(7))?;
/// # let _ = solver.solve(&problem)?;
/// let mut start = Mask::new(0, RowState::AT_LOWER)?;
/// problem.clear_rows()?;
/// problem.add_row(&Row::unilateral(&[0], &[1.0]).key(7))?;
/// assert!(solver.solve(&problem)?.warm);
/// start.carry(&problem, solver.mask()?, RowState::AT_LOWER)?;
/// let report = solver.request(&problem).start(&start).run()?;
/// assert!(report.warm && report.pivots <= 1);
/// # Ok(()) }
/// ```
pub struct Solver {
    raw: NonNull<sys::mlcp_solver>,
    /// The library has settings that point to callbacks, which are gone outside of a solve.
    has_callbacks: bool,
}

// SAFETY: a solver may be used by one thread after the other; its memory belongs to none. It is not Sync.
unsafe impl Send for Solver {}

impl Drop for Solver {
    fn drop(&mut self) {
        // SAFETY: made by the library, and nobody has it any more.
        unsafe { sys::mlcp_solver_destroy(self.raw.as_ptr()) }
    }
}

impl fmt::Debug for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solver").field("settings", &self.settings()).finish_non_exhaustive()
    }
}

/// What the library lends through a pointer and a count.
type Getter<T> = unsafe extern "C" fn(*const sys::mlcp_solver, *mut *const T, *mut i32) -> sys::mlcp_status;

impl Solver {
    /// A solver with the default settings.
    pub fn new() -> Result<Self> {
        Self::with_settings(&Settings::new())
    }

    /// A solver with these settings.
    pub fn with_settings(settings: &Settings) -> Result<Self> {
        check_abi()?;
        let mut raw = null_mut();
        // SAFETY: the library copies settings and hooks.
        check(unsafe { sys::mlcp_solver_create(null(), &ALLOCATOR, &mut raw) })?;
        // SAFETY: just made, without callbacks.
        let mut solver = unsafe { Self::adopt(raw) }?;
        solver.set_settings(settings)?;
        Ok(solver)
    }

    /// # Safety
    /// The library made the handle with hooks that any thread can call, it has no callbacks, and nobody else has it.
    pub(crate) unsafe fn adopt(raw: *mut sys::mlcp_solver) -> Result<Self> {
        let raw = NonNull::new(raw).ok_or_else(|| Error::Internal("no solver was made".into()))?;
        Ok(Solver { raw, has_callbacks: false })
    }

    /// Solves a problem with all its rows. An error means that the call could not be made; how the solve ended is in the report.
    pub fn solve(&mut self, problem: &Problem) -> Result<Report> {
        self.request(problem).run()
    }

    /// A solve with masks or callbacks.
    pub fn request<'a>(&'a mut self, problem: &'a Problem) -> Request<'a> {
        Request::new(self, problem)
    }

    /// Orders and analyzes the pattern of the problem with the enabled rows, `None` for all, so that a solve need not.
    pub fn analyze(&mut self, problem: &Problem, enabled: Option<&MaskRef>) -> Result<()> {
        let enabled = enabled.map_or(null(), MaskRef::as_ptr);
        // SAFETY: live handles.
        let status = unsafe { sys::mlcp_analyze(self.as_mut_ptr(), problem.as_ptr(), enabled) };
        self.refused(status)
    }

    /// The settings.
    pub fn settings(&self) -> Settings {
        Settings::from_raw(&self.raw_settings())
    }

    /// New settings; the analysis and the results stay.
    pub fn set_settings(&mut self, settings: &Settings) -> Result<()> {
        self.set_raw_settings(&settings.raw())
    }

    /// Gives memory back that is not needed for what is lent.
    pub fn trim(&mut self) -> Result<()> {
        // SAFETY: a live handle.
        let status = unsafe { sys::mlcp_solver_trim(self.as_mut_ptr()) };
        self.refused(status)
    }

    /// From now on every solve that is not solved leaves a snapshot in `folder`, which must be there: `failure-0000.mlcp` and so on, never over
    /// another one, until `limit` of them are there. `None`: no longer. A new solver begins with the folder in the environment variable
    /// `MLCP_FAILURES`, if set. A file that cannot be written is no failure of the solve.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// # use mlcp::{Problem, Recording, Row, Solver};
    /// let mut problem = Problem::new()?;
    /// problem.add_body(1, &[2.0])?;
    /// problem.add_row(&Row::unilateral(&[0], &[1.0]).r(1.0))?;
    /// problem.add_row(&Row::unilateral(&[0], &[-1.0]).r(1.0))?; // squeezed between walls
    /// let folder = std::env::temp_dir().join(format!("mlcp-failures-{}", std::process::id()));
    /// std::fs::create_dir(&folder).expect("a new folder");
    ///
    /// let mut solver = Solver::new()?;
    /// solver.keep_failures(Some(&folder), 10)?;
    /// let report = solver.solve(&problem)?;
    /// let file = solver.failure_file().expect("the solve failed");
    /// assert_eq!(Recording::load(file)?.replay()?.outcome, report.outcome);
    /// # std::fs::remove_dir_all(&folder).expect("our own folder");
    /// # Ok(()) }
    /// ```
    pub fn keep_failures(&mut self, folder: Option<&Path>, limit: usize) -> Result<()> {
        let (folder, limit) = (folder.map(c_path).transpose()?, int("limit", limit)?);
        let folder = folder.as_ref().map_or(null(), |folder| folder.as_ptr());
        // SAFETY: a live handle, and NULL or a string that ends with 0.
        let status = unsafe { sys::mlcp_solver_keep_failures(self.as_mut_ptr(), folder, limit) };
        self.refused(status)
    }

    /// The snapshot that the last solve left because it was not solved.
    pub fn failure_file(&self) -> Option<PathBuf> {
        // SAFETY: a live handle, whose text stays until the next solve.
        let file = unsafe { text_of(sys::mlcp_solver_failure_file(self.as_ptr())) };
        (!file.is_empty()).then(|| file.into())
    }

    /// v, n numbers, m/s or rad/s; prescribed bodies have their given velocity.
    pub fn velocities(&self) -> Result<&[f64]> {
        self.lend(sys::mlcp_solver_velocities)
    }

    /// γ, m numbers, N·s; 0 for disabled rows.
    pub fn impulses(&self) -> Result<&[f64]> {
        self.lend(sys::mlcp_solver_impulses)
    }

    /// w, m numbers, m/s.
    pub fn slacks(&self) -> Result<&[f64]> {
        self.lend(sys::mlcp_solver_slacks)
    }

    /// States and keys of the rows at the end: the start of the next step.
    pub fn mask(&self) -> Result<&MaskRef> {
        let mut mask = null();
        // SAFETY: a live handle and a place for the pointer.
        check(unsafe { sys::mlcp_solver_mask(self.as_ptr(), &mut mask) })?;
        // SAFETY: lent until the solver is used again, for which it must not be borrowed.
        unsafe { MaskRef::new(mask) }
    }

    /// For every row whether it was found dependent on active ones and therefore not factored. None is looked for in an island that a limit of
    /// work or time or the progress callback stopped.
    pub fn redundant(&self) -> Result<impl ExactSizeIterator<Item = bool> + '_> {
        Ok(self.lend(sys::mlcp_solver_redundant)?.iter().map(|&redundant| redundant != 0))
    }

    /// For every row its island, `None` for disabled rows.
    pub fn row_islands(&self) -> Result<impl ExactSizeIterator<Item = Option<usize>> + '_> {
        Ok(self.lend(sys::mlcp_solver_row_islands)?.iter().map(|&island| crate::numbers::index(island)))
    }

    /// How each island ended.
    pub fn island_outcomes(&self) -> Result<impl ExactSizeIterator<Item = Outcome> + '_> {
        Ok(self.lend(sys::mlcp_solver_island_outcomes)?.iter().map(|&outcome| Outcome::from_raw(outcome)))
    }

    /// What each contact did in the last solve, in order of adding.
    pub fn contact_states(&self) -> Result<impl ExactSizeIterator<Item = ContactState> + '_> {
        Ok(self.lend(sys::mlcp_solver_contact_states)?.iter().map(|&state| ContactState::from_raw(state)))
    }

    /// How many generators of each contact's cone were tried, in order of adding; 0 where it has no cone.
    pub fn contact_facets(&self) -> Result<&[i32]> {
        self.lend(sys::mlcp_solver_contact_facets)
    }

    /// Why an island is infeasible, `None` for the first one that is. [`Error::State`] when there is no certificate.
    pub fn certificate(&self, island: Option<usize>) -> Result<Certificate<'_>> {
        let island = island.map_or(Ok(-1), |island| int("island", island))?;
        let (mut rows, mut y, mut length) = (null(), null(), 0);
        // SAFETY: a live handle and places for what is lent until the solver is used again.
        unsafe {
            check(sys::mlcp_solver_certificate(self.as_ptr(), island, &mut rows, &mut y, &mut length))?;
            Ok(Certificate { rows: lent(rows, count(length)), y: lent(y, count(length)) })
        }
    }

    /// The steps of the last solve; empty where [`Settings::trace`] is not set.
    pub fn trace(&self) -> Result<&[Pivot]> {
        let (mut pivots, mut length) = (null(), 0);
        // SAFETY: a live handle and places for what is lent until the solver is used again; `Pivot` has the layout of what it wraps.
        unsafe {
            check(sys::mlcp_solver_trace(self.as_ptr(), &mut pivots, &mut length))?;
            Ok(lent(pivots.cast(), usize::try_from(length).unwrap_or(0)))
        }
    }

    /// Copies v in single precision.
    pub fn read_velocities_f32<'a>(&self, to: impl Into<StridedMut<'a, f32>>) -> Result<()> {
        self.read_f32(to.into(), sys::mlcp_solver_read_velocities_f32)
    }

    /// Copies γ in single precision.
    pub fn read_impulses_f32<'a>(&self, to: impl Into<StridedMut<'a, f32>>) -> Result<()> {
        self.read_f32(to.into(), sys::mlcp_solver_read_impulses_f32)
    }

    /// The impulse that a prescribed body needs to keep its velocity, `M v − k − Jᵀγ` on its velocities, N·s. `problem` is the one solved
    /// last; `reaction` has one number for each velocity of the body.
    pub fn read_reaction(&self, problem: &Problem, body: Body, reaction: &mut [f64]) -> Result<()> {
        let numbers = int("the length of reaction", reaction.len())?;
        // SAFETY: live handles and room for that many numbers.
        check(unsafe { sys::mlcp_solver_reaction(self.as_ptr(), problem.as_ptr(), body.id(), numbers, reaction.as_mut_ptr()) })
    }

    pub(crate) fn as_ptr(&self) -> *const sys::mlcp_solver {
        self.raw.as_ptr()
    }

    pub(crate) fn as_mut_ptr(&mut self) -> *mut sys::mlcp_solver {
        self.raw.as_ptr()
    }

    /// The status of a call that leaves its text in the solver.
    pub(crate) fn refused(&self, status: sys::mlcp_status) -> Result<()> {
        // SAFETY: a live handle, whose text stays until the next call.
        check_with(status, || unsafe { text_of(sys::mlcp_solver_error(self.as_ptr())) })
    }

    /// Makes the library call these callbacks from now on, until others are installed. Costs nothing where there were none and are none.
    pub(crate) fn install(&mut self, callbacks: &mut Callbacks<'_>) -> Result<()> {
        if self.has_callbacks || !callbacks.is_empty() {
            let mut raw = self.raw_settings();
            callbacks.install(&mut raw);
            self.set_raw_settings(&raw)?;
            self.has_callbacks = !callbacks.is_empty();
        }
        Ok(())
    }

    fn raw_settings(&self) -> sys::mlcp_settings {
        let mut raw = crate::settings::default_raw();
        // SAFETY: a live handle and a struct that says its size. The call cannot fail then.
        let _ = unsafe { sys::mlcp_solver_get_settings(self.as_ptr(), &mut raw) };
        raw
    }

    fn set_raw_settings(&mut self, raw: &sys::mlcp_settings) -> Result<()> {
        // SAFETY: a live handle, and settings that the library copies.
        let status = unsafe { sys::mlcp_solver_set_settings(self.as_mut_ptr(), raw) };
        self.refused(status)
    }

    fn lend<T>(&self, get: Getter<T>) -> Result<&[T]> {
        let (mut data, mut length) = (null(), 0);
        // SAFETY: a live handle and places for what is lent until the solver is used again, for which it must not be borrowed.
        unsafe {
            check(get(self.as_ptr(), &mut data, &mut length))?;
            Ok(lent(data, count(length)))
        }
    }

    fn read_f32(
        &self,
        mut to: StridedMut<'_, f32>,
        read: unsafe extern "C" fn(*const sys::mlcp_solver, i32, *mut f32, isize) -> sys::mlcp_status,
    ) -> Result<()> {
        let length = int("the length", to.len())?;
        // SAFETY: a live handle and that many places of a stride.
        check(unsafe { read(self.as_ptr(), length, to.as_mut_ptr(), to.stride()) })
    }
}

/// Why an island is infeasible (Farkas): rows that conflict and their multipliers y, with Jᵀy = 0 and Σy = 0 on dynamic velocities to 1e-12
/// relative, y > 0 only where `hi` is infinite, y < 0 only where `lo` is, and rᵀy > 0 after prescribed velocities and fixed
/// impulses have moved into r.
#[derive(Clone, Copy, Debug)]
pub struct Certificate<'a> {
    /// Rows that conflict.
    pub rows: &'a [i32],
    /// Their multipliers.
    pub y: &'a [f64],
}
