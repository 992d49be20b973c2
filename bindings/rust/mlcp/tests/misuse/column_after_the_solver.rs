fn misuse(problem: &mlcp::Problem) -> mlcp::Result<&'static [i32]> {
    let mut solver = mlcp::Solver::new()?;
    solver.analyze(problem, None)?;
    Ok(solver.factor()?.column(0))
}

fn main() {}
