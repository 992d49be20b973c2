//! What the library cannot check of a bulk call, because a C array does not know its length.
use crate::body::Body;
use crate::error::{Error, Result};
use crate::numbers::check_length;
use crate::strided::{Blocks, Layout, Strided};

/// An array's name, and how many values it has how many bytes apart; `None` where it is not given.
pub(crate) type Extent<'a> = (&'a str, Option<(usize, usize)>);

pub(crate) fn extent<'a, T>((name, array): (&'a str, Option<Strided<'_, T>>)) -> Extent<'a> {
    (name, array.map(|array| (array.len(), array.stride())))
}

/// The stride of arrays that have to share one, each with `count` values; 0: packed.
pub(crate) fn common_stride<const N: usize>(count: usize, arrays: [Extent<'_>; N]) -> Result<isize> {
    let mut common: Option<(&str, usize)> = None;
    for (name, array) in arrays {
        let Some((length, own)) = array else { continue };
        check_length(name, length, count)?;
        match common {
            Some((other, stride)) if stride != own && count > 1 => {
                return Err(Error::Argument(format!("{name} has a stride of {own} bytes, but {other} one of {stride}")));
            }
            _ => common = Some((name, own)),
        }
    }
    Ok(common.map_or(0, |(_, stride)| stride as isize)) // no struct is larger than isize
}

/// No block of `blocks` is shorter than what its body needs. Without blocks the library refuses any body but the world. The names are those of the
/// array and of what has a block each; `needed`: numbers of a block, by body.
pub(crate) fn check_blocks<T>(
    (name, item): (&str, &str),
    blocks: Option<Blocks<'_, T>>,
    bodies: Option<Strided<'_, Body>>,
    needed: impl Fn(Body) -> usize,
) -> Result<()> {
    let (Some(blocks), Some(bodies)) = (blocks, bodies) else { return Ok(()) };
    match blocks.layout() {
        Layout::Packed { numbers } => check_length(name, numbers, bodies.iter().map(|&body| needed(body)).sum()),
        Layout::Strided { len, width, .. } => {
            check_length(name, len, bodies.len())?;
            match bodies.iter().enumerate().find(|&(_, &body)| needed(body) > width) {
                None => Ok(()),
                Some((i, &body)) => Err(Error::Range(format!(
                    "{name} has blocks of {width} numbers, but body {} of {item} {i} needs {}",
                    body.id(),
                    needed(body)
                ))),
            }
        }
    }
}

/// `count` blocks of exactly, or in structs at least, `size` numbers; returns the bytes between them, for [`common_stride`].
pub(crate) fn vectors<'a, T>((name, blocks): (&'a str, Option<Blocks<'_, T>>), count: usize, size: usize) -> Result<Extent<'a>> {
    let Some(blocks) = blocks else { return Ok((name, None)) };
    match blocks.layout() {
        Layout::Packed { numbers } => {
            check_length(name, numbers, count.saturating_mul(size))?;
            Ok((name, Some((count, size.saturating_mul(size_of::<T>())))))
        }
        Layout::Strided { width, .. } if width < size => {
            Err(Error::Range(format!("{name} has blocks of {width} numbers, but {size} are needed")))
        }
        Layout::Strided { len, stride, .. } => Ok((name, Some((len, stride)))),
    }
}
