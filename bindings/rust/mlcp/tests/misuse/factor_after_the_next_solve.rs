fn misuse(solver: &mut mlcp::Solver, problem: &mlcp::Problem) -> mlcp::Result<()> {
    let factor = solver.factor()?;
    let report = solver.solve(problem)?;
    println!("{report:?} {}", factor.size());
    Ok(())
}

fn main() {}
