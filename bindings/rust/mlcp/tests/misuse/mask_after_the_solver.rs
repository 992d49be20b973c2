fn misuse(problem: &mlcp::Problem, mut solver: mlcp::Solver) -> mlcp::Result<()> {
    let _ = solver.solve(problem)?;
    let mask = solver.mask()?;
    drop(solver);
    println!("{}", mask.len());
    Ok(())
}

fn main() {}
