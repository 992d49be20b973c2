//! Problems solved from Rust, against the program `mlcp`, which is written in C++ on mlcp.h: the same bits. `tests/bindings/rust` runs it.
//! `MLCP_PROGRAM`: the program; `MLCP_PROBLEMS`: a folder of problems.
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use mlcp::{Compressed, MatrixView, Outcome, Problem, Recording, Report, RowFields, RowFieldsMut, Solver, Triangle};
use serde_json::Value;

/// The folders with a problem in `root` and the first one of every sequence.
fn problems(root: &Path) -> Vec<PathBuf> {
    let folders = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    let candidates = folders.flat_map(|folder| [folder.join("000"), folder]);
    let mut found: Vec<PathBuf> = candidates.filter(|folder| folder.join("meta.json").exists()).collect();
    found.sort();
    found
}

fn numbers(json: &Value) -> Vec<u64> {
    json.as_array().unwrap().iter().map(|number| number.as_f64().unwrap().to_bits()).collect()
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// What the program says about a snapshot: outcome, v, γ and pivots.
fn solved_by_program(program: &str, snapshot: &Path) -> (String, Vec<u64>, Vec<u64>, i64) {
    let output = Command::new(program).arg("solve").arg(snapshot).args(["--output", "json"]).output().unwrap();
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let outcome = json["status"].as_str().unwrap().to_owned();
    (outcome, numbers(&json["v"]), numbers(&json["gamma"]), json["iterations"].as_i64().unwrap())
}

const MOST_ROWS_WITH_FRICTION: usize = 100;

fn name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Solved => "solved",
        Outcome::IterationLimit => "iteration_limit",
        Outcome::Infeasible => "infeasible",
        Outcome::Unbounded => "unbounded",
        Outcome::NotPositiveDefinite => "not_positive_definite",
        other => panic!("{other:?} is not to be expected"),
    }
}

fn assert_same(report: &Report, solver: &Solver, expected: &(String, Vec<u64>, Vec<u64>, i64), how: &str) {
    let (outcome, v, gamma, pivots) = expected;
    assert_eq!((name(report.outcome), report.pivots), (outcome.as_str(), *pivots), "{how}");
    assert!(&bits(solver.velocities().unwrap()) == v, "{how}: v differs");
    assert!(&bits(solver.impulses().unwrap()) == gamma, "{how}: γ differs");
}

/// The columns of one body in M, as a matrix of its own.
fn block(mass: &MatrixView<'_>, range: std::ops::Range<usize>) -> (Vec<i32>, Vec<i32>, Vec<f64>) {
    let Compressed { pointers, indices, values } = mass.entries;
    let (begin, end) = (pointers[range.start] as usize, pointers[range.end] as usize);
    (
        pointers[range.start..=range.end].iter().map(|pointer| pointer - begin as i32).collect(),
        indices[begin..end].iter().map(|index| index - range.start as i32).collect(),
        values[begin..end].to_vec(),
    )
}

/// The same problem, assembled by calls of this crate.
fn assemble(from: &Problem) -> mlcp::Result<Problem> {
    let (n, m) = (from.velocity_count(), from.row_count());
    let mut problem = Problem::new()?;
    let mass = from.mass()?;
    for body in from.bodies()? {
        let range = from.body_range(body)?;
        let (pointers, indices, values) = block(&mass, range.clone());
        let mass = Compressed { pointers: &pointers, indices: &indices, values: &values };
        problem.add_sparse_body(range.len(), mass, Triangle::Full)?;
    }
    let mut k = vec![0.0; n];
    from.read_momentum(&mut k)?;
    problem.set_momentum(0, &k)?;

    let [mut r, mut lo, mut hi] = [const { Vec::new() }; 3].map(|_: Vec<f64>| vec![0.0; m]);
    let mut key = vec![0; m];
    from.read_rows(RowFieldsMut {
        r: Some(&mut r),
        lo: Some(&mut lo),
        hi: Some(&mut hi),
        key: Some(&mut key),
        ..RowFieldsMut::default()
    })?;
    let fields = RowFields { r: Some(&r), lo: Some(&lo), hi: Some(&hi), key: Some(&key), compliance: None };
    problem.add_rows_csr(from.jacobian()?.entries, &fields)?;
    problem.set_compliance_matrix(from.compliance()?.entries, Triangle::Full)?;
    problem.declare_contacts(&from.contacts()?)?;
    Ok(problem)
}

#[test]
#[ignore = "needs the program mlcp and a folder of problems"]
fn problems_are_solved_to_the_same_bits_as_from_c() -> mlcp::Result<()> {
    let program = env::var("MLCP_PROGRAM").expect("MLCP_PROGRAM names the program mlcp");
    let root = PathBuf::from(env::var_os("MLCP_PROBLEMS").expect("MLCP_PROBLEMS names a folder of problems"));
    let snapshot = env::temp_dir().join(format!("mlcp-same-bits-{}.mlcp", std::process::id()));
    let (mut solved, mut refused) = (0, 0);
    for folder in problems(&root) {
        let converted = Command::new(&program).arg("convert").arg(&folder).arg(&snapshot).output().unwrap();
        if !converted.status.success() {
            // not symmetric: there is nothing to solve for either
            assert_eq!(converted.status.code(), Some(3), "{}: {converted:?}", folder.display());
            refused += 1;
            continue;
        }
        let mut recording = Recording::load(&snapshot)?;
        // Coulomb's law on hundreds of rows takes seconds, three times over
        if !recording.problem.contacts()?.is_empty() && recording.problem.row_count() > MOST_ROWS_WITH_FRICTION {
            println!("left out, with friction: {}", folder.display());
            continue;
        }
        let expected = solved_by_program(&program, &snapshot);
        let report = recording.replay()?;
        assert_same(&report, &recording.solver, &expected, &format!("{}, replayed", folder.display()));

        let problem = assemble(&recording.problem)?;
        let mut solver = Solver::new()?;
        let report = solver.solve(&problem)?;
        assert_same(&report, &solver, &expected, &format!("{}, assembled", folder.display()));
        solved += 1;
        println!("{:>6} rows, {:>6} pivots, {}: {}", problem.row_count(), report.pivots, name(report.outcome), folder.display());
    }
    fs::remove_file(&snapshot).unwrap();
    println!("{solved} problems with the same bits, {refused} refused by the program");
    assert!(solved > 0);
    Ok(())
}
