fn misuse(problem: &mlcp::Problem, solver: &mut mlcp::Solver) -> mlcp::Result<mlcp::Report> {
    let mut trim = |_: &mlcp::Progress| {
        let _ = solver.trim();
        std::ops::ControlFlow::Continue(())
    };
    solver.request(problem).progress(&mut trim).run()
}

fn main() {}
