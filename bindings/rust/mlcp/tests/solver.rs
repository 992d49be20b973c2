//! Solves: results, masks, reactions, certificates, traces, settings, threads.
use std::thread;
use std::time::Duration;

use mlcp::{
    Error, Impulses, Mask, Method, Outcome, PivotRule, Problem, Refactorize, Row, RowState, Rows, Settings, Solver, strided_mut,
};

/// A block of 2 kg on two corners; keys 1 and 2.
fn block_on_table() -> mlcp::Result<Problem> {
    let mut problem = Problem::new()?;
    let block = problem.add_body(3, &[2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.1])?;
    problem.set_momentum(0, &[0.0, -0.2, 0.0])?;
    let corners = [0.0, 1.0, -0.2, 0.0, 1.0, 0.2];
    problem.add_rows(&Rows::new(2).body_a(&[block; 2]).jacobian_a(&corners).key(&[1, 2]))?;
    Ok(problem)
}

/// Two bodies in a row, pushed apart and held together: rows 0 and 1 contradict each other.
fn impossible() -> mlcp::Result<Problem> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[1.0, 1.0])?;
    problem.add_row(&Row::unilateral(&[0], &[1.0]).r(1.0))?;
    problem.add_row(&Row::unilateral(&[0], &[-1.0]).r(1.0))?;
    problem.add_row(&Row::unilateral(&[1], &[1.0]).r(1.0))?;
    Ok(problem)
}

#[test]
fn results_satisfy_the_equations() -> mlcp::Result<()> {
    let (problem, mut solver) = (block_on_table()?, Solver::new()?);
    let report = solver.solve(&problem)?;
    assert!(report.is_solved() && report.largest_error <= 1e-15, "{report:?}");
    assert_eq!((report.enabled_rows, report.active_rows, report.islands, report.islands_failed), (2, 2, 1, 0));
    assert!(report.analyzed && report.times.total >= report.times.solve && report.worst_body.is_none());
    let (v, gamma, w) = (solver.velocities()?, solver.impulses()?, solver.slacks()?);
    assert_eq!((v.len(), gamma.len(), w.len()), (3, 2, 2));
    // M v − Jᵀγ = k and w = J v
    assert!((2.0 * v[1] - (gamma[0] + gamma[1]) + 0.2).abs() < 1e-15 && (0.1 * v[2] + 0.2 * (gamma[0] - gamma[1])).abs() < 1e-15);
    assert!((v[1] - 0.2 * v[2] - w[0]).abs() < 1e-15 && (v[1] + 0.2 * v[2] - w[1]).abs() < 1e-15);
    assert!(gamma.iter().all(|&gamma| gamma > 0.09) && w.iter().all(|w| w.abs() < 1e-15));
    assert_eq!(solver.mask()?.states(), [RowState::ACTIVE; 2]);
    assert!(solver.row_islands()?.eq([Some(0), Some(0)]) && solver.island_outcomes()?.eq([Outcome::Solved]));
    assert!(solver.redundant()?.eq([false, false]) && solver.trace()?.is_empty());
    assert!(!solver.solve(&problem)?.analyzed, "the pattern is known");
    Ok(())
}

#[test]
fn there_are_no_results_before_a_solve() -> mlcp::Result<()> {
    let solver = Solver::new()?;
    assert!(matches!(solver.velocities(), Err(Error::State(_))));
    assert!(matches!(solver.mask(), Err(Error::State(_))));
    assert!(matches!(solver.trace(), Err(Error::State(_))));
    assert!(solver.redundant().is_err() && solver.certificate(None).is_err());
    Ok(())
}

#[test]
fn an_empty_problem_is_solved() -> mlcp::Result<()> {
    let mut solver = Solver::new()?;
    assert!(solver.solve(&Problem::new()?)?.is_solved());
    assert!(solver.velocities()?.is_empty() && solver.impulses()?.is_empty() && solver.mask()?.is_empty());
    Ok(())
}

