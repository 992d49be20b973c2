//! Constraint rows on their way in and out.
use std::mem::MaybeUninit;

use crate::body::Body;
use crate::error::{Error, Result};
use crate::numbers::{check_length, int};
use crate::strided::{Blocks, Layout, Strided};

/// Rows between bodies, added in one call by [`Problem::add_rows`](crate::Problem::add_rows): all or nothing. Arrays stay where they
/// are, in slices or in the structs of an engine ([`strided!`](crate::strided)), in double or in single precision.
///
/// What is not given is the default: against the world, unilateral (`lo` = 0, `hi` = ∞), `r` = 0, no compliance, no key.
#[must_use = "rows do nothing until they are added"]
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, T: Real = f64> {
    count: usize,
    body_a: Option<Strided<'a, Body>>,
    body_b: Option<Strided<'a, Body>>,
    jacobian_a: Option<Blocks<'a, T>>,
    jacobian_b: Option<Blocks<'a, T>>,
    r: Option<Strided<'a, T>>,
    lo: Option<Strided<'a, T>>,
    hi: Option<Strided<'a, T>>,
    compliance: Option<Strided<'a, T>>,
    key: Option<Strided<'a, u64>>,
}

impl<'a, T: Real> Rows<'a, T> {
    /// That many rows. Every array that is given has one entry a row.
    pub fn new(count: usize) -> Self {
        Rows {
            count,
            body_a: None,
            body_b: None,
            jacobian_a: None,
            jacobian_b: None,
            r: None,
            lo: None,
            hi: None,
            compliance: None,
            key: None,
        }
    }

    /// The first body of every row.
    pub fn body_a(self, ids: impl Into<Strided<'a, Body>>) -> Self {
        Rows { body_a: Some(ids.into()), ..self }
    }

    /// The second body of every row, another one than the first unless both are the world. `body_a` and `body_b` have one stride.
    pub fn body_b(self, ids: impl Into<Strided<'a, Body>>) -> Self {
        Rows { body_b: Some(ids.into()), ..self }
    }

    /// The blocks of J that belong to the first bodies: as many numbers a row as the body has velocities.
    pub fn jacobian_a(self, blocks: impl Into<Blocks<'a, T>>) -> Self {
        Rows { jacobian_a: Some(blocks.into()), ..self }
    }

    /// The blocks of J that belong to the second bodies.
    pub fn jacobian_b(self, blocks: impl Into<Blocks<'a, T>>) -> Self {
        Rows { jacobian_b: Some(blocks.into()), ..self }
    }

    /// The right-hand sides, m/s. `r`, `lo`, `hi` and `compliance` have one stride.
    pub fn r(self, values: impl Into<Strided<'a, T>>) -> Self {
        Rows { r: Some(values.into()), ..self }
    }

    /// The lower bounds of the impulses, N·s; −∞ is legal.
    pub fn lo(self, values: impl Into<Strided<'a, T>>) -> Self {
        Rows { lo: Some(values.into()), ..self }
    }

    /// The upper bounds of the impulses, N·s; ∞ is legal.
    pub fn hi(self, values: impl Into<Strided<'a, T>>) -> Self {
        Rows { hi: Some(values.into()), ..self }
    }

    /// The diagonal of Σ, m/(N·s).
    pub fn compliance(self, values: impl Into<Strided<'a, T>>) -> Self {
        Rows { compliance: Some(values.into()), ..self }
    }

