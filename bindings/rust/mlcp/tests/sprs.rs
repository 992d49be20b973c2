//! Matrices of sprs in and out, those with the library's own indices without a copy.
#![cfg(feature = "sprs")]
use mlcp::{Error, Problem, Row, RowFields, Solver, SparseMatrix};
use sprs::{CsMat, CsMatI, CsMatViewI, TriMatI};

fn matrix(shape: (usize, usize), entries: &[(usize, usize, f64)]) -> CsMatI<f64, i32> {
    let mut triplets = TriMatI::new(shape);
    for &(row, column, value) in entries {
        triplets.add_triplet(row, column, value);
    }
    triplets.to_csr()
}

fn mass() -> CsMatI<f64, i32> {
    matrix((3, 3), &[(0, 0, 2.0), (0, 1, 0.5), (1, 0, 0.5), (1, 1, 3.0), (2, 2, 1.0)])
}
fn jacobian() -> CsMatI<f64, i32> {
    matrix((2, 3), &[(0, 0, 1.0), (0, 2, -1.0), (1, 1, 1.0), (1, 2, 1.0)])
}

fn product(matrix: &CsMatViewI<'_, f64, i32>, vector: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; matrix.rows()];
    if matrix.is_csr() {
        sprs::prod::mul_acc_mat_vec_csr(matrix.view(), vector, &mut product[..]);
    } else {
        sprs::prod::mul_acc_mat_vec_csc(matrix.view(), vector, &mut product[..]);
    }
    product
}

#[test]
fn indices_of_32_bits_are_borrowed_and_wide_ones_narrowed() -> mlcp::Result<()> {
    let narrow = jacobian();
    let wide: CsMat<f64> = narrow.to_other_types();
    assert!(SparseMatrix::from(&narrow).is_borrowed());
    assert!(SparseMatrix::from(narrow.view()).is_borrowed());
    assert!(!SparseMatrix::try_from(&wide)?.is_borrowed());
    assert_eq!((SparseMatrix::try_from(&wide)?.rows(), SparseMatrix::try_from(&wide)?.columns()), (2, 3));
    Ok(())
}

#[test]
fn all_forms_give_the_same_problem_and_its_solution_satisfies_the_equations() -> mlcp::Result<()> {
    let (m, j, k, fields) = (mass(), jacobian(), [-1.0, -2.0, 0.5], RowFields::default());
    let (m_wide, j_wide): (CsMat<f64>, CsMat<f64>) = (m.to_other_types(), j.to_other_types());
    let problems = [
        Problem::from_matrices(&m, &k, &j, &fields)?,
        Problem::from_matrices(&m.to_csc(), &k, &j.to_csc(), &fields)?,
        Problem::from_matrices(&m_wide, &k, &j_wide.to_csc(), &fields)?,
        Problem::from_matrices(m.view(), &k, j_wide.view(), &fields)?,
    ];
    for problem in problems {
        // lent, and multiplied where it is
        let lent = CsMatViewI::try_from(problem.jacobian()?)?;
        assert_eq!(lent.to_owned(), j);
        assert_eq!(CsMat::try_from(problem.jacobian()?)?, j_wide);
        assert_eq!(CsMatI::try_from(problem.mass()?)?, m.to_csc());

        let mut solver = Solver::new()?;
        assert!(solver.solve(&problem)?.is_solved());
        let (v, gamma, w) = (solver.velocities()?, solver.impulses()?, solver.slacks()?);
        let (jv, mv, jt_gamma) = (product(&lent, v), product(&m.view(), v), product(&lent.transpose_view(), gamma));
        assert!(jv.iter().zip(w).all(|(jv, w)| (jv - w).abs() < 1e-14));
        assert!((0..3).all(|i| (mv[i] - jt_gamma[i] - k[i]).abs() < 1e-14));

        let sparse = solver.impulses_not_zero()?;
        assert_eq!(sparse.dim(), 2);
        assert_eq!(sparse.nnz(), gamma.iter().filter(|gamma| **gamma != 0.0).count());
        assert!(sparse.iter().all(|(row, &impulse)| impulse == gamma[row]));
    }
    Ok(())
}

#[test]
fn lines_out_of_the_middle_of_a_larger_matrix() -> mlcp::Result<()> {
    let tall = matrix((4, 3), &[(0, 1, 9.0), (1, 0, 1.0), (1, 2, -1.0), (2, 1, 1.0), (2, 2, 1.0), (3, 0, 9.0)]);
    let wide: CsMat<f64> = tall.to_other_types();
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[1.0; 3])?;
    problem.add_matrix_rows(tall.slice_outer(1..3), &RowFields::default())?;
    assert_eq!(CsMatI::try_from(problem.jacobian()?)?, jacobian());
    problem.clear_rows()?;
    problem.add_matrix_rows(wide.slice_outer(1..3), &RowFields::default())?;
    assert_eq!(CsMatI::try_from(problem.jacobian()?)?, jacobian());
    Ok(())
}

#[test]
fn a_view_of_lines_that_are_not_sorted_is_refused_and_a_copy_sorts_them() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[1.0; 3])?;
    problem.add_row(&Row::bilateral(&[2, 0], &[5.0, 4.0]))?;
    let error = CsMatViewI::try_from(problem.jacobian()?).unwrap_err();
    assert!(matches!(&error, Error::State(text) if text.contains("sprs")), "{error}");
    assert_eq!(CsMatI::try_from(problem.jacobian()?)?, matrix((1, 3), &[(0, 0, 4.0), (0, 2, 5.0)]));
    Ok(())
}

#[test]
fn a_view_of_one_problem_goes_into_another() -> mlcp::Result<()> {
    let problem = Problem::from_matrices(&mass(), &[0.0; 3], &jacobian(), &RowFields::default())?;
    let copy = Problem::from_matrices(problem.mass()?, &[0.0; 3], problem.jacobian()?, &RowFields::default())?;
    assert_eq!(CsMatI::try_from(copy.mass()?)?, mass().to_csc());
    assert_eq!(CsMatI::try_from(copy.jacobian()?)?, jacobian());
    Ok(())
}
