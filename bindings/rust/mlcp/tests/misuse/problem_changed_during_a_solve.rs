fn misuse(problem: &mut mlcp::Problem, solver: &mut mlcp::Solver) -> mlcp::Result<mlcp::Report> {
    let mut change = |_: &mlcp::Progress| {
        let _ = problem.clear();
        std::ops::ControlFlow::Continue(())
    };
    solver.request(problem).progress(&mut change).run()
}

fn main() {}
