//! Contacts with friction on their way in and out.
use crate::body::Body;
use crate::bulk::{check_blocks, common_stride, extent, vectors};
use crate::constants::constants;
use crate::error::Result;
use crate::numbers::check_length;
use crate::real::Real;
use crate::strided::{Blocks, Strided};

/// How a contact resists sliding. A number and no enum, so that an engine's array is read where it is.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Friction(sys::mlcp_friction);

impl Friction {
    /// Not at all; its tangent rows are left out.
    pub const NONE: Friction = Friction(sys::MLCP_FRICTION_NONE);
    /// The convex cone, or a pyramid inside it: `|γ_T| ≤ µ γ_n`, and sliding lifts (Anitescu 2006).
    pub const CONVEX: Friction = Friction(sys::MLCP_FRICTION_CONVEX);
    /// Coulomb's law.
    pub const COULOMB: Friction = Friction(sys::MLCP_FRICTION_COULOMB);
    /// Tangent impulses within fixed bounds, each for itself.
    pub const BOX: Friction = Friction(sys::MLCP_FRICTION_BOX);
    /// Tangent impulses within ± µ times the normal one, each for itself, as the findex of ODE, Bullet and DART.
    pub const FINDEX: Friction = Friction(sys::MLCP_FRICTION_FINDEX);

    pub(crate) fn from_raw(raw: sys::mlcp_friction) -> Self {
        Friction(raw)
    }
}

impl std::fmt::Debug for Friction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Friction::NONE => f.write_str("NONE"),
            Friction::CONVEX => f.write_str("CONVEX"),
            Friction::COULOMB => f.write_str("COULOMB"),
            Friction::BOX => f.write_str("BOX"),
            Friction::FINDEX => f.write_str("FINDEX"),
            Friction(other) => write!(f, "Friction({other})"),
        }
    }
}

constants! {
    /// What a contact does.
    ContactState, sys::mlcp_contact_state {
        /// Its normal row is left out.
        Disabled = MLCP_CONTACT_DISABLED,
        /// No impulse.
        Open = MLCP_CONTACT_OPEN,
        /// It holds, and does not slide.
        Sticking = MLCP_CONTACT_STICKING,
        /// It slides, with the impulse at the limit of friction.
        Sliding = MLCP_CONTACT_SLIDING,
    }
}

/// A contact over rows that are there: its normal row and, right behind it, its tangent rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The normal row.
    pub row: usize,
    /// Rows: 2 in the plane, 3 in space.
    pub dimension: usize,
    /// How it resists sliding.
    pub friction: Friction,
    /// The coefficient of friction, at least 0.
    pub mu: f64,
    /// Facets of the pyramid; 0: the setting's, or the circular cone.
    pub facets: usize,
}

/// Contacts between bodies and all their rows, added in one call by [`Problem::add_contacts`](crate::Problem::add_contacts): all or
/// nothing. Arrays stay where they are, in slices or in the structs of an engine ([`strided!`](crate::strided)), in double or in
/// single precision.
///
/// What is not given is the default: against the world, `r` = 0, no compliance, µ = 0, Coulomb's law on the circular cone, no key.
#[must_use = "contacts do nothing until they are added"]
#[derive(Clone, Copy, Debug)]
pub struct Contacts<'a, T: Real = f64> {
    count: usize,
    dimension: usize,
    pub(crate) body_a: Option<Strided<'a, Body>>,
    pub(crate) body_b: Option<Strided<'a, Body>>,
    pub(crate) jacobian_a: Option<Blocks<'a, T>>,
    pub(crate) jacobian_b: Option<Blocks<'a, T>>,
    pub(crate) r: Option<Blocks<'a, T>>,
    pub(crate) compliance: Option<Blocks<'a, T>>,
    pub(crate) mu: Option<Strided<'a, T>>,
    pub(crate) bound: Option<Strided<'a, T>>,
    pub(crate) model: Option<Strided<'a, Friction>>,
    pub(crate) facets: Option<Strided<'a, i32>>,
    pub(crate) key: Option<Strided<'a, u64>>,
}

impl<'a, T: Real> Contacts<'a, T> {
    /// That many contacts in the plane: a normal and a tangent row each. Every array that is given has one entry a contact.
    pub fn planar(count: usize) -> Self {
        Self::new(count, 2)
    }

    /// That many contacts in space: a normal and two tangent rows each. Every array that is given has one entry a contact.
    pub fn spatial(count: usize) -> Self {
        Self::new(count, 3)
    }

    fn new(count: usize, dimension: usize) -> Self {
        Contacts {
            count,
            dimension,
            body_a: None,
            body_b: None,
            jacobian_a: None,
            jacobian_b: None,
            r: None,
            compliance: None,
            mu: None,
            bound: None,
            model: None,
            facets: None,
            key: None,
        }
    }

    /// The first body of every contact.
    pub fn body_a(self, ids: impl Into<Strided<'a, Body>>) -> Self {
        Contacts { body_a: Some(ids.into()), ..self }
    }

