fn misuse(problem: &mut mlcp::Problem) -> mlcp::Result<()> {
    let jacobian = problem.jacobian()?;
    problem.clear_rows()?;
    println!("{}", jacobian.rows);
    Ok(())
}

fn main() {}
