//! What the library calls back during a solve. A panic must not cross the library: it is caught here, the solve stops, and the panic goes
//! on when the library has returned.
use std::any::Any;
use std::ffi::c_void;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
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

/// Called now and then on the thread that solves; `Break` stops the solve.
pub(crate) type OnProgress<'a> = &'a mut dyn FnMut(&Progress) -> ControlFlow<()>;

/// The callbacks of one solve. It has to stay where it is until [`Callbacks::finish`].
#[derive(Default)]
pub(crate) struct Callbacks<'a> {
    pub(crate) progress: Option<OnProgress<'a>>,
    panic: Option<Box<dyn Any + Send>>,
}

impl Callbacks<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.progress.is_none()
    }

    /// Makes `settings` call these callbacks and no others. They must not be used in any other way before the solve has ended.
    pub(crate) fn install(&mut self, settings: &mut sys::mlcp_settings) {
        settings.progress = self.progress.is_some().then_some(on_progress);
        settings.progress_context = std::ptr::from_mut(self).cast();
    }

    /// Goes on with a panic that a callback began.
    pub(crate) fn finish(self) {
        if let Some(panic) = self.panic {
            resume_unwind(panic);
        }
    }
}

unsafe extern "C" fn on_progress(context: *mut c_void, progress: *const sys::mlcp_progress) -> i32 {
    const GO_ON: i32 = 0;
    const STOP: i32 = 1;
    // SAFETY: the context that `install` gave, which only the library uses now, on this thread.
    let callbacks = unsafe { &mut *context.cast::<Callbacks<'_>>() };
    // SAFETY: the library lends it during the call.
    let progress = Progress::from_raw(unsafe { &*progress });
    let (Some(call), None) = (callbacks.progress.as_mut(), &callbacks.panic) else { return STOP };
    match catch_unwind(AssertUnwindSafe(|| call(&progress))) {
        Ok(ControlFlow::Continue(())) => GO_ON,
        Ok(ControlFlow::Break(())) => STOP,
        Err(panic) => {
            callbacks.panic = Some(panic);
            STOP
        }
    }
}
