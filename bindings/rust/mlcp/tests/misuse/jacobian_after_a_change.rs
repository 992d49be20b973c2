use mlcp::Problem;

fn main() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    let jacobian = problem.jacobian()?;
    problem.clear_rows()?;
    println!("{}", jacobian.rows);
    Ok(())
}
