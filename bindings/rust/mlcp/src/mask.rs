//! States of rows.
use std::cell::UnsafeCell;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;
use std::ptr::{NonNull, null_mut};

use crate::error::{Error, Result, check, check_with, text_of};
use crate::library::check_abi;
use crate::memory::ALLOCATOR;
use crate::numbers::{count, int, lent};
use crate::problem::Problem;

/// The state of a row. A number and no enum, so that the library's array can be lent as it is.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct RowState(sys::mlcp_row_state);

impl RowState {
    /// Not part of the problem: costs nothing, constrains nothing, impulse 0.
    pub const DISABLED: RowState = RowState(sys::MLCP_ROW_DISABLED);
    /// The impulse is at `lo`; for a contact: open.
    pub const AT_LOWER: RowState = RowState(sys::MLCP_ROW_AT_LOWER);
    /// w = 0, and the impulse is between the bounds.
    pub const ACTIVE: RowState = RowState(sys::MLCP_ROW_ACTIVE);
    /// The impulse is at `hi`.
    pub const AT_UPPER: RowState = RowState(sys::MLCP_ROW_AT_UPPER);

    pub(crate) fn from_raw(raw: sys::mlcp_row_state) -> Self {
        RowState(raw)
    }
}

impl fmt::Debug for RowState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            RowState::DISABLED => f.write_str("DISABLED"),
            RowState::AT_LOWER => f.write_str("AT_LOWER"),
            RowState::ACTIVE => f.write_str("ACTIVE"),
            RowState::AT_UPPER => f.write_str("AT_UPPER"),
            RowState(other) => write!(f, "RowState({other})"),
        }
    }
}

/// A mask that somebody lends, usually a [`Solver`](crate::Solver): one state a row, and the keys of the rows it was made for and
/// impulses where it has them. It is to [`Mask`] what `str` is to `String`.
pub struct MaskRef {
    // only ever behind a pointer to what the library owns
    _opaque: PhantomData<UnsafeCell<sys::mlcp_mask>>,
}

// SAFETY: any number of threads may read one mask.
unsafe impl Sync for MaskRef {}

impl MaskRef {
    /// # Safety
    /// `raw` is a live mask that nobody changes during `'a`.
    pub(crate) unsafe fn new<'a>(raw: *const sys::mlcp_mask) -> Result<&'a MaskRef> {
        // SAFETY: as promised by the caller.
        unsafe { raw.cast::<MaskRef>().as_ref() }.ok_or_else(|| Error::Internal("no mask was lent".into()))
    }

    pub(crate) fn as_ptr(&self) -> *const sys::mlcp_mask {
        std::ptr::from_ref(self).cast()
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        // SAFETY: a live mask.
        count(unsafe { sys::mlcp_mask_size(self.as_ptr()) })
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The states of all rows.
    pub fn states(&self) -> &[RowState] {
        // SAFETY: as many states as rows, of the layout of their number, unchanged while the mask is borrowed.
        unsafe { lent(sys::mlcp_mask_states(self.as_ptr()).cast(), self.len()) }
    }

    /// How many rows are in `state`.
    pub fn count(&self, state: RowState) -> usize {
        // SAFETY: a live mask.
        count(unsafe { sys::mlcp_mask_count(self.as_ptr(), state.0) })
    }

    /// Copies the impulses, N·s, from row `first` on. A mask that a solve returns has them; [`Error::State`] where there are none.
    pub fn read_impulses(&self, first: usize, impulses: &mut [f64]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of impulses", impulses.len())?);
        // SAFETY: a live mask and room for that many numbers.
        check(unsafe { sys::mlcp_mask_get_impulses(self.as_ptr(), first, rows, impulses.as_mut_ptr()) })
    }

    /// A deep copy, keys and impulses included.
    pub fn try_clone(&self) -> Result<Mask> {
        let mut raw = null_mut();
        // SAFETY: a live mask and a place for the new one; the library copies the hooks.
        check(unsafe { sys::mlcp_mask_clone(&ALLOCATOR, self.as_ptr(), &mut raw) })?;
        // SAFETY: just made.
        unsafe { Mask::adopt(raw) }
    }
}

/// The same states in the same order; keys and impulses do not matter.
impl PartialEq for MaskRef {
    fn eq(&self, other: &Self) -> bool {
        // SAFETY: live masks.
        unsafe { sys::mlcp_mask_equal(self.as_ptr(), other.as_ptr()) != 0 }
    }
}
impl Eq for MaskRef {}

impl fmt::Debug for MaskRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.states()).finish()
    }
}

