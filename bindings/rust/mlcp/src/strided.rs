//! Arrays inside the structs of an engine, read and written where they are.
use std::marker::PhantomData;

/// Values of one type, a fixed number of bytes apart: a slice, or one field of every struct of a slice ([`strided!`](crate::strided)).
#[derive(Debug)]
pub struct Strided<'a, T> {
    first: *const T,
    len: usize,
    stride: usize,
    lent: PhantomData<&'a [T]>,
}

// not derived: a view can be copied whatever T is
impl<T> Clone for Strided<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Strided<'_, T> {}

impl<'a, T> Strided<'a, T> {
    /// What [`strided!`](crate::strided) calls.
    ///
    /// # Safety
    /// A `T` stands `offset` bytes behind the begin of every `S`.
    #[doc(hidden)]
    pub unsafe fn field<S>(of: &'a [S], offset: usize, _: fn(*const S) -> *const T) -> Self {
        // SAFETY: the offset of a field is within its struct; that of an empty slice is not read.
        let first = unsafe { of.as_ptr().cast::<u8>().add(if of.is_empty() { 0 } else { offset }) }.cast();
        Strided { first, len: of.len(), stride: size_of::<S>(), lent: PhantomData }
    }

    /// How many values there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The values in order.
    pub fn iter(self) -> impl ExactSizeIterator<Item = &'a T> {
        // SAFETY: value i is i · stride bytes behind the first one, inside what is borrowed.
        (0..self.len).map(move |i| unsafe { &*self.first.cast::<u8>().add(i * self.stride).cast() })
    }

    pub(crate) fn as_ptr(&self) -> *const T {
        self.first
    }

    /// Bytes from one value to the next. A stride of 0, of structs without size, never comes with a `T` that has one.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }
}

impl<'a, T> From<&'a [T]> for Strided<'a, T> {
    fn from(values: &'a [T]) -> Self {
        Strided { first: values.as_ptr(), len: values.len(), stride: size_of::<T>(), lent: PhantomData }
    }
}

impl<'a, T, const N: usize> From<&'a [T; N]> for Strided<'a, T> {
    fn from(values: &'a [T; N]) -> Self {
        values.as_slice().into()
    }
}

impl<'a, T> From<&'a Vec<T>> for Strided<'a, T> {
    fn from(values: &'a Vec<T>) -> Self {
        values.as_slice().into()
    }
}

/// Blocks of numbers, one a row or a body: packed one behind the other in a slice, where the world takes none, or in arrays of one size
/// a fixed number of bytes apart (`Strided::from(&blocks)`, or [`strided!`](crate::strided)), where the world's is not read.
#[derive(Debug)]
pub struct Blocks<'a, T> {
    first: *const T,
    layout: Layout,
    lent: PhantomData<&'a [T]>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Layout {
    /// That many numbers one behind the other.
    Packed { numbers: usize },
    /// `len` blocks of `width` numbers, `stride` bytes apart.
    Strided { len: usize, width: usize, stride: usize },
}

impl<T> Clone for Blocks<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Blocks<'_, T> {}

impl<T> Blocks<'_, T> {
    pub(crate) fn as_ptr(&self) -> *const T {
        self.first
    }

    pub(crate) fn layout(&self) -> Layout {
        self.layout
    }

    /// What the library calls the stride: 0 where the blocks are packed.
    pub(crate) fn stride(&self) -> isize {
        match self.layout {
            Layout::Packed { .. } => 0,
            Layout::Strided { stride, .. } => stride as isize, // no struct is larger than isize
        }
    }
}

impl<'a, T> From<&'a [T]> for Blocks<'a, T> {
    fn from(numbers: &'a [T]) -> Self {
        Blocks { first: numbers.as_ptr(), layout: Layout::Packed { numbers: numbers.len() }, lent: PhantomData }
    }
}

impl<'a, T, const N: usize> From<&'a [T; N]> for Blocks<'a, T> {
    fn from(numbers: &'a [T; N]) -> Self {
        numbers.as_slice().into()
    }
}