#[test]
fn masks_leave_rows_out_and_tell_where_to_start() -> mlcp::Result<()> {
    let (problem, mut solver) = (block_on_table()?, Solver::new()?);
    let enabled = Mask::from_states(&[RowState::ACTIVE, RowState::DISABLED])?;
    solver.analyze(&problem, Some(&enabled))?;
    let report = solver.request(&problem).enabled(&enabled).run()?;
    assert_eq!((report.outcome, report.enabled_rows, report.analyzed), (Outcome::Solved, 1, false));
    assert_eq!(solver.impulses()?[1], 0.0);
    assert!(solver.row_islands()?.eq([Some(0), None]));

    let _ = solver.solve(&problem)?;
    let last = solver.mask()?.try_clone()?;
    // at most the one Newton step that finds nothing to change
    assert!(solver.request(&problem).start(&last).run()?.pivots <= 1);
    assert!(solver.request(&problem).start_from_last().run()?.pivots <= 1);
    assert_eq!(&last, &solver.mask()?.try_clone()?);

    let short = Mask::new(1, RowState::ACTIVE)?;
    let refused = solver.request(&problem).start(&short).run();
    assert_eq!(refused, Err(Error::Range("rows of start = 1, but 2 are needed".into())));
    let mut first = Solver::new()?;
    assert!(first.request(&problem).start_from_last().run()?.is_solved());
    Ok(())
}

#[test]
fn masks_are_carried_over_by_key() -> mlcp::Result<()> {
    let (mut problem, mut solver) = (block_on_table()?, Solver::new()?);
    let _ = solver.solve(&problem)?;
    problem.set_keys(0, &[2, 3])?;
    let mut start = Mask::new(0, RowState::DISABLED)?;
    start.carry(&problem, solver.mask()?, RowState::AT_UPPER)?;
    assert_eq!(start.states(), [RowState::ACTIVE, RowState::AT_UPPER]);
    start.resize(3, RowState::AT_LOWER)?;
    assert_eq!((start.len(), start.count(RowState::AT_LOWER)), (3, 1));
    assert_eq!(format!("{start:?}"), "[ACTIVE, AT_UPPER, AT_LOWER]");
    assert!(matches!(start.take_keys(&problem), Err(Error::Range(_))));
    start.resize(2, RowState::AT_LOWER)?;
    start.take_keys(&problem)?;
    assert!(matches!(start.set(1, &[RowState::ACTIVE; 2]), Err(Error::Range(_))));
    Ok(())
}

#[test]
fn an_infeasible_island_has_a_certificate_and_spoils_no_other() -> mlcp::Result<()> {
    let (problem, mut solver) = (impossible()?, Solver::new()?);
    let report = solver.solve(&problem)?;
    assert_eq!((report.outcome, report.islands, report.islands_failed), (Outcome::Infeasible, 2, 1));
    let bad = solver.island_outcomes()?.position(|outcome| outcome == Outcome::Infeasible);
    let certificate = solver.certificate(bad)?;
    let (mut rows, y) = (certificate.rows.to_vec(), certificate.y);
    rows.sort_unstable();
    assert_eq!(rows, [0, 1]);
    assert!(y[0] > 0.0 && (y[0] - y[1]).abs() <= 1e-12 * y[0]);
    assert_eq!(solver.certificate(None)?.y, y);
    assert!((solver.velocities()?[1] - 1.0).abs() < 1e-15, "the other island is solved");
    assert!(matches!(solver.certificate(Some(9)), Err(Error::Range(_))));
    Ok(())
}

