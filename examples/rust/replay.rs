//! Does recorded solves again, from snapshots as `mlcp_snapshot_save`, `mlcp convert` and the example `step_scene` write them.
//!
//!     cargo run --release --example replay SNAPSHOT...
use mlcp::{Recording, Report};
use std::env::args_os;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    if args_os().len() < 2 {
        return Err("usage: replay SNAPSHOT...".into());
    }
    println!(
        "{:>8} {:>8} {:>8} {:>8} {:>8} {:>10}  outcome",
        "rows", "active", "islands", "pivots", "error", "ms"
    );
    for path in args_os().skip(1) {
        let mut recording = Recording::load(&path)?;
        let report = recording.replay()?;
        print(&recording, &report);
    }
    Ok(())
}

fn print(recording: &Recording, report: &Report) {
    let Report {
        active_rows,
        islands,
        pivots,
        largest_error,
        outcome,
        ..
    } = report;
    let (rows, milliseconds) = (
        recording.problem.row_count(),
        1e3 * report.times.total.as_secs_f64(),
    );
    println!(
        "{rows:>8} {active_rows:>8} {islands:>8} {pivots:>8} {largest_error:>8.0e} {milliseconds:>10.3}  {outcome:?}"
    );
}
