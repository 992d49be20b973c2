//! Islands on the threads of rayon: the same bits as without, from inside and outside of a pool.
#![cfg(feature = "rayon")]
use std::ops::ControlFlow;
use std::thread;

use mlcp::{Problem, Row, Settings, Solver};

/// Towers of bodies of one velocity, each large enough for a task of its own.
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
fn the_bits_are_those_of_one_thread_in_every_pool() -> mlcp::Result<()> {
    let (problem, mut solver) = (towers(8)?, Solver::with_settings(&Settings::new().warm_start(false))?);
    assert!(solver.solve(&problem)?.is_solved());
    let (v, gamma) = (solver.velocities()?.to_vec(), solver.impulses()?.to_vec());
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let report = pool.install(|| solver.request(&problem).rayon().run())?;
        assert!(report.is_solved() && report.islands == 8);
        assert_eq!((solver.velocities()?, solver.impulses()?), (&v[..], &gamma[..]), "{threads} threads");
    }
    // the pool that every program has
    assert!(solver.request(&problem).rayon().run()?.is_solved());
    assert_eq!((solver.velocities()?, solver.impulses()?), (&v[..], &gamma[..]));
    Ok(())
}

#[test]
fn solves_inside_of_parallel_iterators_do_not_block_each_other() -> mlcp::Result<()> {
    use rayon::prelude::*;
    let (problem, mut solver) = (towers(3)?, Solver::new()?);
    assert!(solver.solve(&problem)?.is_solved());
    let expected = solver.impulses()?.to_vec();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let all = pool.install(|| {
        (0..12)
            .into_par_iter()
            .map(|_| {
                let mut solver = Solver::new()?;
                let report = solver.request(&problem).rayon().run()?;
                Ok((report.is_solved(), solver.impulses()?.to_vec()))
            })
            .collect::<mlcp::Result<Vec<_>>>()
    })?;
    assert!(all.iter().all(|(solved, impulses)| *solved && *impulses == expected));
    Ok(())
}

#[test]
fn progress_is_told_on_the_thread_that_solves() -> mlcp::Result<()> {
    let (problem, mut solver) = (towers(4)?, Solver::new()?);
    let here = thread::current().id();
    let told_here = &mut |_: &mlcp::Progress| {
        assert_eq!(thread::current().id(), here);
        ControlFlow::Continue(())
    };
    assert!(solver.request(&problem).progress(told_here).rayon().run()?.is_solved());
    Ok(())
}
