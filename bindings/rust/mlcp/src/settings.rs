//! How to solve.
use std::mem::MaybeUninit;
use std::time::Duration;

use crate::constants::constants;
use crate::numbers::count;

constants! {
    /// A way to solve.
    Method, sys::mlcp_method {
        /// The library chooses, island by island.
        Auto = MLCP_METHOD_AUTO,
        /// The simplex method of the paper: exact, finite, one row at a time.
        Simplex = MLCP_METHOD_SIMPLEX,
        /// Many rows at a time: exact, and falls back on the simplex method.
        Newton = MLCP_METHOD_NEWTON,
        /// Projected Gauss-Seidel, for a low accuracy: set a tolerance that it can reach.
        Pgs = MLCP_METHOD_PGS,
    }
}

constants! {
    /// What may stop a step of the simplex method.
    PivotRule, sys::mlcp_pivot_rule {
        /// Impulses that reach a bound; the row with the largest |w|/√a enters.
        Dual = MLCP_PIVOT_DUAL,
        /// The paper's pseudocode, mended: satisfied rows that would become violated too.
        Printed = MLCP_PIVOT_PRINTED,
    }
}

constants! {
    /// When the factor is made afresh.
    Refactorize, sys::mlcp_refactorize {
        /// When it has drifted, or when a batch of toggles is cheaper so.
        WhenNeeded = MLCP_REFACTORIZE_WHEN_NEEDED,
        /// At every pivot, to compare.
        Always = MLCP_REFACTORIZE_ALWAYS,
    }
}

constants! {
    /// Which impulses, where dependent rows leave a choice; v is the same for all.
    Impulses, sys::mlcp_impulses {
        /// Those that the method ends with.
        Any = MLCP_IMPULSES_ANY,
        /// The least Σ aᵢγᵢ²: table legs carry equal loads. A second solve on such islands.
        LeastNorm = MLCP_IMPULSES_LEAST_NORM,
    }
}

/// How to solve. Fields are read, methods of the same names set them:
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// use mlcp::{Method, Settings, Solver};
///
/// let settings = Settings::new().method(Method::Simplex).tolerance(1e-12).trace(true);
/// let solver = Solver::with_settings(&settings)?;
/// assert_eq!(solver.settings().tolerance, 1e-12);
/// # Ok(()) }
/// ```
///
/// Callbacks belong to one solve and are given to its [`Request`](crate::Request).
#[must_use = "settings do nothing until a solver has them"]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The way to solve; [`Method::Auto`].
    pub method: Method,
    /// The rule of the simplex method; [`PivotRule::Dual`].
    pub pivot_rule: PivotRule,
    /// When the factor is made afresh; [`Refactorize::WhenNeeded`].
    pub refactorize: Refactorize,
    /// Whether every pivot is recorded; no.
    pub trace: bool,
    /// On the largest relative error of the report, > 0; 1e-9.
    pub tolerance: f64,
    /// Pivots, Newton steps or sweeps, an island; `None`: 50 (rows + 10).
    pub max_iterations: Option<u64>,
    /// Entries touched, an island; the same number everywhere, unlike seconds; `None`: no limit.
    pub max_work: Option<u64>,
    /// Wall clock; `None`: no limit.
    pub max_time: Option<Duration>,
    /// Which impulses, where there is a choice; [`Impulses::Any`].
    pub impulses: Impulses,
    /// Whether the answer is computed anew from its active set, so that warm and cold starts and all exact methods give the same bits where
    /// active rows are independent and none is at zero by accident. Costs an analysis and a factorization; no.
    pub canonical: bool,
    /// Whether without a start mask rows with keys start where the last solve left rows with the same key, and the elimination order of the last
    /// analysis is carried over to rows that came and went; yes. No: bits do not depend on what was solved before.
    pub warm_start: bool,
    /// Threads that solve islands, the caller's among them; 0: one a CPU; 1. The bits do not depend on it.
    pub num_threads: usize,
    /// Facets of the friction of contacts that do not say; 0, the circular cone.
    pub facets: usize,
    /// Most solves of the iteration for friction; `None`: 300.
    pub max_shifts: Option<u32>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings::new()
    }
}

impl Settings {
    /// The library's defaults.
    pub fn new() -> Self {
        Settings::from_raw(&default_raw())
    }

    /// Sets the way to solve.
    pub fn method(self, method: Method) -> Self {
        Settings { method, ..self }
    }

    /// Sets the rule of the simplex method.
    pub fn pivot_rule(self, pivot_rule: PivotRule) -> Self {
        Settings { pivot_rule, ..self }
    }

    /// Sets when the factor is made afresh.
    pub fn refactorize(self, refactorize: Refactorize) -> Self {
        Settings { refactorize, ..self }
    }

