fn misuse(problem: &mlcp::Problem, solver: &mut mlcp::Solver) -> mlcp::Result<()> {
    let impulses = solver.impulses()?;
    let _ = solver.solve(problem)?;
    println!("{}", impulses.len());
    Ok(())
}

fn main() {}
