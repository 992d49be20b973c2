//! What a call refuses and why.
use std::ffi::{CStr, c_char};
use std::fmt;

/// The result of a call that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a call was refused. It changed nothing then. The texts are the library's own and name the argument and the index.
///
/// How a solve ended is no error but an [`Outcome`](crate::Outcome), in the [`Report`](crate::Report).
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// An array that is needed was left out.
    Missing(String),
    /// A value is not legal: NaN, `lo > hi`, an asymmetric matrix.
    Argument(String),
    /// An index is out of range, or a length does not match.
    Range(String),
    /// The call does not fit the state of the object, as results before a solve.
    State(String),
    /// The global allocator has no more memory.
    OutOfMemory,
    /// A file cannot be opened, read or written.
    Io(String),
    /// A snapshot is damaged or from an unknown version.
    Format(String),
    /// Legal, but the library that is loaded or the method cannot do it.
    Unsupported(String),
    /// A defect of the library: please report it with a snapshot.
    Internal(String),
    /// The library that is loaded has another ABI than the one that this crate was built for.
    Abi {
        /// The number of the library.
        library: i32,
        /// The number that this crate needs.
        needed: i32,
    },
    /// A status that only a newer library knows.
    Unknown {
        /// Its number.
        status: i32,
        /// The library's text.
        text: String,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Missing(text) => write!(f, "missing argument: {text}"),
            Error::Argument(text) => write!(f, "bad argument: {text}"),
            Error::Range(text) => write!(f, "out of range: {text}"),
            Error::State(text) => write!(f, "wrong state: {text}"),
            Error::OutOfMemory => f.write_str("out of memory"),
            Error::Io(text) => write!(f, "input or output: {text}"),
            Error::Format(text) => write!(f, "bad format: {text}"),
            Error::Unsupported(text) => write!(f, "not supported: {text}"),
            Error::Internal(text) => write!(f, "a defect of libmlcp: {text}"),
            Error::Abi { library, needed } => write!(f, "libmlcp has ABI {library}, but {needed} is needed"),
            Error::Unknown { status, text } => write!(f, "status {status}: {text}"),
        }
    }
}

impl std::error::Error for Error {}

impl Error {
    /// `text`: of the last failure of the object, "" where there is none.
    #[cold]
    fn from_status(status: sys::mlcp_status, text: String) -> Error {
        // SAFETY: the library answers any number with a string of static storage.
        let text = if text.is_empty() { unsafe { text_of(sys::mlcp_status_text(status)) } } else { text };
        match status {
            sys::MLCP_ERROR_NULL => Error::Missing(text),
            sys::MLCP_ERROR_ARGUMENT => Error::Argument(text),
            sys::MLCP_ERROR_RANGE => Error::Range(text),
            sys::MLCP_ERROR_STATE => Error::State(text),
            sys::MLCP_ERROR_OUT_OF_MEMORY => Error::OutOfMemory,
            sys::MLCP_ERROR_IO => Error::Io(text),
            sys::MLCP_ERROR_FORMAT => Error::Format(text),
            sys::MLCP_ERROR_UNSUPPORTED => Error::Unsupported(text),
            sys::MLCP_ERROR_INTERNAL => Error::Internal(text),
            _ => Error::Unknown { status, text },
        }
    }
}

/// A status as a result; `text` is asked only on failure.
pub(crate) fn check_with(status: sys::mlcp_status, text: impl FnOnce() -> String) -> Result<()> {
    if status == sys::MLCP_OK { Ok(()) } else { Err(Error::from_status(status, text())) }
}

/// The status of a call that leaves no text.
pub(crate) fn check(status: sys::mlcp_status) -> Result<()> {
    check_with(status, String::new)
}

/// # Safety
/// `text` is NULL or points to a string that ends with 0.
pub(crate) unsafe fn text_of(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: as promised by the caller.
    unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
}
