//! The library's memory comes from Rust's global allocator.
use std::alloc::{Layout, alloc, dealloc, realloc};
use std::ffi::c_void;
use std::ptr::null_mut;

/// As malloc aligns.
const ALIGNMENT: usize = 16;

pub(crate) const ALLOCATOR: sys::mlcp_allocator =
    sys::mlcp_allocator { context: null_mut(), reallocate: Some(reallocate), release: Some(release) };

/// A block of size 0 is one of a byte, because the global allocator knows no empty ones.
fn layout(size: usize) -> Option<Layout> {
    Layout::from_size_align(size.max(1), ALIGNMENT).ok()
}

unsafe extern "C" fn reallocate(_: *mut c_void, block: *mut c_void, old_size: usize, new_size: usize) -> *mut c_void {
    let (Some(old), Some(new)) = (layout(old_size), layout(new_size)) else { return null_mut() };
    if block.is_null() {
        // SAFETY: no layout of ours is empty.
        return unsafe { alloc(new) }.cast();
    }
    // SAFETY: the library gives back a block of ours with the size that it has; `new` is a valid layout.
    unsafe { realloc(block.cast(), old, new.size()) }.cast()
}

unsafe extern "C" fn release(_: *mut c_void, block: *mut c_void, size: usize) {
    if let (false, Some(layout)) = (block.is_null(), layout(size)) {
        // SAFETY: the library gives back a block of ours with the size that it has.
        unsafe { dealloc(block.cast(), layout) }
    }
}
