//! The steps of the simplex method.
use std::fmt;

use crate::mask::RowState;
use crate::numbers::{count, index};

/// One step of the simplex method, recorded when [`Settings::trace`](crate::Settings::trace) is set.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Pivot(sys::mlcp_pivot);

impl Pivot {
    /// The island that it belongs to.
    pub fn island(&self) -> usize {
        count(self.0.island)
    }

    /// The row whose violation drives the step.
    pub fn entering(&self) -> usize {
        count(self.0.entering)
    }

    /// The row that stopped the step; the entering one itself when it reached w = 0 or its far bound; `None`: nothing did.
    pub fn blocking(&self) -> Option<usize> {
        index(self.0.blocking)
    }

    /// The new state of the blocking row.
    pub fn to(&self) -> RowState {
        RowState::from_raw(self.0.to)
    }

    /// Whether the entering row depends on active ones, so that the step is along impulses only.
    pub fn is_dependent(&self) -> bool {
        self.0.dependent != 0
    }

    /// Change of the entering impulse, N·s.
    pub fn step(&self) -> f64 {
        self.0.step
    }

    /// w of the entering row before the step, m/s.
    pub fn violation(&self) -> f64 {
        self.0.violation
    }

    /// Schur pivot of the entering row, relative to its a.
    pub fn schur(&self) -> f64 {
        self.0.schur
    }
}

impl fmt::Debug for Pivot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pivot")
            .field("island", &self.island())
            .field("entering", &self.entering())
            .field("blocking", &self.blocking())
            .field("to", &self.to())
            .field("dependent", &self.is_dependent())
            .field("step", &self.step())
            .field("violation", &self.violation())
            .field("schur", &self.schur())
            .finish()
    }
}
