use std::ops::ControlFlow;

use mlcp::{Problem, Solver};

fn main() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    let mut solver = Solver::new()?;
    let mut progress = |_: &mlcp::Progress| {
        let _ = problem.clear();
        ControlFlow::Continue(())
    };
    let _ = solver.request(&problem).progress(&mut progress).run()?;
    Ok(())
}