    /// The identities of the rows over time steps, 0 for none.
    pub fn key(self, keys: impl Into<Strided<'a, u64>>) -> Self {
        Rows { key: Some(keys.into()), ..self }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Everything that the library cannot check, because a C array does not know its length. `dimension`: of a body, 0 for one that
    /// there is not; the library refuses such a row before it reads its block.
    pub(crate) fn check(&self, dimension: impl Fn(Body) -> usize) -> Result<Strides> {
        let body = common_stride(self.count, [("body_a", self.body_a), ("body_b", self.body_b)])?;
        let value =
            common_stride(self.count, [("r", self.r), ("lo", self.lo), ("hi", self.hi), ("compliance", self.compliance)])?;
        let key = common_stride(self.count, [("key", self.key)])?;
        check_blocks("jacobian_a", self.jacobian_a, self.body_a, &dimension)?;
        check_blocks("jacobian_b", self.jacobian_b, self.body_b, &dimension)?;
        Ok(Strides { body, value, key })
    }
}

/// Bytes between the values of a kind; 0: packed.
pub(crate) struct Strides {
    body: isize,
    value: isize,
    key: isize,
}

/// The stride of arrays that have to share one, each with `count` values.
fn common_stride<T, const N: usize>(count: usize, arrays: [(&str, Option<Strided<'_, T>>); N]) -> Result<isize> {
    let mut common: Option<(&str, usize)> = None;
    for (name, array) in arrays {
        let Some(array) = array else { continue };
        check_length(name, array.len(), count)?;
        match common {
            Some((other, stride)) if stride != array.stride() && count > 1 => {
                let own = array.stride();
                return Err(Error::Argument(format!("{name} has a stride of {own} bytes, but {other} one of {stride}")));
            }
            _ => common = Some((name, array.stride())),
        }
    }
    Ok(common.map_or(0, |(_, stride)| stride as isize)) // no struct is larger than isize
}

/// No block of `blocks` is shorter than its body's dimension. Without blocks the library refuses any body but the world.
fn check_blocks<T>(
    name: &str,
    blocks: Option<Blocks<'_, T>>,
    bodies: Option<Strided<'_, Body>>,
    dimension: impl Fn(Body) -> usize,
) -> Result<()> {
    let (Some(blocks), Some(bodies)) = (blocks, bodies) else { return Ok(()) };
    match blocks.layout() {
        Layout::Packed { numbers } => check_length(name, numbers, bodies.iter().map(|&body| dimension(body)).sum()),
        Layout::Strided { len, width, .. } => {
            check_length(name, len, bodies.len())?;
            match bodies.iter().enumerate().find(|&(_, &body)| dimension(body) > width) {
                None => Ok(()),
                Some((i, &body)) => Err(Error::Range(format!(
                    "{name} has blocks of {width} numbers, but body {} of row {i} needs {}",
                    body.id(),
                    dimension(body)
                ))),
            }
        }
    }
}

/// The precision of rows: `f64` or `f32`.
pub trait Real: sealed::Real {}
impl Real for f64 {}
impl Real for f32 {}

pub(crate) mod sealed {
    use super::{Rows, Strides};

    pub trait Real: Copy + Sized {
        /// # Safety
        /// `problem` is a live handle that nothing else uses, and `strides` are what `rows` were checked to have.
        #[allow(private_interfaces)] // nobody outside can call it
        unsafe fn add_rows(
            problem: *mut sys::mlcp_problem,
            count: i32,
            rows: &Rows<'_, Self>,
            strides: Strides,
            first: &mut i32,
        ) -> sys::mlcp_status
        where
            Self: super::Real;
    }
}

macro_rules! real {
    ($real:ty, $init:ident, $add:ident) => {
        impl sealed::Real for $real {
            #[allow(private_interfaces)]
            unsafe fn add_rows(
                problem: *mut sys::mlcp_problem,
                count: i32,
                rows: &Rows<'_, Self>,
                strides: Strides,
                first: &mut i32,
            ) -> sys::mlcp_status {
                let mut raw = MaybeUninit::uninit();
                // SAFETY: the init function fills the struct, every field.
                let mut raw = unsafe {
                    sys::$init(raw.as_mut_ptr(), size_of_val(&raw));
                    raw.assume_init()
                };
                // NULL where an array is not given
                raw.count = count;
                raw.body_a = rows.body_a.map_or(raw.body_a, |ids| ids.as_ptr().cast());
                raw.body_b = rows.body_b.map_or(raw.body_b, |ids| ids.as_ptr().cast());
                raw.jacobian_a = rows.jacobian_a.map_or(raw.jacobian_a, |blocks| blocks.as_ptr());
                raw.jacobian_b = rows.jacobian_b.map_or(raw.jacobian_b, |blocks| blocks.as_ptr());
                raw.jacobian_a_stride = rows.jacobian_a.map_or(0, |blocks| blocks.stride());
                raw.jacobian_b_stride = rows.jacobian_b.map_or(0, |blocks| blocks.stride());
                raw.r = rows.r.map_or(raw.r, |values| values.as_ptr());
                raw.lo = rows.lo.map_or(raw.lo, |values| values.as_ptr());
                raw.hi = rows.hi.map_or(raw.hi, |values| values.as_ptr());
                raw.compliance = rows.compliance.map_or(raw.compliance, |values| values.as_ptr());
                raw.key = rows.key.map_or(raw.key, |keys| keys.as_ptr());
                raw.value_stride = strides.value;
                raw.body_stride = strides.body;
                raw.key_stride = strides.key;
                // SAFETY: as promised by the caller; the arrays are as long as the library reads.
                unsafe { sys::$add(problem, &raw, first) }
            }
        }
    };
}
real!(f64, mlcp_rows_init, mlcp_problem_rows_add);
real!(f32, mlcp_rows_f32_init, mlcp_problem_rows_add_f32);

/// One row over any velocities, for [`Problem::add_row`](crate::Problem::add_row).
#[must_use = "a row does nothing until it is added"]
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    pub(crate) columns: &'a [i32],
    pub(crate) values: &'a [f64],
    pub(crate) r: f64,
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) compliance: f64,
    pub(crate) key: u64,
}

impl<'a> Row<'a> {
    /// A contact or limit: its impulse is not negative. Entry i is `values[i]` at velocity `columns[i]`.
    pub fn unilateral(columns: &'a [i32], values: &'a [f64]) -> Self {
        Row::boxed(columns, values, 0.0, f64::INFINITY)
    }