    /// Sets whether every pivot is recorded.
    pub fn trace(self, trace: bool) -> Self {
        Settings { trace, ..self }
    }

    /// Sets what the largest relative error of the report may be.
    pub fn tolerance(self, tolerance: f64) -> Self {
        Settings { tolerance, ..self }
    }

    /// Limits the pivots, Newton steps or sweeps, an island.
    pub fn max_iterations(self, max_iterations: impl Into<Option<u64>>) -> Self {
        Settings { max_iterations: max_iterations.into(), ..self }
    }

    /// Limits the entries touched, an island.
    pub fn max_work(self, max_work: impl Into<Option<u64>>) -> Self {
        Settings { max_work: max_work.into(), ..self }
    }

    /// Limits the wall clock.
    pub fn max_time(self, max_time: impl Into<Option<Duration>>) -> Self {
        Settings { max_time: max_time.into(), ..self }
    }

    /// Sets which impulses, where there is a choice.
    pub fn impulses(self, impulses: Impulses) -> Self {
        Settings { impulses, ..self }
    }

    /// Sets whether the answer is computed anew from its active set.
    pub fn canonical(self, canonical: bool) -> Self {
        Settings { canonical, ..self }
    }

    /// Sets whether rows start by their keys.
    pub fn warm_start(self, warm_start: bool) -> Self {
        Settings { warm_start, ..self }
    }

    /// Sets how many threads solve islands; 0: one a CPU.
    pub fn num_threads(self, num_threads: usize) -> Self {
        Settings { num_threads, ..self }
    }

    /// Sets the facets of friction; 0: the circular cone, else at least 3.
    pub fn facets(self, facets: usize) -> Self {
        Settings { facets, ..self }
    }

    /// Sets how often the iteration for friction may solve.
    pub fn max_shifts(self, max_shifts: u32) -> Self {
        Settings { max_shifts: Some(max_shifts), ..self }
    }

    pub(crate) fn from_raw(raw: &sys::mlcp_settings) -> Self {
        Settings {
            method: Method::from_raw(raw.method),
            pivot_rule: PivotRule::from_raw(raw.pivot_rule),
            refactorize: Refactorize::from_raw(raw.refactorize),
            trace: raw.trace != 0,
            tolerance: raw.tolerance,
            max_iterations: limit(raw.max_iterations),
            max_work: limit(raw.max_work),
            max_time: Duration::try_from_secs_f64(raw.max_seconds).ok().filter(|time| !time.is_zero()),
            impulses: Impulses::from_raw(raw.impulses),
            canonical: raw.canonical != 0,
            warm_start: raw.warm_start != 0,
            num_threads: count(raw.num_threads),
            facets: count(raw.facets),
            max_shifts: u32::try_from(raw.max_shifts).ok().filter(|&most| most > 0),
        }
    }

    /// Without callbacks.
    pub(crate) fn raw(&self) -> sys::mlcp_settings {
        let mut raw = default_raw();
        raw.method = self.method.raw();
        raw.pivot_rule = self.pivot_rule.raw();
        raw.refactorize = self.refactorize.raw();
        raw.trace = i32::from(self.trace);
        raw.tolerance = self.tolerance;
        raw.max_iterations = raw_limit(self.max_iterations);
        raw.max_work = raw_limit(self.max_work);
        // 0 would be no limit
        raw.max_seconds = self.max_time.map_or(0.0, |time| time.as_secs_f64().max(f64::MIN_POSITIVE));
        raw.impulses = self.impulses.raw();
        raw.canonical = i32::from(self.canonical);
        raw.warm_start = i32::from(self.warm_start);
        raw.num_threads = i32::try_from(self.num_threads).unwrap_or(i32::MAX); // refused by the library
        raw.facets = i32::try_from(self.facets).unwrap_or(i32::MAX);
        raw.max_shifts = self.max_shifts.map_or(0, |most| i32::try_from(most).unwrap_or(i32::MAX));
        raw
    }
}

/// The library's defaults.
pub(crate) fn default_raw() -> sys::mlcp_settings {
    let mut raw = MaybeUninit::uninit();
    // SAFETY: the init function fills the struct, every field.
    unsafe {
        sys::mlcp_settings_init(raw.as_mut_ptr(), size_of_val(&raw));
        raw.assume_init()
    }
}

/// 0 stands for none.
fn limit(raw: i64) -> Option<u64> {
    u64::try_from(raw).ok().filter(|&limit| limit > 0)
}

/// A limit of 0 is one of 1: the library has no lower one.
fn raw_limit(limit: Option<u64>) -> i64 {
    limit.map_or(0, |limit| i64::try_from(limit).unwrap_or(i64::MAX).max(1))
}
