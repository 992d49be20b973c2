//! Adding, declaring and changing contacts; bounds that follow other impulses.
use std::ops::Range;
use std::ptr::null;

use super::Problem;
use super::rows::{pointer, range};
use crate::contacts::{Contact, Contacts, Friction, FrictionFields};
use crate::error::{Result, check};
use crate::numbers::{check_length, count, int};
use crate::real::Real;

impl Problem {
    /// Adds contacts and their rows, the normal row of each first; returns the indices of the rows.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Body, ContactState, Contacts, Problem, Solver, strided};
    ///
    /// // what an engine has: a puck of 1 kg that slides, contacts with Jacobians by normal and tangent
    /// struct Touch { body: Body, jacobian: [f32; 4], mu: f32, feature: u64 }
    /// let mut problem = Problem::new()?;
    /// let puck = problem.add_body(2, &[1.0, 0.0, 0.0, 1.0])?;
    /// problem.set_momentum(0, &[0.7, -1.0])?;
    /// let touches = [Touch { body: puck, jacobian: [0.0, 1.0, 1.0, 0.0], mu: 0.5, feature: 17 }];
    ///
    /// let rows = problem.add_contacts(
    ///     &Contacts::planar(touches.len())
    ///         .body_a(strided!(&touches, Touch, body))
    ///         .jacobian_a(strided!(&touches, Touch, jacobian))
    ///         .mu(strided!(&touches, Touch, mu))
    ///         .key(strided!(&touches, Touch, feature)),
    /// )?;
    /// assert_eq!(rows, 0..2);
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// assert_eq!(solver.contact_states()?.next(), Some(ContactState::Sliding));
    /// assert!((solver.velocities()?[0] - 0.2).abs() < 1e-9);
    /// # Ok(()) }
    /// ```
    pub fn add_contacts<T: Real>(&mut self, contacts: &Contacts<'_, T>) -> Result<Range<usize>> {
        let strides = contacts.check(|body| self.dimension(body))?;
        let (added, dimension) = (int("count", contacts.count())?, int("dimension", contacts.dimension())?);
        let mut first = 0;
        // SAFETY: the arrays were checked.
        self.edit(|raw| unsafe { T::add_contacts(raw, added, dimension, contacts, strides, &mut first) })?;
        Ok(range(first, contacts.count() * contacts.dimension()))
    }

    /// Makes rows that are there into contacts, in the order given. A unilateral normal row is followed by its tangent rows, which lose their
    /// bounds to the friction. All or nothing for contacts of one dimension that stand behind each other in the list.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Contact, ContactState, Friction, Problem, Row, Solver};
    /// let mut problem = Problem::new()?;
    /// problem.add_body(2, &[1.0, 0.0, 0.0, 1.0])?;
    /// problem.set_momentum(0, &[0.3, -1.0])?; // a block pushed along a table
    /// problem.add_row(&Row::unilateral(&[1], &[1.0]))?;
    /// problem.add_row(&Row::bilateral(&[0], &[1.0]))?;
    /// problem.declare_contacts(&[Contact { row: 0, dimension: 2, friction: Friction::COULOMB, mu: 0.5, facets: 0 }])?;
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// assert_eq!(solver.contact_states()?.collect::<Vec<_>>(), [ContactState::Sticking]);
    /// problem.set_momentum(0, &[0.7, -1.0])?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// assert_eq!(solver.contact_states()?.collect::<Vec<_>>(), [ContactState::Sliding]);
    /// # Ok(()) }
    /// ```
    pub fn declare_contacts(&mut self, contacts: &[Contact]) -> Result<()> {
        for group in contacts.chunk_by(|a, b| a.dimension == b.dimension) {
            let Some(first) = group.first() else { continue };
            let dimension = int("dimension", first.dimension)?;
            let length = int("the length of contacts", group.len())?;
            let row = group.iter().map(|contact| int("row", contact.row)).collect::<Result<Vec<_>>>()?;
            let facets = group.iter().map(|contact| int("facets", contact.facets)).collect::<Result<Vec<_>>>()?;
            let model: Vec<_> = group.iter().map(|contact| contact.friction).collect();
            let mu: Vec<_> = group.iter().map(|contact| contact.mu).collect();
            // SAFETY: `length` entries in each array, models of the layout of their number; no bounds.
            self.edit(|raw| unsafe {
                let (row, model, facets) = (row.as_ptr(), model.as_ptr().cast(), facets.as_ptr());
                sys::mlcp_problem_contacts_declare(raw, length, dimension, row, model, mu.as_ptr(), null(), facets)
            })?;
        }
        Ok(())
    }

