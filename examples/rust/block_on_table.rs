//! A block rests on a table with two corners: which impulses carry it through a step of 10 ms?
use mlcp::{Outcome, Problem, Rows, Solver};
use std::process::ExitCode;

fn main() -> mlcp::Result<ExitCode> {
    let (h, mass, inertia, half_width) = (0.01, 2.0, 0.1, 0.2);
    let mut problem = Problem::new()?;
    let block = problem.add_body(3, &[mass, 0.0, 0.0, 0.0, mass, 0.0, 0.0, 0.0, inertia])?; // velocities x, y, angle
    problem.set_momentum(0, &[0.0, -9.81 * mass * h, 0.0])?; // k = M v + h Q: at rest, its weight

    // how fast each corner rises: a row of J; unilateral, against the world, r = 0
    let corners = [0.0, 1.0, -half_width, 0.0, 1.0, half_width];
    problem.add_rows(&Rows::new(2).body_a(&[block, block]).jacobian_a(&corners))?;

    let mut solver = Solver::new()?;
    let report = solver.solve(&problem)?;
    let impulses = solver.impulses()?;
    println!(
        "{:?}: {:.4} and {:.4} N.s, error {:.0e}",
        report.outcome, impulses[0], impulses[1], report.largest_error
    );
    Ok(if report.outcome == Outcome::Solved {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}
