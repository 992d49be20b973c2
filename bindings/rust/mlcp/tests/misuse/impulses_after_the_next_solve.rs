use mlcp::{Problem, Solver};

fn main() -> mlcp::Result<()> {
    let problem = Problem::new()?;
    let mut solver = Solver::new()?;
    let _ = solver.solve(&problem)?;
    let impulses = solver.impulses()?;
    let _ = solver.solve(&problem)?;
    println!("{impulses:?}");
    Ok(())
}
