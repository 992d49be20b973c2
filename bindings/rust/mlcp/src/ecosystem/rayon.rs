//! Islands on the threads of rayon.
use crate::Request;

impl Request<'_> {
    /// Solves islands on the threads of the present rayon pool beside this one. The answer is the same bits as without, whatever the pool.
    ///
    /// ```
    /// # fn main() -> mlcp::Result<()> {
    /// # let (problem, mut solver) = (mlcp::Problem::new()?, mlcp::Solver::new()?);
    /// let report = solver.request(&problem).rayon().run()?;
    /// assert!(report.is_solved());
    ///
    /// // in a pool of one's own
    /// let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("three threads");
    /// let report = pool.install(|| solver.request(&problem).rayon().run())?;
    /// assert!(report.is_solved());
    /// # Ok(()) }
    /// ```
    pub fn rayon(self) -> Self {
        self.parallel_by(on_pool)
    }
}

/// Progress is told on the thread that solves, so that one has to work too.
fn on_pool(work: &(dyn Fn() + Sync)) {
    let this_one = usize::from(rayon::current_thread_index().is_some());
    rayon::in_place_scope(|scope| {
        for _ in this_one..rayon::current_num_threads() {
            scope.spawn(|_| work());
        }
        work();
    });
}
