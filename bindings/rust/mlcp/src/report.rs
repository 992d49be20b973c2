//! How a solve ended.
use std::time::Duration;

use crate::constants::constants;
use crate::numbers::{count, index};
use crate::settings::Method;

constants! {
    /// How a solve ended.
    Outcome, sys::mlcp_outcome {
        /// Every error, recomputed from the problem, is within the tolerance.
        Solved = MLCP_SOLVED,
        /// The limit of iterations, or no further progress above the tolerance.
        IterationLimit = MLCP_ITERATION_LIMIT,
        /// The limit of entries touched.
        WorkLimit = MLCP_WORK_LIMIT,
        /// The limit of time.
        TimeLimit = MLCP_TIME_LIMIT,
        /// The progress callback asked to stop.
        Interrupted = MLCP_INTERRUPTED,
        /// Rows contradict each other; [`Solver::certificate`](crate::Solver::certificate) names them.
        Infeasible = MLCP_INFEASIBLE,
        /// Only for semidefinite M: a ray along which the energy falls without end.
        Unbounded = MLCP_UNBOUNDED,
        /// M, or Σ of a reduced problem, is indefinite; the report names body and velocity.
        NotPositiveDefinite = MLCP_NOT_POSITIVE_DEFINITE,
    }
}

/// How a solve ended, with errors recomputed from the problem's own numbers.
#[must_use = "the outcome of a solve is in its report"]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// The worst over the islands.
    pub outcome: Outcome,
    /// The method that ran; [`Method::Auto`]: several did.
    pub method: Method,
    /// Componentwise backward error of the momentum equation, over dynamic velocities. What is not finite is an error of ∞, here and below.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub momentum_error: f64,
    /// Natural residual of the rows, relative to what they are made of.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub constraint_error: f64,
    /// The largest of `momentum_error`, `constraint_error` and `cone_error`, which the tolerance is for.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub largest_error: f64,
    /// Largest residual of the momentum equation, N·s.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub momentum_residual: f64,
    /// Largest natural residual of a row, m/s.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub constraint_residual: f64,
    /// Where `momentum_error` is; where M is not positive definite, whose pivot failed.
    pub worst_velocity: Option<usize>,
    /// Where `constraint_error` is.
    pub worst_row: Option<usize>,
    /// The body whose mass is not positive definite; for a reduced problem a row.
    pub worst_body: Option<usize>,
    /// Connected components of dynamic bodies and enabled rows.
    pub islands: usize,
    /// Of them not solved.
    pub islands_failed: usize,
    /// Rows that are part of the problem.
    pub enabled_rows: usize,
    /// Rows with w = 0.
    pub active_rows: usize,
    /// Rows that depend on active ones.
    pub redundant_rows: usize,
    /// Steps of the simplex method, Newton steps, sweeps of Gauss-Seidel.
    pub pivots: i64,
    /// Rows taken into or out of the factor along the elimination tree.
    pub toggles: i64,
    /// Factors made afresh.
    pub factorizations: i64,
    /// Steps of iterative refinement.
    pub refinements: i64,
    /// Entries of L, J and M touched.
    pub work: i64,
    /// Entries below the diagonal of L, every enabled row in.
    pub factor_entries: i64,
    /// Where the time went.
    pub times: Times,
    /// Whether this solve had to analyze the pattern.
    pub analyzed: bool,
    /// How often the factor was made afresh because it had drifted.
    pub refactorized_for_drift: usize,
    /// Whether the solve started from a mask, given or found by keys.
    pub warm: bool,
    /// Islands that a method gave up and another one solved.
    pub fallbacks: usize,
    /// Largest error of a contact with a cone of friction, relative to its scale; the rows of such contacts are not in `constraint_error`.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub cone_error: f64,
    /// The same in m/s.
    #[cfg_attr(feature = "serde", serde(with = "crate::ecosystem::serde::infinite"))]
    pub cone_residual: f64,
    /// Where `cone_error` is.
    pub worst_contact: Option<usize>,
    /// Contacts with friction that have no impulse.
    pub contacts_open: usize,
    /// Contacts with friction that hold and do not slide.
    pub contacts_sticking: usize,
    /// Contacts with friction that slide.
    pub contacts_sliding: usize,
    /// Rows that stand for cones in the solves.
    pub generators: usize,
    /// Most generators that one contact needed, those aimed anew included.
    pub facets: usize,
    /// Solves of the iteration for friction.
    pub shift_iterations: usize,
    /// Islands that Lemke's method, the finite fallback for friction, solved.
    pub islands_by_lemke: usize,
}

/// Wall-clock times of a solve.
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Times {
    /// All of it.
    pub total: Duration,
    /// Ordering and analysis; 0 where the pattern was known.
    pub analyze: Duration,
    /// Factors.
    pub factorize: Duration,
    /// The method.
    pub solve: Duration,
    /// Measuring the errors.
    pub report: Duration,
}

impl Report {
    /// Whether every error is within the tolerance.
    pub fn is_solved(&self) -> bool {
        self.outcome == Outcome::Solved
    }

    pub(crate) fn from_raw(raw: &sys::mlcp_report) -> Self {
        Report {
            outcome: Outcome::from_raw(raw.outcome),
            method: Method::from_raw(raw.method),
            momentum_error: raw.momentum_error,
            constraint_error: raw.constraint_error,
            largest_error: raw.largest_error,
            momentum_residual: raw.momentum_residual,
            constraint_residual: raw.constraint_residual,
            worst_velocity: index(raw.worst_velocity),
            worst_row: index(raw.worst_row),
            worst_body: index(raw.worst_body),
            islands: count(raw.islands),
            islands_failed: count(raw.islands_failed),
            enabled_rows: count(raw.enabled_rows),
            active_rows: count(raw.active_rows),
            redundant_rows: count(raw.redundant_rows),
            pivots: raw.pivots,
            toggles: raw.toggles,
            factorizations: raw.factorizations,
            refinements: raw.refinements,
            work: raw.work,
            factor_entries: raw.factor_entries,
            times: Times {
                total: seconds(raw.seconds),
                analyze: seconds(raw.seconds_analyze),
                factorize: seconds(raw.seconds_factorize),
                solve: seconds(raw.seconds_solve),
                report: seconds(raw.seconds_report),
            },
            analyzed: raw.analyzed != 0,
            refactorized_for_drift: count(raw.refactorized_for_drift),
            warm: raw.warm != 0,
            fallbacks: count(raw.fallbacks),
            cone_error: raw.cone_error,
            cone_residual: raw.cone_residual,
            worst_contact: index(raw.worst_contact),
            contacts_open: count(raw.contacts_open),
            contacts_sticking: count(raw.contacts_sticking),
            contacts_sliding: count(raw.contacts_sliding),
            generators: count(raw.generators),
            facets: count(raw.facets),
            shift_iterations: count(raw.shift_iterations),
            islands_by_lemke: count(raw.islands_by_lemke),
        }
    }
}

/// To the nearest nanosecond. A clock that was set back during a solve gives 0.
pub(crate) fn seconds(seconds: f64) -> Duration {
    Duration::from_nanos((seconds * 1e9 + 0.5) as u64) // `as` ends at the range of u64; a conversion that can fail is five times as long
}
