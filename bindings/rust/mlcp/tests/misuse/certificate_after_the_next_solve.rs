fn misuse(problem: &mlcp::Problem, solver: &mut mlcp::Solver) -> mlcp::Result<()> {
    let certificate = solver.certificate(None)?;
    let _ = solver.request(problem).start_from_last().run()?;
    println!("{:?}", certificate.rows);
    Ok(())
}

fn main() {}
