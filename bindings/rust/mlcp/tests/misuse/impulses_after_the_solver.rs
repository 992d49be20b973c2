fn misuse(problem: &mlcp::Problem, mut solver: mlcp::Solver) -> mlcp::Result<()> {
    let _ = solver.solve(problem)?;
    let impulses = solver.impulses()?;
    drop(solver);
    println!("{}", impulses.len());
    Ok(())
}

fn main() {}