    /// The second body of every contact, another one than the first unless both are the world. `body_a` and `body_b` have one stride.
    pub fn body_b(self, ids: impl Into<Strided<'a, Body>>) -> Self {
        Contacts { body_b: Some(ids.into()), ..self }
    }

    /// The blocks of J that belong to the first bodies: for each contact the normal row, then the tangent rows, each with as many numbers as
    /// the body has velocities.
    pub fn jacobian_a(self, blocks: impl Into<Blocks<'a, T>>) -> Self {
        Contacts { jacobian_a: Some(blocks.into()), ..self }
    }

    /// The blocks of J that belong to the second bodies.
    pub fn jacobian_b(self, blocks: impl Into<Blocks<'a, T>>) -> Self {
        Contacts { jacobian_b: Some(blocks.into()), ..self }
    }

    /// The right-hand sides, m/s: one number for each row of a contact. `r` and `compliance` have one stride.
    pub fn r(self, blocks: impl Into<Blocks<'a, T>>) -> Self {
        Contacts { r: Some(blocks.into()), ..self }
    }

    /// The diagonal of Σ, m/(N·s): one number for each row of a contact.
    pub fn compliance(self, blocks: impl Into<Blocks<'a, T>>) -> Self {
        Contacts { compliance: Some(blocks.into()), ..self }
    }

    /// The coefficients of friction, at least 0. `mu` and `bound` have one stride.
    pub fn mu(self, values: impl Into<Strided<'a, T>>) -> Self {
        Contacts { mu: Some(values.into()), ..self }
    }

    /// The bounds of the tangent impulses of [`Friction::BOX`], N·s; default ∞.
    pub fn bound(self, values: impl Into<Strided<'a, T>>) -> Self {
        Contacts { bound: Some(values.into()), ..self }
    }

    /// How each contact resists sliding. `model` and `facets` have one stride.
    pub fn model(self, models: impl Into<Strided<'a, Friction>>) -> Self {
        Contacts { model: Some(models.into()), ..self }
    }

    /// Facets of the pyramids in space; 0: the setting's, or the circular cone; else at least 3.
    pub fn facets(self, facets: impl Into<Strided<'a, i32>>) -> Self {
        Contacts { facets: Some(facets.into()), ..self }
    }

    /// The identities of the contacts over time steps, taken by all their rows; 0 for none.
    pub fn key(self, keys: impl Into<Strided<'a, u64>>) -> Self {
        Contacts { key: Some(keys.into()), ..self }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    pub(crate) fn dimension(&self) -> usize {
        self.dimension
    }

    /// Everything that the library cannot check, as for [`Rows`](crate::Rows).
    pub(crate) fn check(&self, dimension: impl Fn(Body) -> usize) -> Result<ContactStrides> {
        let (count, rows) = (self.count, self.dimension);
        let of_rows = [vectors(("r", self.r), count, rows)?, vectors(("compliance", self.compliance), count, rows)?];
        let strides = ContactStrides {
            body: common_stride(count, [("body_a", self.body_a), ("body_b", self.body_b)].map(extent))?,
            vector: common_stride(count, of_rows)?,
            value: common_stride(count, [("mu", self.mu), ("bound", self.bound)].map(extent))?,
            choice: common_stride(count, [extent(("model", self.model)), extent(("facets", self.facets))])?,
            key: common_stride(count, [extent(("key", self.key))])?,
        };
        let needed = |body| rows * dimension(body);
        check_blocks(("jacobian_a", "contact"), self.jacobian_a, self.body_a, needed)?;
        check_blocks(("jacobian_b", "contact"), self.jacobian_b, self.body_b, needed)?;
        Ok(strides)
    }
}

/// Bytes between the values of a kind; 0: packed.
pub(crate) struct ContactStrides {
    pub(crate) body: isize,
    pub(crate) vector: isize,
    pub(crate) value: isize,
    pub(crate) choice: isize,
    pub(crate) key: isize,
}

/// New friction of contacts that are there, one entry a contact; `None` leaves what there is.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrictionFields<'a> {
    /// How each contact resists sliding.
    pub model: Option<&'a [Friction]>,
    /// Coefficients of friction, at least 0.
    pub mu: Option<&'a [f64]>,
    /// Bounds of the tangent impulses of [`Friction::BOX`], N·s.
    pub bound: Option<&'a [f64]>,
    /// Facets of the pyramids.
    pub facets: Option<&'a [i32]>,
}

impl FrictionFields<'_> {
    /// The number of contacts: the length of the arrays, which they share.
    pub(crate) fn count(&self) -> Result<usize> {
        let lengths = [
            ("model", self.model.map(<[_]>::len)),
            ("mu", self.mu.map(<[_]>::len)),
            ("bound", self.bound.map(<[_]>::len)),
            ("facets", self.facets.map(<[_]>::len)),
        ];
        let count = lengths.iter().find_map(|&(_, length)| length).unwrap_or(0);
        for (name, length) in lengths {
            check_length(name, length.unwrap_or(count), count)?;
        }
        Ok(count)
    }
}