impl<'a, T> From<&'a Vec<T>> for Blocks<'a, T> {
    fn from(numbers: &'a Vec<T>) -> Self {
        numbers.as_slice().into()
    }
}

impl<'a, T, const N: usize> From<Strided<'a, [T; N]>> for Blocks<'a, T> {
    fn from(blocks: Strided<'a, [T; N]>) -> Self {
        let layout = Layout::Strided { len: blocks.len, width: N, stride: blocks.stride };
        Blocks { first: blocks.first.cast(), layout, lent: PhantomData }
    }
}

/// Values of one type to be written, a fixed number of bytes apart ([`strided_mut!`](crate::strided_mut)).
#[derive(Debug)]
pub struct StridedMut<'a, T> {
    first: *mut T,
    len: usize,
    stride: usize,
    lent: PhantomData<&'a mut [T]>,
}

impl<'a, T> StridedMut<'a, T> {
    /// What [`strided_mut!`](crate::strided_mut) calls.
    ///
    /// # Safety
    /// A `T` stands `offset` bytes behind the begin of every `S`.
    #[doc(hidden)]
    pub unsafe fn field<S>(of: &'a mut [S], offset: usize, _: fn(*mut S) -> *mut T) -> Self {
        let len = of.len();
        // SAFETY: the offset of a field is within its struct; that of an empty slice is not written.
        let first = unsafe { of.as_mut_ptr().cast::<u8>().add(if len == 0 { 0 } else { offset }) }.cast();
        StridedMut { first, len, stride: size_of::<S>(), lent: PhantomData }
    }

    /// How many values there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    pub(crate) fn as_mut_ptr(&mut self) -> *mut T {
        self.first
    }

    pub(crate) fn stride(&self) -> isize {
        self.stride as isize // no struct is larger than isize
    }
}

impl<'a, T> From<&'a mut [T]> for StridedMut<'a, T> {
    fn from(values: &'a mut [T]) -> Self {
        StridedMut { first: values.as_mut_ptr(), len: values.len(), stride: size_of::<T>(), lent: PhantomData }
    }
}

/// One field of every struct of a slice, as a [`Strided`]: nothing is copied.
///
/// ```
/// struct Contact { normal: [f64; 6], gap: f64 }
/// let contacts = [Contact { normal: [0.0; 6], gap: 0.1 }, Contact { normal: [1.0; 6], gap: 0.2 }];
/// let gaps = mlcp::strided!(&contacts, Contact, gap);
/// assert!(gaps.iter().eq(&[0.1, 0.2]));
/// assert_eq!(mlcp::strided!(&contacts, Contact, normal).len(), 2);
/// ```
#[macro_export]
macro_rules! strided {
    ($slice:expr, $type:ty, $field:ident) => {{
        let slice: &[$type] = $slice;
        // SAFETY: the offset is that of the field. The function ties T to its type: pointers, unlike references, are not dereferenced to
        // fit. It is never called.
        unsafe { $crate::Strided::field(slice, ::core::mem::offset_of!($type, $field), |whole| &raw const (*whole).$field) }
    }};
}

/// One field of every struct of a slice, as a [`StridedMut`].
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// #[derive(Clone, Default)]
/// struct Velocity { value: f32, frame: u32 }
/// let mut problem = mlcp::Problem::new()?;
/// problem.add_body(1, &[2.0])?;
/// problem.set_momentum(0, &[3.0])?;
/// let mut solver = mlcp::Solver::new()?;
/// solver.solve(&problem)?;
/// let mut velocities = vec![Velocity::default(); 1];
/// solver.read_velocities_f32(mlcp::strided_mut!(&mut velocities, Velocity, value))?;
/// assert_eq!((velocities[0].value, velocities[0].frame), (1.5, 0));
/// # Ok(()) }
/// ```
#[macro_export]
macro_rules! strided_mut {
    ($slice:expr, $type:ty, $field:ident) => {{
        let slice: &mut [$type] = $slice;
        // SAFETY: as in `strided!`.
        unsafe { $crate::StridedMut::field(slice, ::core::mem::offset_of!($type, $field), |whole| &raw mut (*whole).$field) }
    }};
}
