//! The cost of a call from Rust. This program and `call_cost.c` do the same steps: a row of bodies that lean on each other and on the
//! ground, 50 contacts, matched by key. `tests/bindings/rust` counts the instructions of both; the time is printed too.
//!
//!     cargo bench --bench call_cost -- STEPS
use std::process::ExitCode;
use std::time::Instant;

use mlcp::{Body, Mask, Problem, RowState, Rows, Solver};

const BODIES: usize = 25;
const ROWS: usize = 2 * BODIES;

struct Contacts {
    body_a: [Body; ROWS],
    body_b: [Body; ROWS],
    jacobian_a: [f64; 6 * ROWS],
    jacobian_b: [f64; 6 * BODIES],
    key: [u64; ROWS],
}

fn contacts(bodies: &[Body]) -> Contacts {
    let mut contacts = Contacts {
        body_a: [Body::WORLD; ROWS],
        body_b: [Body::WORLD; ROWS],
        jacobian_a: [0.0; 6 * ROWS],
        jacobian_b: [0.0; 6 * BODIES],
        key: [0; ROWS],
    };
    for i in 0..ROWS {
        let body = i % BODIES;
        contacts.body_a[i] = bodies[body];
        contacts.key[i] = i as u64 + 1;
        let axis = if i < BODIES { 2 } else { 0 }; // the ground pushes up, the neighbour to the left pushes on
        contacts.jacobian_a[6 * i + axis] = 1.0;
        contacts.jacobian_a[6 * i + 4] = 0.01 * body as f64;
        if i > BODIES {
            contacts.body_b[i] = bodies[body - 1];
            contacts.jacobian_b[6 * (body - 1)] = -1.0;
        }
    }
    contacts
}

fn mass() -> [f64; 36] {
    let mut mass = [0.0; 36];
    for j in 0..6 {
        mass[7 * j] = if j < 3 { 2.0 } else { 0.1 };
    }
    mass
}

fn run(steps: u32) -> mlcp::Result<f64> {
    let mut problem = Problem::new()?;
    let bodies = problem.add_bodies(6, &mass().repeat(BODIES))?;
    let contacts = contacts(&bodies);
    let mut solver = Solver::new()?;
    let mut start = Mask::new(0, RowState::AT_LOWER)?;
    let mut k = [0.0; 6 * BODIES];
    let mut sum = 0.0;
    for step in 0..steps {
        for (body, k) in k.chunks_exact_mut(6).enumerate() {
            k[0] = if (step as usize + body) % 7 == 0 { 0.02 } else { -0.1 };
            k[2] = -0.2;
        }
        problem.set_momentum(0, &k)?;
        problem.clear_rows()?;
        problem.add_rows(
            &Rows::new(ROWS)
                .body_a(&contacts.body_a)
                .body_b(&contacts.body_b)
                .jacobian_a(&contacts.jacobian_a)
                .jacobian_b(&contacts.jacobian_b[..6 * (BODIES - 1)])
                .key(&contacts.key),
        )?;
        let report = if step == 0 {
            solver.solve(&problem)?
        } else {
            start.carry(&problem, solver.mask()?, RowState::AT_LOWER)?;
            solver.request(&problem).start(&start).run()?
        };
        if !report.is_solved() {
            return Err(mlcp::Error::State(format!("{report:?}")));
        }
        sum += solver.impulses()?.iter().sum::<f64>() + solver.velocities()?[0];
    }
    Ok(sum)
}

fn main() -> ExitCode {
    // cargo adds --bench
    let steps = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(10_000);
    let begin = Instant::now();
    match run(steps) {
        Ok(sum) => {
            println!("sum {sum:.17e}");
            eprintln!("{:.2} µs a step", begin.elapsed().as_secs_f64() / f64::from(steps) * 1e6);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
