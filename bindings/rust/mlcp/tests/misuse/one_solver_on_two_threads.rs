/// What `std::thread` asks of a value that two threads see.
fn shared<T: Sync>(_: &T) {}

fn misuse(solver: &mlcp::Solver) {
    shared(solver);
}

fn main() {}
