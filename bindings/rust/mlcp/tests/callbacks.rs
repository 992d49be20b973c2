//! Callbacks: what they see, how they stop a solve, and that a panic in one goes around the library.
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use mlcp::{Outcome, Problem, Row, Solver};

/// Falling bodies, each an island with one pivot or more.
fn islands(count: usize) -> mlcp::Result<Problem> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &vec![1.0; count])?;
    problem.set_momentum(0, &vec![-1.0; count])?;
    for column in 0..count as i32 {
        problem.add_row(&Row::unilateral(&[column], &[1.0]))?;
    }
    Ok(problem)
}

#[test]
fn progress_is_told_and_does_not_change_the_answer() -> mlcp::Result<()> {
    let (problem, mut solver) = (islands(20)?, Solver::new()?);
    let report = solver.solve(&problem)?;
    let expected = solver.impulses()?.to_vec();
    let mut seen = Vec::new();
    let watched = solver
        .request(&problem)
        .progress(&mut |progress| {
            seen.push(*progress);
            ControlFlow::Continue(())
        })
        .run()?;
    assert_eq!((watched.outcome, watched.pivots), (Outcome::Solved, report.pivots));
    assert_eq!(solver.impulses()?, expected);
    assert!(!seen.is_empty());
    assert!(seen.iter().all(|progress| progress.islands == 20 && progress.island < 20 && progress.work >= 0));
    assert!(seen.windows(2).all(|pair| pair[0].pivots <= pair[1].pivots && pair[0].time <= pair[1].time));
    Ok(())
}

#[test]
fn a_callback_stops_its_solve_and_no_other() -> mlcp::Result<()> {
    let (problem, mut solver) = (islands(20)?, Solver::new()?);
    let mut calls = 0;
    let report = solver
        .request(&problem)
        .progress(&mut |_| {
            calls += 1;
            ControlFlow::Break(())
        })
        .run()?;
    assert_eq!(report.outcome, Outcome::Interrupted);
    assert!(calls > 0);
    let calls_then = calls;
    assert!(solver.solve(&problem)?.is_solved());
    assert_eq!(calls, calls_then, "a callback is gone after its solve");
    Ok(())
}

#[test]
fn a_panic_in_a_callback_goes_on_after_the_solve() -> mlcp::Result<()> {
    let (problem, mut solver) = (islands(20)?, Solver::new()?);
    let mut calls = 0;
    let mut panics = |_: &mlcp::Progress| {
        calls += 1;
        panic!("call {calls} of the callback")
    };
    let result = catch_unwind(AssertUnwindSafe(|| solver.request(&problem).progress(&mut panics).run()));
    let payload = result.unwrap_err();
    assert_eq!(payload.downcast_ref::<String>().unwrap(), "call 1 of the callback");
    assert!(solver.solve(&problem)?.is_solved(), "the solver works on");
    Ok(())
}

#[test]
fn settings_survive_a_solve_with_callbacks() -> mlcp::Result<()> {
    let (problem, settings) = (islands(3)?, mlcp::Settings::new().tolerance(1e-7).trace(true));
    let mut solver = Solver::with_settings(&settings)?;
    let report = solver.request(&problem).progress(&mut |_| ControlFlow::Continue(())).run()?;
    assert_eq!(solver.settings(), settings);
    assert_eq!(solver.trace()?.len() as i64, report.pivots);
    Ok(())
}

#[test]
fn a_request_that_is_refused_leaves_no_callback() -> mlcp::Result<()> {
    let (problem, mut solver) = (islands(3)?, Solver::new()?);
    let short = mlcp::Mask::new(1, mlcp::RowState::ACTIVE)?;
    let mut calls = 0;
    let refused = solver
        .request(&problem)
        .start(&short)
        .progress(&mut |_| {
            calls += 1;
            ControlFlow::Break(())
        })
        .run();
    assert!(matches!(refused, Err(mlcp::Error::Range(text)) if text.contains("start")));
    assert!(solver.solve(&problem)?.is_solved());
    assert_eq!(calls, 0);
    Ok(())
}
