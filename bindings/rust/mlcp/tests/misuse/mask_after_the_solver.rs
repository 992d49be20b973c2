use mlcp::{MaskRef, Problem, Solver};

fn main() -> mlcp::Result<()> {
    let problem = Problem::new()?;
    let start: &MaskRef;
    {
        let mut solver = Solver::new()?;
        let _ = solver.solve(&problem)?;
        start = solver.mask()?;
    }
    println!("{}", start.len());
    Ok(())
}
