//! Settings, reports, problems and recordings through formats that are text and formats that are not.
#![cfg(feature = "serde")]
use std::time::Duration;

use mlcp::{Mask, Method, Outcome, Problem, Recording, Report, Row, RowState, Settings, Snapshot, Solver};

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
fn settings_are_read_with_defaults_and_written_whole() -> Result<(), serde_json::Error> {
    let settings: Settings = serde_json::from_str(r#"{"method": "simplex", "max_time": {"secs": 2, "nanos": 0}}"#)?;
    assert_eq!(settings, Settings::new().method(Method::Simplex).max_time(Duration::from_secs(2)));
    let settings = Settings::new().tolerance(1e-11).max_work(1 << 40).facets(8).canonical(true);
    assert_eq!(serde_json::from_str::<Settings>(&serde_json::to_string(&settings)?)?, settings);
    assert_eq!(postcard::from_bytes::<Settings>(&postcard::to_stdvec(&settings).unwrap()).unwrap(), settings);
    Ok(())
}

#[test]
fn settings_that_there_are_not_are_refused_by_name() {
    let error = serde_json::from_str::<Settings>(r#"{"tolerence": 1e-9}"#).unwrap_err().to_string();
    assert!(error.contains("`tolerence`") && error.contains("`tolerance`"), "{error}");
    let error = serde_json::from_str::<Settings>(r#"{"method": "magic"}"#).unwrap_err().to_string();
    assert!(error.contains("`magic`") && error.contains("`newton`"), "{error}");
    // a value that is none is refused where it is used
    let settings: Settings = serde_json::from_str(r#"{"tolerance": -1.0}"#).unwrap();
    assert!(matches!(Solver::with_settings(&settings), Err(mlcp::Error::Argument(_))));
}

#[test]
fn reports_come_back_and_what_is_infinite_stays_so() -> mlcp::Result<()> {
    let mut report = Solver::new()?.solve(&problem()?)?;
    report.cone_error = f64::INFINITY;
    let text = serde_json::to_string(&report).unwrap();
    assert!(text.contains(r#""outcome":"solved""#) && text.contains(r#""cone_error":null"#), "{text}");
    assert_eq!(serde_json::from_str::<Report>(&text).unwrap(), report);
    assert_eq!(postcard::from_bytes::<Report>(&postcard::to_stdvec(&report).unwrap()).unwrap(), report);
    let newer = serde_json::to_string(&Outcome::Unknown(99)).unwrap();
    assert_eq!((newer.as_str(), serde_json::from_str(&newer).unwrap()), (r#"{"unknown":99}"#, Outcome::Unknown(99)));
    Ok(())
}

#[test]
fn a_problem_that_was_sent_is_solved_to_the_same_bits() -> mlcp::Result<()> {
    let (problem, mut solver) = (problem()?, Solver::new()?);
    assert!(solver.solve(&problem)?.is_solved());
    let text = serde_json::to_string(&problem).unwrap();
    let bytes = postcard::to_stdvec(&problem).unwrap();
    let numbers = serde_json::to_string(&Snapshot::new(&problem).to_bytes()?).unwrap();
    assert!(text.starts_with('"') && bytes.len() < text.len() && text.len() < numbers.len(), "Base64 in text, bytes elsewhere");
    for sent in [serde_json::from_str::<Problem>(&text).unwrap(), postcard::from_bytes(&bytes).unwrap()] {
        let mut other = Solver::new()?;
        assert!(other.solve(&sent)?.is_solved());
        assert_eq!(other.velocities()?, solver.velocities()?);
        assert_eq!(other.impulses()?, solver.impulses()?);
    }
    Ok(())
}

#[test]
fn a_recording_brings_settings_and_masks_along() -> mlcp::Result<()> {
    let (problem, solver) = (problem()?, Solver::with_settings(&Settings::new().tolerance(1e-11))?);
    let enabled = Mask::from_states(&[RowState::ACTIVE, RowState::DISABLED, RowState::ACTIVE])?;
    let snapshot = Snapshot::new(&problem).solver(&solver).enabled(&enabled);
    let mut recording: Recording = serde_json::from_value(serde_json::to_value(snapshot).unwrap()).unwrap();
    assert_eq!((recording.enabled.as_ref(), recording.solver.settings()), (Some(&enabled), solver.settings()));
    assert_eq!(recording.replay()?.enabled_rows, 2);
    Ok(())
}

#[test]
fn damaged_problems_are_refused_with_the_librarys_text() {
    let error = serde_json::from_str::<Problem>(r#""AAAA""#).unwrap_err().to_string();
    assert!(error.contains("bad format"), "{error}");
    let error = serde_json::from_str::<Problem>(r#""not Base64""#).unwrap_err().to_string();
    assert!(error.contains("Invalid"), "{error}");
    let error = serde_json::from_str::<Problem>("7").unwrap_err().to_string();
    assert!(error.contains("a snapshot of libmlcp"), "{error}");
}
