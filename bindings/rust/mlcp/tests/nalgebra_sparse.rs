//! Matrices of nalgebra-sparse in and out, vectors of nalgebra out.
#![cfg(feature = "nalgebra-sparse")]
use mlcp::{Compressed, Error, Problem, Row, RowFields, Solver, SparseMatrix, Triangle};
use nalgebra_sparse::na::{DMatrix, DVector};
use nalgebra_sparse::{CscMatrix, CsrMatrix};

fn mass() -> DMatrix<f64> {
    DMatrix::from_row_slice(3, 3, &[2.0, 0.5, 0.0, 0.5, 3.0, 0.0, 0.0, 0.0, 1.0])
}
fn jacobian() -> DMatrix<f64> {
    DMatrix::from_row_slice(2, 3, &[1.0, 0.0, -1.0, 0.0, 1.0, 1.0])
}

#[test]
fn rows_and_columns_give_the_same_problem_and_its_solution_satisfies_the_equations() -> mlcp::Result<()> {
    let (m, j, k) = (mass(), jacobian(), DVector::from_column_slice(&[-1.0, -2.0, 0.5]));
    let (m_by_rows, m_by_columns) = (CsrMatrix::from(&m), CscMatrix::from(&m));
    let (j_by_rows, j_by_columns) = (CsrMatrix::from(&j), CscMatrix::from(&j));
    let problems = [
        Problem::from_matrices(&m_by_rows, k.as_slice(), &j_by_columns, &RowFields::default())?,
        Problem::from_matrices(&m_by_columns, k.as_slice(), &j_by_rows, &RowFields::default())?,
    ];
    for problem in problems {
        assert_eq!(CsrMatrix::try_from(problem.jacobian()?)?, j_by_rows);
        assert_eq!(CscMatrix::try_from(problem.jacobian()?)?, j_by_columns);
        assert_eq!(CscMatrix::try_from(problem.mass()?)?, m_by_columns);
        assert_eq!(CsrMatrix::try_from(problem.mass()?)?, m_by_rows);
        let mut solver = Solver::new()?;
        assert!(solver.solve(&problem)?.is_solved());
        let (v, gamma, w) = (solver.velocity_vector()?, solver.impulse_vector()?, solver.slack_vector()?);
        assert!((&m * v - j.transpose() * gamma - &k).amax() < 1e-14);
        assert!((&j * v - w).amax() < 1e-14 && gamma.min() >= 0.0 && w.min() > -1e-14 && gamma.dot(&w).abs() < 1e-14);
        assert!(std::ptr::eq(v.as_slice(), solver.velocities()?), "lent, not copied");
    }
    Ok(())
}

#[test]
fn triangles_are_those_of_the_matrix_whatever_its_order() -> mlcp::Result<()> {
    let (lower, expected) = (mass().lower_triangle(), CscMatrix::from(&mass()));
    let mut problem = Problem::new()?;
    problem.add_matrix_body(&CsrMatrix::from(&lower), Triangle::Lower)?;
    assert_eq!(CscMatrix::try_from(problem.mass()?)?, expected);
    problem.clear()?;
    problem.add_matrix_body(&CscMatrix::from(&lower), Triangle::Lower)?;
    assert_eq!(CscMatrix::try_from(problem.mass()?)?, expected);

    let fields = RowFields { r: Some(&[1.0, 2.0, -1.0]), ..Default::default() };
    let reduced = Problem::reduced(&CsrMatrix::from(&mass().upper_triangle()), Triangle::Upper, &fields)?;
    assert_eq!(CscMatrix::try_from(reduced.compliance()?)?, expected);
    let mut solver = Solver::new()?;
    assert!(solver.solve(&reduced)?.is_solved());
    let z: DVector<f64> = solver.impulse_vector()?.into_owned();
    assert!((mass() * &z - DVector::from_column_slice(&[1.0, 2.0, 0.0])).rows(0, 2).amax() < 1e-14 && z[2] == 0.0);
    Ok(())
}

#[test]
fn lines_that_are_not_sorted_come_out_sorted() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[1.0, 2.0, 3.0])?;
    problem.add_row(&Row::bilateral(&[2, 0], &[5.0, 4.0]))?;
    let expected = CsrMatrix::from(&DMatrix::from_row_slice(1, 3, &[4.0, 0.0, 5.0]));
    assert_eq!(CsrMatrix::try_from(problem.jacobian()?)?, expected);
    assert_eq!(CscMatrix::try_from(problem.jacobian()?)?, CscMatrix::from(&expected));
    Ok(())
}

#[test]
fn values_stay_where_they_are_and_shapes_are_checked_by_name() -> mlcp::Result<()> {
    let (mass, wide) = (CscMatrix::from(&mass()), CsrMatrix::from(&DMatrix::<f64>::zeros(1, 4)));
    let matrix = SparseMatrix::try_from(&mass)?;
    assert_eq!((matrix.rows(), matrix.columns(), matrix.is_borrowed()), (3, 3, false));
    let fields = RowFields::default();
    let refused = |result: mlcp::Result<Problem>, expected: &str| {
        let error = result.unwrap_err();
        assert!(matches!(&error, Error::Range(text) if text == expected), "{error}");
    };
    refused(Problem::from_matrices(&mass, &[0.0; 3], &wide, &fields), "jacobian has 4 columns, but there are 3 velocities");
    refused(Problem::from_matrices(&mass, &[0.0; 2], &wide, &fields), "momentum has length 2, but 3 is needed");
    refused(Problem::from_matrices(&wide, &[0.0; 3], &wide, &fields), "mass is 1 x 4, but must be square");
    refused(Problem::reduced(&wide, Triangle::Full, &fields), "the matrix of a reduced problem is 1 x 4, but must be square");
    let cut = Compressed { pointers: &[0, 3], indices: &[0, 1], values: &[1.0, 2.0] };
    assert!(SparseMatrix::csr(1, 3, cut).is_err() && SparseMatrix::csc(1, 3, cut).is_err());
    Ok(())
}
