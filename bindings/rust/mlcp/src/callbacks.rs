//! What the library calls back during a solve. A panic must not cross the library: it is caught here, the solve stops, and the panic goes
//! on when the library has returned.
use std::any::Any;
use std::ffi::c_void;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicI32, AtomicU64, Ordering};
use std::time::Duration;

use crate::numbers::count;
use crate::report::seconds;

/// How far a solve is.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Since the solve began.
    pub time: Duration,
    /// Steps so far.
    pub pivots: i64,
    /// Entries touched so far.
    pub work: i64,
    /// The island being solved.
    pub island: usize,
    /// How many there are.
    pub islands: usize,
    /// Largest violation in this island, relative as in the report.
    pub violation: f64,
}

impl Progress {
    fn from_raw(raw: &sys::mlcp_progress) -> Self {
        Progress {
            time: seconds(raw.seconds),
            pivots: raw.pivots,
            work: raw.work,
            island: count(raw.island),
            islands: count(raw.islands),
            violation: raw.violation,
        }
    }
}

/// The callbacks of one solve. They have to stay where they are until [`Callbacks::finish`].
#[derive(Default)]
pub(crate) struct Callbacks<'a> {
    pub(crate) progress: OnProgress<'a>,
    pub(crate) parallel: ParallelFor<'a>,
}

#[derive(Default)]
pub(crate) struct OnProgress<'a> {
    pub(crate) call: Option<ProgressCall<'a>>,
    panic: Option<Panic>,
}

#[derive(Default)]
pub(crate) struct ParallelFor<'a> {
    pub(crate) run: Option<Run<'a>>,
    panic: Option<Panic>,
}

/// Who brings the threads.
pub(crate) enum Run<'a> {
    Caller(ParallelRun<'a>),
    #[cfg(feature = "rayon")]
    Pool(fn(&(dyn Fn() + Sync))),
}

impl Run<'_> {
    fn call(&mut self, work: &(dyn Fn() + Sync)) {
        match self {
            Run::Caller(run) => run(work),
            #[cfg(feature = "rayon")]
            Run::Pool(run) => run(work),
        }
    }
}

/// `Break` stops the solve.
type ProgressCall<'a> = &'a mut dyn FnMut(&Progress) -> ControlFlow<()>;
/// Calls what it is given on as many threads as it likes.
type ParallelRun<'a> = &'a mut dyn FnMut(&(dyn Fn() + Sync));
type Panic = Box<dyn Any + Send>;

impl Callbacks<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.progress.call.is_none() && self.parallel.run.is_none()
    }

    /// Makes `settings` call these callbacks and no others. They must not be used in any other way before the solve has ended. Each has a
    /// context of its own, because progress is told from inside of parallel work too.
    pub(crate) fn install(&mut self, settings: &mut sys::mlcp_settings) {
        settings.progress = self.progress.call.is_some().then_some(on_progress);
        settings.progress_context = std::ptr::from_mut(&mut self.progress).cast();
        settings.parallel_for = self.parallel.run.is_some().then_some(parallel_for);
        settings.parallel_context = std::ptr::from_mut(&mut self.parallel).cast();
    }

    /// Goes on with a panic that a callback began.
    pub(crate) fn finish(self) {
        if let Some(panic) = self.progress.panic.or(self.parallel.panic) {
            resume_unwind(panic);
        }
    }
}

unsafe extern "C" fn on_progress(context: *mut c_void, progress: *const sys::mlcp_progress) -> i32 {
    const GO_ON: i32 = 0;
    const STOP: i32 = 1;
    // SAFETY: the context that `install` gave, which only this function uses now, on the thread that solves.
    let hook = unsafe { &mut *context.cast::<OnProgress<'_>>() };
    // SAFETY: the library lends it during the call.
    let progress = Progress::from_raw(unsafe { &*progress });
    let (Some(call), None) = (hook.call.as_mut(), &hook.panic) else { return STOP };
    match catch_unwind(AssertUnwindSafe(|| call(&progress))) {
        Ok(ControlFlow::Continue(())) => GO_ON,
        Ok(ControlFlow::Break(())) => STOP,
        Err(panic) => {
            hook.panic = Some(panic);
            STOP
        }
    }
}

/// The tasks of one parallel loop. Each index is taken once, whatever the threads do.
struct Tasks {
    task: unsafe extern "C" fn(*mut c_void, i32, i32),
    data: *mut c_void,
    count: i32,
    next: AtomicU64,
    workers: AtomicI32,
}

// SAFETY: the library lets any thread call its task.
unsafe impl Sync for Tasks {}

impl Tasks {
    /// Takes tasks until none is left. A thread is a worker of its own, with a number that no other has.
    fn work(&self) {
        let worker = self.workers.fetch_add(1, Ordering::Relaxed);
        loop {
            let next = i32::try_from(self.next.fetch_add(1, Ordering::Relaxed));
            let Some(index) = next.ok().filter(|&index| index < self.count) else { return };
            // SAFETY: the library's task with its data, once for each index.
            unsafe { (self.task)(self.data, index, worker) }
        }
    }
}

unsafe extern "C" fn parallel_for(context: *mut c_void, count: i32, task: sys::mlcp_task, data: *mut c_void) {
    // SAFETY: the context that `install` gave, which only this function uses now, on the thread that solves.
    let hook = unsafe { &mut *context.cast::<ParallelFor<'_>>() };
    let Some(task) = task else { return };
    let tasks = Tasks { task, data, count, next: AtomicU64::new(0), workers: AtomicI32::new(0) };
    if let (Some(run), None) = (hook.run.as_mut(), &hook.panic) {
        hook.panic = catch_unwind(AssertUnwindSafe(|| run.call(&|| tasks.work()))).err();
    }
    // what `run` left; nobody works any more, because `tasks` was only lent
    tasks.work();
}
