use mlcp::Solver;

/// What `std::thread` asks of a value that two threads see.
fn shared<T: Sync>(_: &T) {}

fn main() -> mlcp::Result<()> {
    shared(&Solver::new()?);
    Ok(())
}
