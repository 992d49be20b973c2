//! Snapshots replay to the same bits, and damaged ones are refused.
use mlcp::{Error, Mask, Problem, Recording, Row, RowState, Settings, Snapshot, Solver};

fn problem() -> mlcp::Result<Problem> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[0.1, 0.7, 1.3])?;
    problem.set_momentum(0, &[-0.3, -0.7, 0.9])?;
    problem.add_row(&Row::unilateral(&[0], &[1.0]).key(4))?;
    problem.add_row(&Row::unilateral(&[0, 1], &[-1.0, 1.0]))?;
    problem.add_row(&Row::bilateral(&[1, 2], &[-1.0, 1.0]).compliance(0.01))?;
    Ok(problem)
}

#[test]
fn a_snapshot_brings_everything_back_from_bytes_and_from_a_file() -> mlcp::Result<()> {
    let (problem, mut solver) = (problem()?, Solver::with_settings(&Settings::new().tolerance(1e-11))?);
    let enabled = Mask::from_states(&[RowState::ACTIVE, RowState::DISABLED, RowState::ACTIVE])?;
    let start = Mask::from_states(&[RowState::AT_LOWER, RowState::DISABLED, RowState::ACTIVE])?;
    let report = solver.request(&problem).enabled(&enabled).start(&start).run()?;
    let snapshot = Snapshot::new(&problem).solver(&solver).enabled(&enabled).start(&start);

    let path = std::env::temp_dir().join(format!("mlcp-snapshot-test-{}.mlcp", std::process::id()));
    snapshot.save(&path)?;
    let from_file = Recording::load(&path);
    std::fs::remove_file(&path).unwrap();
    for mut recording in [from_file?, Recording::from_bytes(&snapshot.to_bytes()?)?] {
        assert_eq!(recording.enabled.as_ref(), Some(&enabled));
        assert_eq!(recording.start.as_ref(), Some(&start));
        assert_eq!(recording.solver.settings(), solver.settings());
        let again = recording.replay()?;
        assert_eq!((again.outcome, again.pivots, again.largest_error), (report.outcome, report.pivots, report.largest_error));
        assert_eq!(recording.solver.velocities()?, solver.velocities()?);
        assert_eq!(recording.solver.impulses()?, solver.impulses()?);
        // a body can be used with its dimension at once
        let body = recording.problem.bodies()?[2];
        recording.problem.add_rows(&mlcp::Rows::new(1).body_a(&[body]).jacobian_a(&[1.0]))?;
    }
    Ok(())
}

#[test]
fn masks_that_were_not_saved_are_none() -> mlcp::Result<()> {
    let mut recording = Recording::from_bytes(&Snapshot::new(&problem()?).to_bytes()?)?;
    assert!(recording.enabled.is_none() && recording.start.is_none());
    assert!(recording.replay()?.is_solved());
    Ok(())
}

#[test]
fn large_snapshots_fit() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    // digits that do not compress
    let masses: Vec<f64> = (1..20_000).map(|i| 1.0 + f64::from(i).sin().abs()).collect();
    problem.add_bodies(1, &masses)?;
    let bytes = Snapshot::new(&problem).to_bytes()?;
    assert!(bytes.len() > 1 << 16);
    assert_eq!(Recording::from_bytes(&bytes)?.problem.velocity_count(), masses.len());
    Ok(())
}

#[test]
fn damaged_snapshots_and_missing_files_are_refused_by_cause() -> mlcp::Result<()> {
    let mut bytes = Snapshot::new(&problem()?).to_bytes()?;
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    for damaged in [&bytes[..], &bytes[..middle], &[]] {
        let error = Recording::from_bytes(damaged).unwrap_err();
        assert!(matches!(&error, Error::Format(text) if !text.is_empty()), "{error:?}");
    }
    let error = Recording::load("/nowhere/at all.mlcp").unwrap_err();
    assert!(matches!(&error, Error::Io(text) if text.contains("/nowhere/at all.mlcp")), "{error:?}");
    let error = Snapshot::new(&problem()?).save("a\0b").unwrap_err();
    assert!(matches!(&error, Error::Argument(text) if text.contains("zero byte")), "{error:?}");
    Ok(())
}

#[test]
fn a_solve_that_fails_leaves_a_snapshot_that_fails_again() -> mlcp::Result<()> {
    let folder = std::env::temp_dir().join(format!("mlcp-failures-test-{}", std::process::id()));
    std::fs::create_dir(&folder).unwrap();
    let (mut problem, mut solver) = (problem()?, Solver::new()?);
    solver.keep_failures(Some(&folder), 1)?;
    assert!(solver.solve(&problem)?.is_solved());
    assert_eq!(solver.failure_file(), None);
    problem.add_row(&Row::bilateral(&[0], &[1.0]).r(1.0))?;
    problem.add_row(&Row::bilateral(&[0], &[1.0]).r(2.0))?;
    let report = solver.solve(&problem)?;
    let file = solver.failure_file().expect("it failed");
    let again = Recording::load(&file)?.replay()?;
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(!report.is_solved());
    assert_eq!(again.outcome, report.outcome);
    assert!(matches!(solver.keep_failures(Some(&folder), 10_001), Err(Error::Argument(_))));
    solver.keep_failures(None, 0)
}
