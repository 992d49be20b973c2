//! Ids of bodies.

/// The id of a body, stable until the body is removed; ids of removed bodies are given out again, smallest first.
///
/// Arrays of ids that an engine keeps as `i32` can be kept as `Body`: the layout is the same.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Body(i32);

impl Body {
    /// The body that never moves.
    pub const WORLD: Body = Body(sys::MLCP_WORLD);

    /// The body with this id; one that there is not is refused where it is used.
    pub const fn from_id(id: i32) -> Body {
        Body(id)
    }

    /// The id, −1 for the world.
    pub const fn id(self) -> i32 {
        self.0
    }
}
