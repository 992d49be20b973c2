use mlcp::{Problem, Rows};

fn main() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    let mut rows = Rows::<f64>::new(1);
    {
        let r = vec![1.0];
        rows = rows.r(&r);
    }
    problem.add_rows(&rows)?;
    Ok(())
}