#[test]
fn the_trace_tells_every_pivot() -> mlcp::Result<()> {
    let (problem, mut solver) = (block_on_table()?, Solver::with_settings(&Settings::new().method(Method::Simplex).trace(true))?);
    let report = solver.solve(&problem)?;
    let trace = solver.trace()?;
    assert!(!trace.is_empty() && trace.len() as i64 == report.pivots);
    assert!(trace.iter().all(|pivot| pivot.island() == 0 && pivot.entering() < 2 && pivot.violation() < 0.0));
    let last = trace[trace.len() - 1];
    assert_eq!((last.blocking(), last.to(), last.is_dependent()), (Some(last.entering()), RowState::ACTIVE, false));
    assert!(last.step() > 0.0 && last.schur() > 0.0 && format!("{last:?}").starts_with("Pivot { island: 0"));
    Ok(())
}

#[test]
fn the_reaction_on_a_prescribed_body_can_be_read() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    let bodies = problem.add_bodies(1, &[1.0, 2.0])?;
    problem.set_prescribed(bodies[1], &[0.5])?;
    problem.add_row(&Row::bilateral(&[0, 1], &[1.0, -1.0]))?;
    let mut solver = Solver::new()?;
    assert!(solver.solve(&problem)?.is_solved());
    assert_eq!(solver.velocities()?, [0.5, 0.5]);
    let mut reaction = [0.0];
    solver.read_reaction(&problem, bodies[1], &mut reaction)?;
    // M v − k − Jᵀγ with k = 0 and γ = 0.5
    assert_eq!(reaction, [1.5]);
    assert!(matches!(solver.read_reaction(&problem, bodies[1], &mut [0.0; 2]), Err(Error::Range(_))));
    Ok(())
}

#[test]
fn results_can_be_read_in_single_precision() -> mlcp::Result<()> {
    #[derive(Clone, Copy)]
    struct Contact {
        id: u64,
        impulse: f32,
    }
    let (problem, mut solver) = (block_on_table()?, Solver::new()?);
    let _ = solver.solve(&problem)?;
    let mut contacts = [Contact { id: 7, impulse: 0.0 }; 2];
    solver.read_impulses_f32(strided_mut!(&mut contacts, Contact, impulse))?;
    for (contact, &impulse) in contacts.iter().zip(solver.impulses()?) {
        assert_eq!((contact.id, contact.impulse), (7, impulse as f32));
    }
    let mut v = [9.0; 3];
    solver.read_velocities_f32(&mut v[..])?;
    assert!(v.iter().all(|v| v.abs() < 1e-7));
    assert!(matches!(solver.read_velocities_f32(&mut v[..2]), Err(Error::Range(_))));
    Ok(())
}

#[test]
fn settings_come_back_as_they_were_set() -> mlcp::Result<()> {
    let settings = Settings::new()
        .method(Method::Simplex)
        .pivot_rule(PivotRule::Printed)
        .refactorize(Refactorize::Always)
        .trace(true)
        .tolerance(1e-10)
        .max_iterations(100)
        .max_work(1_000_000)
        .max_time(Duration::from_millis(1500))
        .impulses(Impulses::LeastNorm)
        .canonical(true)
        .warm_start(false)
        .num_threads(2);
    let mut solver = Solver::new()?;
    assert_eq!(solver.settings(), Settings::default());
    solver.set_settings(&settings)?;
    assert_eq!(solver.settings(), settings);
    let report = solver.solve(&block_on_table()?)?;
    assert_eq!((report.outcome, report.method), (Outcome::Solved, Method::Simplex));
    assert!(report.factorizations >= report.pivots);

    let refused = solver.set_settings(&settings.clone().tolerance(-1.0));
    assert!(matches!(&refused, Err(Error::Argument(text)) if text.contains("tolerance")), "{refused:?}");
    assert!(matches!(Solver::with_settings(&settings.clone().tolerance(f64::NAN)), Err(Error::Argument(_))));
    assert!(matches!(solver.set_settings(&settings.clone().method(Method::Unknown(77))), Err(Error::Argument(_))));
    assert_eq!(solver.settings(), settings, "a call that fails changes nothing");
    solver.trim()?;
    assert_eq!(solver.impulses()?.len(), 2);
    Ok(())
}