/// A mask of one's own: which rows are enabled, or the active set to start from.
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// use mlcp::{Mask, RowState};
///
/// let mut enabled = Mask::new(3, RowState::ACTIVE)?;
/// enabled.set(1, &[RowState::DISABLED])?;
/// assert_eq!(enabled.states(), [RowState::ACTIVE, RowState::DISABLED, RowState::ACTIVE]);
/// assert_eq!(enabled.count(RowState::ACTIVE), 2);
/// # Ok(()) }
/// ```
pub struct Mask {
    raw: NonNull<sys::mlcp_mask>,
}

// SAFETY: a mask belongs to no thread, its memory neither.
unsafe impl Send for Mask {}
// SAFETY: any number of threads may read one mask; what changes it needs &mut.
unsafe impl Sync for Mask {}

impl Drop for Mask {
    fn drop(&mut self) {
        // SAFETY: made by the library, and nobody has it any more.
        unsafe { sys::mlcp_mask_destroy(self.raw.as_ptr()) }
    }
}

impl Deref for Mask {
    type Target = MaskRef;

    fn deref(&self) -> &MaskRef {
        // SAFETY: a live mask, which cannot change while `self` is borrowed.
        unsafe { self.raw.cast().as_ref() }
    }
}

impl fmt::Debug for Mask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

impl PartialEq for Mask {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}
impl Eq for Mask {}

impl Mask {
    /// A mask of that many rows, all in `state`, without keys.
    pub fn new(rows: usize, state: RowState) -> Result<Mask> {
        check_abi()?;
        let (rows, mut raw) = (int("rows", rows)?, null_mut());
        // SAFETY: a place for the handle; the library copies the hooks.
        check(unsafe { sys::mlcp_mask_create(&ALLOCATOR, rows, state.0, &mut raw) })?;
        // SAFETY: just made.
        unsafe { Self::adopt(raw) }
    }

    /// A mask with these states, without keys.
    pub fn from_states(states: &[RowState]) -> Result<Mask> {
        let mut mask = Mask::new(states.len(), RowState::DISABLED)?;
        mask.set(0, states)?;
        Ok(mask)
    }

    /// # Safety
    /// The library made the handle with hooks that any thread can call, and nobody else has it.
    pub(crate) unsafe fn adopt(raw: *mut sys::mlcp_mask) -> Result<Mask> {
        let raw = NonNull::new(raw).ok_or_else(|| Error::Internal("no mask was made".into()))?;
        Ok(Mask { raw })
    }

    /// Makes the mask `rows` long; new rows get `state` and no key.
    pub fn resize(&mut self, rows: usize, state: RowState) -> Result<()> {
        let rows = int("rows", rows)?;
        // SAFETY: a live mask.
        self.edit(|raw| unsafe { sys::mlcp_mask_resize(raw, rows, state.0) })
    }

    /// New states from row `first` on.
    pub fn set(&mut self, first: usize, states: &[RowState]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of states", states.len())?);
        // SAFETY: that many states, of the layout of their number.
        self.edit(|raw| unsafe { sys::mlcp_mask_set(raw, first, rows, states.as_ptr().cast()) })
    }

    /// The impulses, N·s, that go with the states from row `first` on: where an iterative method starts. Other rows get 0 if the mask had none.
    pub fn set_impulses(&mut self, first: usize, impulses: &[f64]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of impulses", impulses.len())?);
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_mask_set_impulses(raw, first, rows, impulses.as_ptr()) })
    }

    /// Takes the keys of the problem's rows; the sizes must match.
    pub fn take_keys(&mut self, problem: &Problem) -> Result<()> {
        // SAFETY: live handles.
        self.edit(|raw| unsafe { sys::mlcp_mask_take_keys(raw, problem.as_ptr()) })
    }

    /// Becomes the mask of `problem`: each row has the state and the impulse that the row with its key had in `previous`, or `otherwise` and
    /// 0 when the key is new or none. Equal keys match in order of adding. Expected O(m).
    pub fn carry(&mut self, problem: &Problem, previous: &MaskRef, otherwise: RowState) -> Result<()> {
        // SAFETY: live handles; `previous` is another mask, because this one is borrowed mutably.
        self.edit(|raw| unsafe { sys::mlcp_mask_carry(raw, problem.as_ptr(), previous.as_ptr(), otherwise.0) })
    }

    fn edit(&mut self, call: impl FnOnce(*mut sys::mlcp_mask) -> sys::mlcp_status) -> Result<()> {
        let raw = self.raw.as_ptr();
        // SAFETY: a live handle, whose text stays until the next call.
        check_with(call(raw), || unsafe { text_of(sys::mlcp_mask_error(raw)) })
    }
}
