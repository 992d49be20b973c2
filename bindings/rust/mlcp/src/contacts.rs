//! Contacts with friction over rows of a problem.
use std::ptr::null;

use crate::constants::constants;
use crate::error::{Result, check};
use crate::numbers::{count, int};
use crate::{Problem, Solver};

constants! {
    /// How a contact resists sliding.
    Friction, sys::mlcp_friction {
        /// Not at all; its tangent rows are left out.
        None = MLCP_FRICTION_NONE,
        /// The convex pyramid or cone: `γ_T` within `µ γ_n`, and sliding lifts (Anitescu 2006).
        Convex = MLCP_FRICTION_CONVEX,
        /// Coulomb's law.
        Coulomb = MLCP_FRICTION_COULOMB,
        /// Tangent impulses within fixed bounds.
        Bounded = MLCP_FRICTION_BOX,
        /// Tangent impulses within ± µ times the normal one, each alone, as `findex` of ODE, Bullet and DART.
        Findex = MLCP_FRICTION_FINDEX,
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

/// A contact: its normal row and, right behind it, its tangent rows.
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

impl Problem {
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
    /// problem.declare_contacts(&[Contact { row: 0, dimension: 2, friction: Friction::Coulomb, mu: 0.5, facets: 0 }])?;
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
            let model: Vec<_> = group.iter().map(|contact| contact.friction.raw()).collect();
            let mu: Vec<_> = group.iter().map(|contact| contact.mu).collect();
            // SAFETY: `length` entries in each array; no bounds.
            self.edit(|raw| unsafe {
                sys::mlcp_problem_contacts_declare(
                    raw,
                    length,
                    dimension,
                    row.as_ptr(),
                    model.as_ptr(),
                    mu.as_ptr(),
                    null(),
                    facets.as_ptr(),
                )
            })?;
        }
        Ok(())
    }

    /// The contacts, in order of adding.
    pub fn contacts(&self) -> Result<Vec<Contact>> {
        // SAFETY: a live handle.
        let length = unsafe { sys::mlcp_problem_contact_count(self.as_ptr()) };
        let size = count(length);
        let (mut row, mut dimension, mut facets) = (vec![0; size], vec![0; size], vec![0; size]);
        let (mut model, mut mu) = (vec![0; size], vec![0.0; size]);
        // SAFETY: `length` places in each array.
        check(unsafe {
            sys::mlcp_problem_get_contacts(
                self.as_ptr(),
                length,
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
}

impl Solver {
    /// What each contact did in the last solve. [`Error::State`](crate::Error::State) before the first one.
    pub fn contact_states(&self) -> Result<impl ExactSizeIterator<Item = ContactState> + '_> {
        Ok(self.lend(sys::mlcp_solver_contact_states)?.iter().map(|&state| ContactState::from_raw(state)))
    }
}
