use mlcp::{Problem, Solver};

fn main() -> mlcp::Result<()> {
    let problem = Problem::new()?;
    let mut solver = Solver::new()?;
    let _ = solver.solve(&problem)?;
    let certificate = solver.certificate(None)?;
    let _ = solver.request(&problem).start_from_last().run()?;
    println!("{:?}", certificate.rows);
    Ok(())
}
