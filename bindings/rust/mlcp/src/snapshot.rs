//! Saving a solve and doing it again.
use std::ffi::{CStr, CString, c_char};
use std::path::Path;
use std::ptr::{null, null_mut};

use crate::error::{Error, Result, check_with};
use crate::library::check_abi;
use crate::mask::{Mask, MaskRef};
use crate::memory::ALLOCATOR;
use crate::problem::Problem;
use crate::report::Report;
use crate::solver::Solver;

/// What is needed to do a solve again, to be saved: it replays to the same bits with the same build.
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// use mlcp::{Problem, Recording, Snapshot};
///
/// let mut problem = Problem::new()?;
/// problem.add_body(1, &[2.0])?;
/// let bytes = Snapshot::new(&problem).to_bytes()?;
/// let mut recording = Recording::from_bytes(&bytes)?;
/// assert!(recording.replay()?.is_solved());
/// # Ok(()) }
/// ```
#[must_use = "a snapshot does nothing until it is saved"]
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    problem: &'a Problem,
    solver: Option<&'a Solver>,
    enabled: Option<&'a MaskRef>,
    start: Option<&'a MaskRef>,
}

impl<'a> Snapshot<'a> {
    /// A problem with the default settings and without masks.
    pub fn new(problem: &'a Problem) -> Self {
        Snapshot { problem, solver: None, enabled: None, start: None }
    }

    /// Adds settings and ordering.
    pub fn solver(self, solver: &'a Solver) -> Self {
        Snapshot { solver: Some(solver), ..self }
    }

    /// Adds the mask of enabled rows.
    pub fn enabled(self, mask: &'a MaskRef) -> Self {
        Snapshot { enabled: Some(mask), ..self }
    }

    /// Adds the active set to start from.
    pub fn start(self, mask: &'a MaskRef) -> Self {
        Snapshot { start: Some(mask), ..self }
    }

    /// Writes a file, beside the old one and renamed, so that a full disk leaves that as it was.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = c_path(path.as_ref())?;
        let (problem, solver, enabled, start) = self.handles();
        // SAFETY: a string that ends with 0, live handles, and a buffer of the size that is said.
        told(|text, size| unsafe { sys::mlcp_snapshot_save(path.as_ptr(), problem, solver, enabled, start, text, size) })
    }

    /// The same as bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let (problem, solver, enabled, start) = self.handles();
        let mut bytes = Vec::<u8>::with_capacity(1 << 16);
        loop {
            let capacity = bytes.capacity();
            let (buffer, mut needed) = (bytes.as_mut_ptr().cast(), 0);
            // SAFETY: live handles, a buffer of `capacity` bytes, and a buffer for the text of the size that is said.
            let written = told(|text, size| unsafe {
                sys::mlcp_snapshot_write(problem, solver, enabled, start, capacity, buffer, &mut needed, text, size)
            });
            match written {
                // too little room: there is enough the next time
                Err(Error::Range(_)) if needed > capacity => bytes.reserve_exact(needed),
                Err(error) => return Err(error),
                Ok(()) => {
                    // SAFETY: the library has written `needed` bytes, no more than there was room for.
                    unsafe { bytes.set_len(needed) };
                    return Ok(bytes);
                }
            }
        }
    }

    fn handles(&self) -> (*const sys::mlcp_problem, *const sys::mlcp_solver, *const sys::mlcp_mask, *const sys::mlcp_mask) {
        (
            self.problem.as_ptr(),
            self.solver.map_or(null(), Solver::as_ptr),
            self.enabled.map_or(null(), MaskRef::as_ptr),
            self.start.map_or(null(), MaskRef::as_ptr),
        )
    }
}

/// What was saved. Files are not trusted: all of it is validated as if it were added by calls.
#[derive(Debug)]
pub struct Recording {
    /// The problem.
    pub problem: Problem,
    /// A solver with the settings and the ordering.
    pub solver: Solver,
    /// Which rows are enabled, where that was saved.
    pub enabled: Option<Mask>,
    /// The active set to start from, where that was saved.
    pub start: Option<Mask>,
}

/// What the library makes of a file or of bytes.
struct Made {
    problem: *mut sys::mlcp_problem,
    solver: *mut sys::mlcp_solver,
    enabled: *mut sys::mlcp_mask,
    start: *mut sys::mlcp_mask,
}

impl Recording {
    /// Reads a file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = c_path(path.as_ref())?;
        // SAFETY: a string that ends with 0, places for the handles, and a buffer of the size that is said; the hooks are copied.
        Self::make(|made, text, size| unsafe {
            let Made { problem, solver, enabled, start } = made;
            sys::mlcp_snapshot_load(path.as_ptr(), &ALLOCATOR, problem, solver, enabled, start, text, size)
        })
    }

    /// Reads bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let (first, length) = (bytes.as_ptr().cast(), bytes.len());
        // SAFETY: that many bytes, places for the handles, and a buffer of the size that is said; the hooks are copied.
        Self::make(|made, text, size| unsafe {
            let Made { problem, solver, enabled, start } = made;
            sys::mlcp_snapshot_read(first, length, &ALLOCATOR, problem, solver, enabled, start, text, size)
        })
    }

    /// Does the solve again.
    pub fn replay(&mut self) -> Result<Report> {
        let mut request = self.solver.request(&self.problem);
        if let Some(enabled) = &self.enabled {
            request = request.enabled(enabled);
        }
        if let Some(start) = &self.start {
            request = request.start(start);
        }
        request.run()
    }

    fn make(read: impl FnOnce(&mut Made, *mut c_char, usize) -> sys::mlcp_status) -> Result<Self> {
        check_abi()?;
        let mut made = Made { problem: null_mut(), solver: null_mut(), enabled: null_mut(), start: null_mut() };
        told(|text, size| read(&mut made, text, size))?;
        // SAFETY: just made, with hooks that any thread can call. Whoever has taken over a handle gives it back when another one is missing.
        let (problem, solver, enabled, start) = unsafe {
            (Problem::adopt(made.problem), Solver::adopt(made.solver), adopt_mask(made.enabled), adopt_mask(made.start))
        };
        Ok(Recording { problem: problem?, solver: solver?, enabled: enabled?, start: start? })
    }
}

/// # Safety
/// As for [`Mask::adopt`], or NULL.
unsafe fn adopt_mask(raw: *mut sys::mlcp_mask) -> Result<Option<Mask>> {
    // SAFETY: as promised by the caller.
    if raw.is_null() { Ok(None) } else { unsafe { Mask::adopt(raw) }.map(Some) }
}

/// A call that gives its text to the caller, whole in 512 bytes.
fn told(call: impl FnOnce(*mut c_char, usize) -> sys::mlcp_status) -> Result<()> {
    let mut text = [0u8; 512];
    let status = call(text.as_mut_ptr().cast(), text.len());
    check_with(status, || CStr::from_bytes_until_nul(&text).unwrap_or_default().to_string_lossy().into_owned())
}

pub(crate) fn c_path(path: &Path) -> Result<CString> {
    #[cfg(unix)]
    let bytes = Some(std::os::unix::ffi::OsStrExt::as_bytes(path.as_os_str()));
    #[cfg(not(unix))]
    let bytes = path.to_str().map(str::as_bytes);
    let bytes = bytes.ok_or_else(|| Error::Argument(format!("path = {} is not Unicode", path.display())))?;
    CString::new(bytes).map_err(|_| Error::Argument(format!("path = {} holds a zero byte", path.display())))
}
