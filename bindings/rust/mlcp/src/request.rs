//! One solve with all that can be said about it.
use std::mem::MaybeUninit;
use std::ops::ControlFlow;
use std::ptr::{null, null_mut};

use crate::callbacks::{Callbacks, Progress, Run};
use crate::error::{Result, check};
use crate::mask::MaskRef;
use crate::problem::Problem;
use crate::report::Report;
use crate::solver::Solver;

/// A solve to be run, from [`Solver::request`].
#[must_use = "a request does nothing until it is run"]
#[allow(missing_debug_implementations)] // closures have none
pub struct Request<'a> {
    solver: &'a mut Solver,
    problem: &'a Problem,
    enabled: Option<&'a MaskRef>,
    start: Start<'a>,
    callbacks: Callbacks<'a>,
}

enum Start<'a> {
    Default,
    From(&'a MaskRef),
    Last,
}

impl<'a> Request<'a> {
    pub(crate) fn new(solver: &'a mut Solver, problem: &'a Problem) -> Self {
        Request { solver, problem, enabled: None, start: Start::Default, callbacks: Callbacks::default() }
    }

    /// Leaves the rows out that are [`DISABLED`](crate::RowState::DISABLED) in this mask. Without it all rows count.
    pub fn enabled(self, mask: &'a MaskRef) -> Self {
        Request { enabled: Some(mask), ..self }
    }

    /// The active set to start from, as the mask of the last step carried over; any will do. Without it: what
    /// [`Settings::warm_start`](crate::Settings::warm_start) finds by the keys of the rows, else bilateral rows only.
    pub fn start(self, mask: &'a MaskRef) -> Self {
        Request { start: Start::From(mask), ..self }
    }

    /// Starts from the mask with which the solver's last solve ended, whatever the keys; the rows must still be as many. The first solve
    /// starts as without it.
    pub fn start_from_last(self) -> Self {
        Request { start: Start::Last, ..self }
    }

    /// Calls back now and then on this thread; `Break` ends the solve as [`Interrupted`](crate::Outcome::Interrupted). A panic in it ends the
    /// solve too and goes on then.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use std::ops::ControlFlow;
    /// # use mlcp::{Outcome, Problem, Solver};
    /// # let (problem, mut solver) = (Problem::new()?, Solver::new()?);
    /// let mut calls = 0;
    /// let report = solver
    ///     .request(&problem)
    ///     .progress(&mut |progress| {
    ///         calls += 1;
    ///         if progress.pivots > 10_000 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    ///     })
    ///     .run()?;
    /// assert_eq!(report.outcome, Outcome::Solved);
    /// # Ok(()) }
    /// ```
    pub fn progress(mut self, call: &'a mut dyn FnMut(&Progress) -> ControlFlow<()>) -> Self {
        self.callbacks.progress.call = Some(call);
        self
    }

    /// Solves islands on threads of the caller instead of the library's. `run` gets the work as a function and calls it on as many threads as
    /// there are, at the same time, or on fewer: each call takes islands until none is left. What is left when `run` returns is done
    /// on this thread. The answer does not depend on any of that. A panic in `run` goes on after the solve.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// # let (problem, mut solver) = (mlcp::Problem::new()?, mlcp::Solver::new()?);
    /// let report = solver
    ///     .request(&problem)
    ///     .parallel(&mut |work| {
    ///         std::thread::scope(|scope| {
    ///             scope.spawn(work);
    ///             work();
    ///         })
    ///     })
    ///     .run()?;
    /// assert!(report.is_solved());
    /// # Ok(()) }
    /// ```
    pub fn parallel(mut self, run: &'a mut dyn FnMut(&(dyn Fn() + Sync))) -> Self {
        self.callbacks.parallel.run = Some(Run::Caller(run));
        self
    }

    #[cfg(feature = "rayon")]
    pub(crate) fn parallel_by(mut self, run: fn(&(dyn Fn() + Sync))) -> Self {
        self.callbacks.parallel.run = Some(Run::Pool(run));
        self
    }

    /// Solves. An error means that the call could not be made; how the solve ended is in the report.
    pub fn run(self) -> Result<Report> {
        let Request { solver, problem, enabled, start, mut callbacks } = self;
        let enabled = enabled.map_or(null(), MaskRef::as_ptr);
        let start = match start {
            Start::Default => null(),
            Start::From(mask) => mask.as_ptr(),
            Start::Last => solver.last_mask(),
        };
        solver.install(&mut callbacks)?;
        let mut report = MaybeUninit::uninit();
        let raw = solver.as_mut_ptr();
        // SAFETY: the init function fills the struct, every field; then live handles, masks that outlive the call, and callbacks that do
        // not move during it.
        let (status, report) = unsafe {
            sys::mlcp_report_init(report.as_mut_ptr(), size_of_val(&report));
            (sys::mlcp_solve(raw, problem.as_ptr(), enabled, start, report.as_mut_ptr()), report.assume_init())
        };
        let solved = solver.refused(status).map(|()| Report::from_raw(&report));
        let removed = solver.install(&mut Callbacks::default());
        callbacks.finish();
        removed.and(solved)
    }
}

impl Solver {
    /// The mask of the last solve, NULL before the first one.
    fn last_mask(&self) -> *const sys::mlcp_mask {
        let mut mask = null();
        // SAFETY: a live handle and a place for the pointer.
        match check(unsafe { sys::mlcp_solver_mask(self.as_ptr(), &mut mask) }) {
            Ok(()) => mask,
            Err(_) => null_mut(),
        }
    }
}
