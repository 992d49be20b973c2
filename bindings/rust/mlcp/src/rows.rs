//! Constraint rows on their way in and out.
use crate::body::Body;
use crate::bulk::{check_blocks, common_stride, extent};
use crate::error::Result;
use crate::numbers::{check_length, int};
use crate::real::Real;
use crate::strided::{Blocks, Strided};

/// Rows between bodies, added in one call by [`Problem::add_rows`](crate::Problem::add_rows): all or nothing. Arrays stay where they
/// are, in slices or in the structs of an engine ([`strided!`](crate::strided)), in double or in single precision.
///
/// What is not given is the default: against the world, unilateral (`lo` = 0, `hi` = ∞), `r` = 0, no compliance, no key.
#[must_use = "rows do nothing until they are added"]
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, T: Real = f64> {
    count: usize,
    pub(crate) body_a: Option<Strided<'a, Body>>,
    pub(crate) body_b: Option<Strided<'a, Body>>,
    pub(crate) jacobian_a: Option<Blocks<'a, T>>,
    pub(crate) jacobian_b: Option<Blocks<'a, T>>,
    pub(crate) r: Option<Strided<'a, T>>,
    pub(crate) lo: Option<Strided<'a, T>>,
    pub(crate) hi: Option<Strided<'a, T>>,
    pub(crate) compliance: Option<Strided<'a, T>>,
    pub(crate) key: Option<Strided<'a, u64>>,
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
        let count = self.count;
        let values = [("r", self.r), ("lo", self.lo), ("hi", self.hi), ("compliance", self.compliance)];
        let strides = Strides {
            body: common_stride(count, [("body_a", self.body_a), ("body_b", self.body_b)].map(extent))?,
            value: common_stride(count, values.map(extent))?,
            key: common_stride(count, [extent(("key", self.key))])?,
        };
        check_blocks(("jacobian_a", "row"), self.jacobian_a, self.body_a, &dimension)?;
        check_blocks(("jacobian_b", "row"), self.jacobian_b, self.body_b, &dimension)?;
        Ok(strides)
    }
}

/// Bytes between the values of a kind; 0: packed.
pub(crate) struct Strides {
    pub(crate) body: isize,
    pub(crate) value: isize,
    pub(crate) key: isize,
}

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
