//! Callbacks: what they see, how they stop a solve, that they run on other threads, and that a panic in one goes around the library.
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

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

/// Towers whose factors are large enough for a task each.
fn towers(count: usize) -> mlcp::Result<Problem> {
    const HEIGHT: usize = 300;
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &vec![1.0; count * HEIGHT])?;
    let momenta: Vec<f64> = (0..count * HEIGHT).map(|i| -0.01 * (1 + i % 7) as f64).collect();
    problem.set_momentum(0, &momenta)?;
    for i in 0..(count * HEIGHT) as i32 {
        if i as usize % HEIGHT == 0 {
            problem.add_row(&Row::unilateral(&[i], &[1.0]))?;
        } else {
            problem.add_row(&Row::unilateral(&[i - 1, i], &[-1.0, 1.0]))?;
        }
    }
    Ok(problem)
}

#[test]
fn islands_are_solved_on_the_threads_of_the_caller_to_the_same_bits() -> mlcp::Result<()> {
    let (problem, settings) = (towers(8)?, mlcp::Settings::new().warm_start(false));
    let mut solver = Solver::with_settings(&settings)?;
    assert!(solver.solve(&problem)?.is_solved());
    let expected = solver.impulses()?.to_vec();
    let mut loops = 0;
    let on_three_threads = &mut |work: &(dyn Fn() + Sync)| {
        loops += 1;
        thread::scope(|scope| {
            scope.spawn(work);
            scope.spawn(work);
            work();
        });
    };
    assert!(solver.request(&problem).parallel(on_three_threads).run()?.is_solved());
    assert_eq!(solver.impulses()?, expected);
    assert!(loops > 0);

    // the library's own threads
    solver.set_settings(&settings.num_threads(3))?;
    assert!(solver.solve(&problem)?.is_solved());
    assert_eq!(solver.impulses()?, expected);
    Ok(())
}

#[test]
fn work_that_the_caller_leaves_is_done_all_the_same() -> mlcp::Result<()> {
    let (problem, mut solver) = (towers(4)?, Solver::with_settings(&mlcp::Settings::new().warm_start(false))?);
    assert!(solver.solve(&problem)?.is_solved());
    let expected = solver.impulses()?.to_vec();
    assert!(solver.request(&problem).parallel(&mut |_| ()).run()?.is_solved());
    assert_eq!(solver.impulses()?, expected);
    // more calls than there is work
    let calls = AtomicUsize::new(0);
    let again_and_again = &mut |work: &(dyn Fn() + Sync)| {
        for _ in 0..100 {
            work();
            calls.fetch_add(1, Ordering::Relaxed);
        }
    };
    assert!(solver.request(&problem).parallel(again_and_again).run()?.is_solved());
    assert_eq!(solver.impulses()?, expected);
    assert!(calls.into_inner() >= 100);
    Ok(())
}

#[test]
fn a_panic_among_the_threads_of_the_caller_goes_on_after_the_solve() -> mlcp::Result<()> {
    let (problem, mut solver) = (towers(4)?, Solver::new()?);
    let mut panics = |work: &(dyn Fn() + Sync)| {
        work();
        panic!("no threads today");
    };
    let result = catch_unwind(AssertUnwindSafe(|| solver.request(&problem).parallel(&mut panics).run()));
    assert_eq!(*result.unwrap_err().downcast_ref::<&str>().unwrap(), "no threads today");
    assert!(solver.impulses()?.len() == problem.row_count(), "the solve itself went on");
    assert!(solver.solve(&problem)?.is_solved());
    Ok(())
}

#[test]
fn progress_is_told_from_inside_of_parallel_work() -> mlcp::Result<()> {
    let (problem, mut solver) = (towers(4)?, Solver::new()?);
    let (mut calls, here) = (0, thread::current().id());
    let report = solver
        .request(&problem)
        .progress(&mut |_| {
            assert_eq!(thread::current().id(), here);
            calls += 1;
            ControlFlow::Continue(())
        })
        .parallel(&mut |work| {
            thread::scope(|scope| {
                scope.spawn(work);
                work();
            });
        })
        .run()?;
    assert!(report.is_solved());
    Ok(())
}
