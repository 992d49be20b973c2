//! Bodies, their masses and momenta.
use std::ops::Range;
use std::ptr::null_mut;

use super::Problem;
use crate::body::Body;
use crate::error::{Error, Result, check};
use crate::matrix::{Compressed, Triangle};
use crate::numbers::{check_length, count, int};
use crate::strided::{Blocks, Layout};

impl Problem {
    /// Adds a body of `dimension` velocities. `mass`: dense and symmetric, `dimension`² numbers; k of the body starts at 0.
    ///
    /// Refused are NaN and ∞, asymmetry, a diagonal that is not positive, and a pivot below −1e-12 of its diagonal entry.
    pub fn add_body(&mut self, dimension: usize, mass: &[f64]) -> Result<Body> {
        let mut id = [Body::WORLD];
        self.add_blocks(dimension, mass.into(), &mut id)?;
        Ok(id[0])
    }

    /// Adds as many bodies of one dimension as there are masses, as [`add_body`](Self::add_body) does for one, and returns their ids.
    pub fn add_bodies<'a>(&mut self, dimension: usize, masses: impl Into<Blocks<'a, f64>>) -> Result<Vec<Body>> {
        let masses = masses.into();
        let bodies = match masses.layout() {
            Layout::Packed { numbers } => numbers.checked_div(mass_size(dimension)?).unwrap_or(0),
            Layout::Strided { len, .. } => len,
        };
        let mut ids = vec![Body::WORLD; bodies];
        self.add_blocks(dimension, masses, &mut ids)?;
        Ok(ids)
    }

    fn add_blocks(&mut self, dimension: usize, masses: Blocks<'_, f64>, ids: &mut [Body]) -> Result<()> {
        let size = mass_size(dimension)?;
        match masses.layout() {
            Layout::Packed { numbers } => check_length("masses", numbers, size.saturating_mul(ids.len()))?,
            Layout::Strided { width, .. } => check_length("every mass", width, size)?,
        }
        let (bodies, d) = (int("count", ids.len())?, int("dimension", dimension)?);
        let first = ids.as_mut_ptr().cast();
        // SAFETY: `ids.len()` masses of d² numbers, and as many ids, which have the layout of i32.
        self.edit(|raw| unsafe { sys::mlcp_problem_bodies_add(raw, bodies, d, masses.as_ptr(), masses.stride(), first) })?;
        for &id in ids.iter() {
            self.note_dimension(id, dimension);
        }
        Ok(())
    }

    /// Adds one body whose mass is sparse, articulated or flexible: compressed columns or, as it is symmetric, rows. Whether it is
    /// definite is seen in the solve.
    pub fn add_sparse_body(&mut self, dimension: usize, mass: Compressed<'_>, triangle: Triangle) -> Result<Body> {
        mass.check(dimension)?;
        let d = int("dimension", dimension)?;
        let (pointers, indices, values) = (mass.pointers.as_ptr(), mass.indices.as_ptr(), mass.values.as_ptr());
        let mut id = 0;
        // SAFETY: d + 1 pointers and the entries that they speak of.
        self.edit(|raw| unsafe {
            sys::mlcp_problem_body_add_sparse(raw, d, pointers, indices, values, triangle.raw(), &mut id)
        })?;
        let body = Body::from_id(id);
        self.note_dimension(body, dimension);
        Ok(body)
    }

    /// A new mass: dense, or for a sparse body exactly the values in the order they were given. Nothing is analyzed again.
    pub fn set_mass(&mut self, body: Body, mass: &[f64]) -> Result<()> {
        let numbers = i64::from(int("the length of mass", mass.len())?);
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_problem_body_set_mass(raw, body.id(), mass.as_ptr(), numbers) })
    }

    /// Removes a body that no row refers to. The velocities behind it move up.
    pub fn remove_body(&mut self, body: Body) -> Result<()> {
        // SAFETY: a live handle.
        self.edit(|raw| unsafe { sys::mlcp_problem_body_remove(raw, body.id()) })?;
        self.note_dimension(body, 0);
        Ok(())
    }

    /// Where the velocities of a body stand in v and k.
    pub fn body_range(&self, body: Body) -> Result<Range<usize>> {
        let (mut offset, mut dimension) = (0, 0);
        // SAFETY: a live handle and places for both numbers.
        check(unsafe { sys::mlcp_problem_body_range(self.as_ptr(), body.id(), &mut offset, &mut dimension) })?;
        Ok(count(offset)..count(offset) + count(dimension))
    }

    /// The bodies that there are, in ascending order.
    pub fn bodies(&self) -> Result<Vec<Body>> {
        let mut ids = vec![Body::WORLD; self.body_count()];
        let (capacity, mut written) = (int("bodies", ids.len())?, 0);
        let first = if ids.is_empty() { null_mut() } else { ids.as_mut_ptr().cast() };
        // SAFETY: room for `capacity` ids, which have the layout of i32.
        check(unsafe { sys::mlcp_problem_bodies(self.as_ptr(), capacity, first, &mut written) })?;
        ids.truncate(count(written));
        Ok(ids)
    }

    /// Makes a body prescribed (static, kinematic, asleep): its velocity is given. Its columns move into the right-hand side and it
    /// joins no islands; [`Solver::read_reaction`](crate::Solver::read_reaction) tells the impulse on it.
    pub fn set_prescribed(&mut self, body: Body, velocity: &[f64]) -> Result<()> {
        let numbers = int("the length of velocity", velocity.len())?;
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_problem_body_set_prescribed(raw, body.id(), velocity.as_ptr(), numbers) })
    }

    /// Makes a body dynamic again.
    pub fn set_dynamic(&mut self, body: Body) -> Result<()> {
        // SAFETY: a live handle.
        self.edit(|raw| unsafe { sys::mlcp_problem_body_set_dynamic(raw, body.id()) })
    }

    /// The given velocity of a prescribed body, `None` for a dynamic one.
    pub fn prescribed_velocity(&self, body: Body) -> Result<Option<Vec<f64>>> {
        let mut velocity = vec![0.0; self.body_range(body)?.len()];
        let (numbers, mut prescribed) = (int("dimension", velocity.len())?, 0);
        // SAFETY: room for as many numbers as the body has velocities.
        check(unsafe {
            sys::mlcp_problem_body_state(self.as_ptr(), body.id(), &mut prescribed, numbers, velocity.as_mut_ptr())
        })?;
        Ok((prescribed != 0).then_some(velocity))
    }

    /// k, N·s, for the velocities from `first` on.
    pub fn set_momentum(&mut self, first: usize, k: &[f64]) -> Result<()> {
        let (first, numbers) = (int("first", first)?, int("the length of k", k.len())?);
        // SAFETY: that many numbers.
        self.edit(|raw| unsafe { sys::mlcp_problem_set_momentum(raw, first, numbers, k.as_ptr()) })
    }

    /// k = M v + h q for every body, equation (2.5) of the paper. `v` and `q`: n numbers, the velocities and the generalised forces,
    /// gyroscopic ones included, at the begin of the step of h > 0 seconds. Prescribed bodies keep their velocity.
    pub fn set_momentum_of_step(&mut self, h: f64, v: &[f64], q: &[f64]) -> Result<()> {
        check_length("q", q.len(), v.len())?;
        let numbers = int("the length of v", v.len())?;
        // SAFETY: that many numbers in both.
        self.edit(|raw| unsafe { sys::mlcp_timestep_momentum(raw, h, numbers, v.as_ptr(), q.as_ptr()) })
    }
}

/// Numbers in a dense mass.
fn mass_size(dimension: usize) -> Result<usize> {
    dimension.checked_mul(dimension).ok_or_else(|| Error::Range(format!("dimension = {dimension} is too large")))
}