    /// New friction from contact `first` on, counted in order of adding; rows and their pattern stay.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// # use mlcp::{Contacts, Friction, FrictionFields, Problem};
    /// # let mut problem = Problem::new()?;
    /// # let body = problem.add_body(2, &[1.0, 0.0, 0.0, 1.0])?;
    /// # problem.add_contacts(&Contacts::planar(2).body_a(&[body; 2]).jacobian_a(&[0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0]))?;
    /// problem.set_friction(1, &FrictionFields { mu: Some(&[0.8]), ..Default::default() })?;
    /// let contacts = problem.contacts()?;
    /// assert_eq!((contacts[1].row, contacts[1].mu, contacts[1].friction), (2, 0.8, Friction::COULOMB));
    /// # Ok(()) }
    /// ```
    pub fn set_friction(&mut self, first: usize, friction: &FrictionFields<'_>) -> Result<()> {
        let (first, contacts) = (int("first", first)?, int("the number of contacts", friction.count()?)?);
        let (model, facets) = (pointer(friction.model).cast(), pointer(friction.facets));
        let [mu, bound] = [friction.mu, friction.bound].map(pointer);
        // SAFETY: that many values in what is not NULL, models of the layout of their number.
        self.edit(|raw| unsafe { sys::mlcp_problem_contacts_set_friction(raw, first, contacts, model, mu, bound, facets) })
    }

    /// Number of contacts.
    pub fn contact_count(&self) -> usize {
        // SAFETY: a live handle.
        count(unsafe { sys::mlcp_problem_contact_count(self.as_ptr()) })
    }

    /// The contacts, in order of adding.
    pub fn contacts(&self) -> Result<Vec<Contact>> {
        let size = self.contact_count();
        let (mut row, mut dimension, mut facets) = (vec![0; size], vec![0; size], vec![0; size]);
        let (mut model, mut mu) = (vec![0; size], vec![0.0; size]);
        // SAFETY: `size` places in each array.
        check(unsafe {
            sys::mlcp_problem_get_contacts(
                self.as_ptr(),
                int("the number of contacts", size)?,
                row.as_mut_ptr(),
                dimension.as_mut_ptr(),
                model.as_mut_ptr(),
                mu.as_mut_ptr(),
                facets.as_mut_ptr(),
            )
        })?;
        let rows = row.into_iter().zip(dimension);
        let choices = model.into_iter().zip(mu).zip(facets);
        Ok(rows
            .zip(choices)
            .map(|((row, dimension), ((model, mu), facets))| Contact {
                row: count(row),
                dimension: count(dimension),
                friction: Friction::from_raw(model),
                mu,
                facets: count(facets),
            })
            .collect())
    }

    /// The findex array of ODE, Bullet and DART, from row `first` on: where `findex[i]` ≥ 0, `lo` and `hi` of row `first + i` are factors,
    /// `lo` ≤ 0 ≤ `hi` and finite, of the impulse of row `findex[i]`: `lo γ_n ≤ γ ≤ hi γ_n`. −1: plain bounds.
    ///
    /// Refused are rows of contacts, whose [`Friction`] tells, and a `findex[i]` that is the row itself or one whose bounds follow another.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// use mlcp::{Compressed, Problem, RowFields, Solver, SparseMatrix, Triangle};
    ///
    /// // what dSolveLCP takes, A x = b + w: a normal and a tangent row with µ = 0.5
    /// let (a, b) = ([2.0, 0.5, 0.5, 2.0], [4.0, 3.0]);
    /// let (lo, hi, findex) = ([0.0, -0.5], [f64::INFINITY, 0.5], [-1, 0]);
    /// let a = Compressed { pointers: &[0, 2, 4], indices: &[0, 1, 0, 1], values: &a };
    /// let fields = RowFields { r: Some(&b), lo: Some(&lo), hi: Some(&hi), ..RowFields::default() };
    /// let mut problem = Problem::reduced(SparseMatrix::csr(2, 2, a)?, Triangle::Full, &fields)?;
    /// problem.set_findex(0, &findex)?;
    /// let mut solver = Solver::new()?;
    /// assert!(solver.solve(&problem)?.is_solved());
    /// let x = solver.impulses()?;
    /// assert!((x[1] - 0.5 * x[0]).abs() < 1e-9 && (2.0 * x[0] + 0.5 * x[1] - 4.0).abs() < 1e-9);
    /// # Ok(()) }
    /// ```
    pub fn set_findex(&mut self, first: usize, findex: &[i32]) -> Result<()> {
        let (first, rows) = (int("first", first)?, int("the length of findex", findex.len())?);
        // SAFETY: that many indices.
        self.edit(|raw| unsafe { sys::mlcp_problem_rows_set_findex(raw, first, rows, findex.as_ptr()) })
    }

    /// Copies the findex array of all rows into m numbers.
    pub fn read_findex(&self, findex: &mut [i32]) -> Result<()> {
        check_length("findex", findex.len(), self.row_count())?;
        // SAFETY: room for m indices.
        check(unsafe { sys::mlcp_problem_get_findex(self.as_ptr(), int("m", findex.len())?, findex.as_mut_ptr()) })
    }
}