    /// A joint: its impulse has no bounds.
    pub fn bilateral(columns: &'a [i32], values: &'a [f64]) -> Self {
        Row::boxed(columns, values, f64::NEG_INFINITY, f64::INFINITY)
    }

    /// A motor or friction with fixed bounds: its impulse is between `lo` and `hi`.
    pub fn boxed(columns: &'a [i32], values: &'a [f64], lo: f64, hi: f64) -> Self {
        Row { columns, values, r: 0.0, lo, hi, compliance: 0.0, key: 0 }
    }

    /// The right-hand side, m/s.
    pub fn r(self, r: f64) -> Self {
        Row { r, ..self }
    }

    /// The diagonal entry of Σ, m/(N·s).
    pub fn compliance(self, compliance: f64) -> Self {
        Row { compliance, ..self }
    }

    /// The identity of the row over time steps, 0 for none.
    pub fn key(self, key: u64) -> Self {
        Row { key, ..self }
    }
}

/// What rows have besides their entries of J; each array with one value a row. `None`: the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct RowFields<'a> {
    /// Right-hand sides, m/s; default 0.
    pub r: Option<&'a [f64]>,
    /// Lower bounds, N·s; default 0.
    pub lo: Option<&'a [f64]>,
    /// Upper bounds, N·s; default ∞.
    pub hi: Option<&'a [f64]>,
    /// Diagonal of Σ, m/(N·s); default 0.
    pub compliance: Option<&'a [f64]>,
    /// Identities over time steps; default 0, none.
    pub key: Option<&'a [u64]>,
}

impl RowFields<'_> {
    /// Returns the number of rows on its way in.
    pub(crate) fn check(&self, count: usize) -> Result<i32> {
        for (name, array) in [("r", self.r), ("lo", self.lo), ("hi", self.hi), ("compliance", self.compliance)] {
            check_length(name, array.map_or(count, <[f64]>::len), count)?;
        }
        check_length("key", self.key.map_or(count, <[u64]>::len), count)?;
        int("count", count)
    }
}

/// Where [`Problem::read_rows`](crate::Problem::read_rows) puts the values of all rows; `None`: not wanted.
#[derive(Debug, Default)]
pub struct RowFieldsMut<'a> {
    /// Right-hand sides, m/s.
    pub r: Option<&'a mut [f64]>,
    /// Lower bounds, N·s.
    pub lo: Option<&'a mut [f64]>,
    /// Upper bounds, N·s.
    pub hi: Option<&'a mut [f64]>,
    /// Diagonal of Σ, m/(N·s).
    pub compliance: Option<&'a mut [f64]>,
    /// Identities over time steps.
    pub key: Option<&'a mut [u64]>,
}

impl RowFieldsMut<'_> {
    pub(crate) fn check(&self, count: usize) -> Result<()> {
        for (name, array) in [("r", &self.r), ("lo", &self.lo), ("hi", &self.hi), ("compliance", &self.compliance)] {
            check_length(name, array.as_ref().map_or(count, |array| array.len()), count)?;
        }
        check_length("key", self.key.as_ref().map_or(count, |array| array.len()), count)
    }
}
