fn misuse(problem: &mut mlcp::Problem) -> mlcp::Result<()> {
    let r = vec![1.0];
    let rows = mlcp::Rows::new(1).r(&r);
    drop(r);
    problem.add_rows(&rows)?;
    Ok(())
}

fn main() {}
