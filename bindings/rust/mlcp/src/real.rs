//! Bulk calls in both precisions.
use std::mem::MaybeUninit;

use crate::contacts::{ContactStrides, Contacts};
use crate::rows::{Rows, Strides};

/// The precision of what is added in bulk: `f64` or `f32`.
pub trait Real: sealed::Real {}
impl Real for f64 {}
impl Real for f32 {}

pub(crate) mod sealed {
    use super::{ContactStrides, Contacts, Rows, Strides};

    #[allow(private_interfaces)] // nobody outside can call these
    pub trait Real: Copy + Sized {
        /// # Safety
        /// `problem` is a live handle that nothing else uses, and `strides` are what `rows` were checked to have.
        unsafe fn add_rows(
            problem: *mut sys::mlcp_problem,
            count: i32,
            rows: &Rows<'_, Self>,
            strides: Strides,
            first: &mut i32,
        ) -> sys::mlcp_status
        where
            Self: super::Real;

        /// # Safety
        /// `problem` is a live handle that nothing else uses, and `strides` are what `contacts` were checked to have.
        unsafe fn add_contacts(
            problem: *mut sys::mlcp_problem,
            count: i32,
            dimension: i32,
            contacts: &Contacts<'_, Self>,
            strides: ContactStrides,
            first: &mut i32,
        ) -> sys::mlcp_status
        where
            Self: super::Real;
    }
}

/// Fills a struct of `mlcp.h` by its init function, every field; arrays are NULL then.
macro_rules! initialised {
    ($init:ident) => {{
        let mut raw = MaybeUninit::uninit();
        // SAFETY: the init function fills the struct, every field.
        unsafe {
            sys::$init(raw.as_mut_ptr(), size_of_val(&raw));
            raw.assume_init()
        }
    }};
}

/// Points the fields of a struct of `mlcp.h` at the arrays that are given; the others stay NULL.
macro_rules! point {
    ($raw:ident at $from:ident: $($field:ident),+) => {
        $($raw.$field = $from.$field.map_or($raw.$field, |array| array.as_ptr().cast());)+
    };
}

macro_rules! real {
    ($real:ty, $rows_init:ident, $rows_add:ident, $contacts_init:ident, $contacts_add:ident) => {
        #[allow(private_interfaces)]
        impl sealed::Real for $real {
            unsafe fn add_rows(
                problem: *mut sys::mlcp_problem,
                count: i32,
                rows: &Rows<'_, Self>,
                strides: Strides,
                first: &mut i32,
            ) -> sys::mlcp_status {
                let mut raw = initialised!($rows_init);
                raw.count = count;
                point!(raw at rows: body_a, body_b, jacobian_a, jacobian_b, r, lo, hi, compliance, key);
                raw.jacobian_a_stride = rows.jacobian_a.map_or(0, |blocks| blocks.stride());
                raw.jacobian_b_stride = rows.jacobian_b.map_or(0, |blocks| blocks.stride());
                raw.value_stride = strides.value;
                raw.body_stride = strides.body;
                raw.key_stride = strides.key;
                // SAFETY: as promised by the caller; the arrays are as long as the library reads.
                unsafe { sys::$rows_add(problem, &raw, first) }
            }

            unsafe fn add_contacts(
                problem: *mut sys::mlcp_problem,
                count: i32,
                dimension: i32,
                contacts: &Contacts<'_, Self>,
                strides: ContactStrides,
                first: &mut i32,
            ) -> sys::mlcp_status {
                let mut raw = initialised!($contacts_init);
                raw.count = count;
                raw.dimension = dimension;
                point!(raw at contacts: body_a, body_b, jacobian_a, jacobian_b, r, compliance, mu, bound, model, facets, key);
                raw.jacobian_a_stride = contacts.jacobian_a.map_or(0, |blocks| blocks.stride());
                raw.jacobian_b_stride = contacts.jacobian_b.map_or(0, |blocks| blocks.stride());
                raw.vector_stride = strides.vector;
                raw.value_stride = strides.value;
                raw.choice_stride = strides.choice;
                raw.body_stride = strides.body;
                raw.key_stride = strides.key;
                // SAFETY: as promised by the caller; the arrays are as long as the library reads.
                unsafe { sys::$contacts_add(problem, &raw, first) }
            }
        }
    };
}
real!(f64, mlcp_rows_init, mlcp_problem_rows_add, mlcp_contacts_init, mlcp_problem_contacts_add);
real!(f32, mlcp_rows_f32_init, mlcp_problem_rows_add_f32, mlcp_contacts_f32_init, mlcp_problem_contacts_add_f32);