#[test]
fn every_method_solves() -> mlcp::Result<()> {
    let problem = block_on_table()?;
    for method in [Method::Auto, Method::Simplex, Method::Newton, Method::Pgs] {
        let mut solver = Solver::with_settings(&Settings::new().method(method))?;
        let report = solver.solve(&problem)?;
        assert_eq!(report.outcome, Outcome::Solved, "{method:?}");
        assert!(method == Method::Auto || report.method == method || report.fallbacks > 0, "{report:?}");
        assert!((solver.impulses()?[0] - 0.1).abs() < 1e-9, "{method:?}");
    }
    Ok(())
}

#[test]
fn equal_loads_where_there_is_a_choice() -> mlcp::Result<()> {
    // three rows for one velocity
    let mut problem = Problem::new()?;
    problem.add_body(1, &[1.0])?;
    problem.set_momentum(0, &[-0.9])?;
    for _ in 0..3 {
        problem.add_row(&Row::unilateral(&[0], &[1.0]))?;
    }
    let mut solver = Solver::with_settings(&Settings::new().impulses(Impulses::LeastNorm))?;
    assert!(solver.solve(&problem)?.is_solved());
    assert!(solver.impulses()?.iter().all(|gamma| (gamma - 0.3).abs() < 1e-12), "{:?}", solver.impulses()?);
    Ok(())
}

#[test]
fn rows_start_by_their_keys_unless_told_not_to() -> mlcp::Result<()> {
    let (problem, mut solver) = (block_on_table()?, Solver::new()?);
    assert!(!solver.solve(&problem)?.warm);
    assert!(solver.solve(&problem)?.warm);
    solver.set_settings(&Settings::new().warm_start(false))?;
    assert!(!solver.solve(&problem)?.warm);
    Ok(())
}

#[test]
fn masks_carry_impulses_too() -> mlcp::Result<()> {
    let (problem, mut solver) = (block_on_table()?, Solver::new()?);
    let _ = solver.solve(&problem)?;
    let mut start = Mask::new(2, RowState::ACTIVE)?;
    let mut gamma = [0.0; 2];
    assert!(matches!(start.read_impulses(0, &mut gamma), Err(Error::State(_))));
    start.carry(&problem, solver.mask()?, RowState::AT_LOWER)?;
    start.read_impulses(0, &mut gamma)?;
    assert_eq!(gamma, solver.impulses()?);
    start.set_impulses(1, &[7.0])?;
    start.read_impulses(1, &mut gamma[..1])?;
    assert_eq!(gamma[0], 7.0);
    assert!(matches!(start.set_impulses(1, &gamma), Err(Error::Range(_))));
    Ok(())
}

#[test]
fn limits_end_a_solve() -> mlcp::Result<()> {
    let problem = block_on_table()?;
    for (settings, outcome) in [
        (Settings::new().max_iterations(1), Outcome::IterationLimit),
        (Settings::new().max_work(1), Outcome::WorkLimit),
        (Settings::new().max_time(Duration::from_nanos(1)), Outcome::TimeLimit),
    ] {
        let mut solver = Solver::with_settings(&settings)?;
        assert_eq!(solver.solve(&problem)?.outcome, outcome, "{settings:?}");
    }
    Ok(())
}

#[test]
fn several_threads_solve_one_problem_and_a_solver_moves_between_threads() -> mlcp::Result<()> {
    let problem = block_on_table()?;
    let mut here = Solver::new()?;
    let _ = here.solve(&problem)?;
    let expected = here.impulses()?.to_vec();
    thread::scope(|scope| {
        let solve = || -> mlcp::Result<Solver> {
            let mut solver = Solver::new()?;
            let _ = solver.solve(&problem)?;
            Ok(solver)
        };
        let threads = [scope.spawn(solve), scope.spawn(solve)];
        for solver in threads.map(|thread| thread.join().unwrap().unwrap()) {
            assert_eq!(solver.impulses().unwrap(), expected);
        }
    });
    Ok(())
}
