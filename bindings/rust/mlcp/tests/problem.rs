//! Assembly: what goes in comes out, and what must not go in is refused by name.
use mlcp::{Body, Compressed, Error, Problem, Row, RowFields, RowFieldsMut, Rows, Strided, Triangle, strided};

const MASS: [f64; 4] = [2.0, 0.5, 0.5, 3.0];

/// r, lo, hi, compliance and keys of all rows.
fn fields(problem: &Problem) -> ([Vec<f64>; 4], Vec<u64>) {
    let m = problem.row_count();
    let [mut r, mut lo, mut hi, mut compliance] = [const { Vec::new() }; 4].map(|_: Vec<f64>| vec![0.0; m]);
    let mut key = vec![0; m];
    let to = RowFieldsMut {
        r: Some(&mut r),
        lo: Some(&mut lo),
        hi: Some(&mut hi),
        compliance: Some(&mut compliance),
        key: Some(&mut key),
    };
    problem.read_rows(to).unwrap();
    ([r, lo, hi, compliance], key)
}

fn refused<T: std::fmt::Debug>(result: mlcp::Result<T>, expected: &str) {
    let error = result.unwrap_err();
    assert!(error.to_string().contains(expected), "\"{error}\" instead of \"{expected}\"");
}

#[test]
fn bodies_dense_sparse_strided_and_removed() -> mlcp::Result<()> {
    #[repr(C)]
    struct Thing {
        name: u8,
        mass: [f64; 4],
    }
    let things = [1, 2].map(|name| Thing { name, mass: MASS });
    assert_eq!(things[1].name, 2);

    let mut problem = Problem::new()?;
    let dense = problem.add_body(2, &MASS)?;
    let packed = problem.add_bodies(1, &[4.0, 5.0])?;
    let in_place = problem.add_bodies(2, strided!(&things, Thing, mass))?;
    let lower = Compressed { pointers: &[0, 2, 3], indices: &[0, 1, 1], values: &[2.0, 1.0, 2.0] };
    let sparse = problem.add_sparse_body(2, lower, Triangle::Lower)?;
    assert_eq!(problem.bodies()?, [0, 1, 2, 3, 4, 5].map(Body::from_id));
    assert_eq!((dense, packed.len(), in_place.len(), sparse.id()), (Body::from_id(0), 2, 2, 5));
    assert_eq!((problem.velocity_count(), problem.body_count()), (10, 6));
    assert_eq!(problem.body_range(sparse)?, 8..10);

    problem.remove_body(packed[0])?;
    assert_eq!(problem.body_range(sparse)?, 7..9);
    assert_eq!(problem.add_body(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])?, packed[0]);
    problem.set_mass(sparse, &[5.0, 1.0, 6.0])?;
    let mass = problem.mass()?;
    assert_eq!((mass.rows, mass.columns, mass.entries.pointers.len()), (12, 12, 13));
    assert_eq!(mass.entries.values[mass.entries.values.len() - 4..], [5.0, 1.0, 6.0, 1.0]);

    problem.set_prescribed(dense, &[1.0, -1.0])?;
    assert_eq!(problem.prescribed_velocity(dense)?, Some(vec![1.0, -1.0]));
    problem.set_dynamic(dense)?;
    assert_eq!(problem.prescribed_velocity(dense)?, None);

    problem.set_momentum(1, &[7.0, 8.0])?;
    let mut k = vec![0.0; 12];
    problem.read_momentum(&mut k)?;
    assert_eq!(k[..3], [0.0, 7.0, 8.0]);
    problem.clear()?;
    assert_eq!((problem.body_count(), problem.velocity_count(), problem.row_count()), (0, 0, 0));
    Ok(())
}

#[test]
fn rows_in_bulk_from_slices_and_from_structs_in_both_precisions() -> mlcp::Result<()> {
    #[derive(Clone, Copy)]
    struct Pair<T> {
        a: Body,
        b: Body,
        jacobian_a: [T; 3],
        jacobian_b: [T; 3],
        r: T,
        hi: T,
        key: u64,
    }
    let mut problem = Problem::new()?;
    let small = problem.add_body(2, &MASS)?;
    let large = problem.add_body(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])?;

    // packed: the world takes no numbers
    let (a, b) = ([small, Body::WORLD, large], [large, small, Body::WORLD]);
    let rows = &Rows::new(3)
        .body_a(&a)
        .body_b(&b)
        .jacobian_a(&[1.0, 2.0, 3.0, 4.0, 5.0])
        .jacobian_b(&[6.0, 7.0, 8.0, 9.0, 10.0])
        .r(&[0.1, 0.2, 0.3])
        .lo(&[-1.0, f64::NEG_INFINITY, 0.0])
        .hi(&[1.0, 2.0, 3.0])
        .compliance(&[0.0, 0.5, 0.0])
        .key(&[11, 12, 13]);
    assert_eq!(problem.add_rows(rows)?, 0..3);
    let jacobian = problem.jacobian()?.entries;
    assert_eq!(jacobian.pointers, [0, 5, 7, 10]);
    assert_eq!(jacobian.indices, [0, 1, 2, 3, 4, 0, 1, 2, 3, 4]);
    assert_eq!(jacobian.values, [1.0, 2.0, 6.0, 7.0, 8.0, 9.0, 10.0, 3.0, 4.0, 5.0]);
    let ([r, lo, hi, compliance], key) = fields(&problem);
    assert_eq!((r, lo, key), (vec![0.1, 0.2, 0.3], vec![-1.0, f64::NEG_INFINITY, 0.0], vec![11, 12, 13]));
    assert_eq!((hi, compliance), (vec![1.0, 2.0, 3.0], vec![0.0, 0.5, 0.0]));

    // in structs: blocks as wide as the largest body
    macro_rules! add_pairs {
        ($real:ty) => {{
            let pair =
                |a, b, r| Pair::<$real> { a, b, jacobian_a: [1.0, 2.0, 3.0], jacobian_b: [4.0, 5.0, 6.0], r, hi: 9.0, key: 5 };
            let pairs = [pair(small, large, 0.25), pair(large, Body::WORLD, 0.5)];
            let rows = Rows::new(2)
                .body_a(strided!(&pairs, Pair<$real>, a))
                .body_b(strided!(&pairs, Pair<$real>, b))
                .jacobian_a(strided!(&pairs, Pair<$real>, jacobian_a))
                .jacobian_b(strided!(&pairs, Pair<$real>, jacobian_b))
                .r(strided!(&pairs, Pair<$real>, r))
                .hi(strided!(&pairs, Pair<$real>, hi))
                .key(strided!(&pairs, Pair<$real>, key));
            problem.add_rows(&rows)?
        }};
    }
    assert_eq!(add_pairs!(f64), 3..5);
    assert_eq!(add_pairs!(f32), 5..7);
    let jacobian = problem.jacobian()?.entries;
    assert_eq!(jacobian.pointers[3..], [10, 15, 18, 23, 26]);
    assert_eq!(jacobian.values[10..18], [1.0, 2.0, 4.0, 5.0, 6.0, 1.0, 2.0, 3.0]);
    assert_eq!(jacobian.values[10..18], jacobian.values[18..26]);
    let ([r, lo, hi, _], key) = fields(&problem);
    assert_eq!((&r[3..], &lo[3..], &hi[3..]), (&[0.25, 0.5, 0.25, 0.5][..], &[0.0; 4][..], &[9.0; 4][..]));
    assert_eq!(key[3..], [5; 4]);
    Ok(())
}

#[test]
fn rows_over_velocities_one_by_one_and_compressed_both_ways() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[1.0, 2.0, 3.0])?;
    assert_eq!(problem.add_row(&Row::bilateral(&[2, 0], &[1.0, -1.0]).r(0.5).compliance(0.25).key(9))?, 0);
    let by_rows = Compressed { pointers: &[0, 2, 3], indices: &[0, 2, 1], values: &[1.0, 3.0, 2.0] };
    let by_columns = Compressed { pointers: &[0, 1, 2, 3], indices: &[0, 1, 0], values: &[1.0, 2.0, 3.0] };
    let given = RowFields { r: Some(&[1.0, 2.0]), key: Some(&[3, 4]), ..RowFields::default() };
    assert_eq!(problem.add_rows_csr(by_rows, &given)?, 1..3);
    assert_eq!(problem.add_rows_csc(2, by_columns, &given)?, 3..5);
    let jacobian = problem.jacobian()?;
    assert_eq!((jacobian.rows, jacobian.columns), (5, 3));
    assert_eq!(jacobian.entries.values, [1.0, -1.0, 1.0, 3.0, 2.0, 1.0, 3.0, 2.0]);
    assert_eq!(jacobian.entries.indices[2..5], jacobian.entries.indices[5..]);
    assert_eq!(fields(&problem).0[0], [0.5, 1.0, 2.0, 1.0, 2.0]);

    problem.set_r(3, &[7.0, 8.0])?;
    problem.set_bounds(0, &[-1.0], &[1.0])?;
    problem.set_compliance(4, &[0.125])?;
    problem.set_keys(0, &[1])?;
    problem.set_jacobian(0, &[5.0, 6.0])?;
    problem.remove_rows(&[2, 1])?;
    let ([r, lo, hi, compliance], key) = fields(&problem);
    assert_eq!((r, key), (vec![0.5, 7.0, 8.0], vec![1, 3, 4]));
    assert_eq!((lo[0], hi[0], compliance), (-1.0, 1.0, vec![0.25, 0.0, 0.125]));
    assert_eq!(problem.jacobian()?.entries.values[..2], [5.0, 6.0]);

    let sigma = Compressed { pointers: &[0, 2, 3, 4], indices: &[0, 1, 1, 2], values: &[4.0, 1.0, 5.0, 6.0] };
    problem.set_compliance_matrix(sigma, Triangle::Lower)?;
    assert_eq!(problem.compliance()?.entries.values.iter().sum::<f64>(), 17.0);

    let copy = problem.try_clone()?;
    problem.clear_rows()?;
    assert_eq!((problem.row_count(), problem.entry_count(), copy.row_count(), copy.entry_count()), (0, 0, 3, 5));
    Ok(())
}

#[test]
fn arrays_that_are_too_short_never_reach_the_library() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    let body = problem.add_body(2, &MASS)?;
    let bodies = [body];
    let one = Rows::new(1).body_a(&bodies);
    refused(problem.add_rows(&one.jacobian_a(&[1.0])), "jacobian_a has length 1, but 2 is needed");
    refused(problem.add_rows(&one.jacobian_a(Strided::from(&[[1.0]]))), "blocks of 1 numbers, but body 0 of row 0 needs 2");
    refused(problem.add_rows(&one.jacobian_a(&[1.0, 2.0]).r(&[])), "r has length 0, but 1 is needed");
    refused(problem.add_rows(&Rows::<f64>::new(2).body_a(&[body])), "body_a has length 1, but 2 is needed");
    refused(problem.add_bodies(2, &[1.0, 2.0, 3.0]), "masses");
    refused(problem.add_bodies(2, Strided::from(&[[1.0]])), "every mass has length 1, but 4 is needed");
    let cut = Compressed { pointers: &[0, 3], indices: &[0, 1], values: &[1.0, 2.0] };
    refused(problem.add_rows_csr(cut, &RowFields::default()), "indices has length 2, but pointers end at 3");
    refused(problem.add_rows_csc(1, cut, &RowFields::default()), "pointers has length 2, but 3 is needed");
    refused(problem.add_sparse_body(1, cut, Triangle::Full), "indices has length 2, but pointers end at 3");
    refused(problem.add_row(&Row::unilateral(&[0, 1], &[1.0])), "values has length 1, but 2 is needed");
    refused(problem.set_bounds(0, &[0.0], &[]), "hi has length 0, but 1 is needed");
    refused(problem.read_momentum(&mut [0.0]), "k has length 1, but 2 is needed");
    refused(problem.read_rows(RowFieldsMut { r: Some(&mut [0.0]), ..Default::default() }), "r has length 1, but 0 is needed");
    assert_eq!(problem.row_count(), 0);
    Ok(())
}

#[test]
fn what_the_library_refuses_is_an_error_of_its_kind_with_its_text() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    let body = problem.add_body(2, &MASS)?;
    let error = problem.add_body(2, &[1.0, 2.0, 3.0, 4.0]).unwrap_err();
    assert!(matches!(&error, Error::Argument(text) if text.contains("not symmetric")), "{error:?}");
    let error = problem.add_row(&Row::unilateral(&[5], &[1.0])).unwrap_err();
    assert_eq!(error, Error::Range("columns[0] = 5 is not one of 2 velocities".into()));
    let error = problem.add_rows(&Rows::<f64>::new(1).body_a(&[body])).unwrap_err();
    assert_eq!(error, Error::Missing("jacobian_a is NULL, but body_a[0] = 0 is not the world".into()));
    let error = problem.add_rows(&Rows::new(1).body_a(&[Body::from_id(8)]).jacobian_a(&[] as &[f64])).unwrap_err();
    assert!(matches!(&error, Error::Range(text) if text.contains("body_a[0] = 8")), "{error:?}");
    // pointers that rise and fall again reach beyond their entries in between
    let back = Compressed { pointers: &[0, 9, 1], indices: &[0], values: &[1.0] };
    let error = problem.add_rows_csr(back, &RowFields::default()).unwrap_err();
    assert_eq!(error, Error::Argument("row_pointers[2] = 1 is below row_pointers[1] = 9".into()));
    problem.add_row(&Row::unilateral(&[0], &[1.0]))?;
    assert!(matches!(problem.remove_body(Body::from_id(7)), Err(Error::Range(_))));
    let source: &dyn std::error::Error = &error;
    assert!(source.to_string().starts_with("bad argument: "));
    Ok(())
}

#[test]
fn strides_that_the_library_cannot_mix_are_refused() -> mlcp::Result<()> {
    struct Wide {
        r: f64,
        _more: f64,
    }
    let mut problem = Problem::new()?;
    let wide = [0.0, 1.0].map(|r| Wide { r, _more: 0.0 });
    let rows = Rows::new(2).r(strided!(&wide, Wide, r)).hi(&[1.0, 1.0]);
    refused(problem.add_rows(&rows), "hi has a stride of 8 bytes, but r one of 16");
    assert_eq!(problem.add_rows(&Rows::new(2).r(strided!(&wide, Wide, r)))?, 0..2);
    Ok(())
}

#[test]
fn room_can_be_made_and_given_back() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    problem.reserve(10, 60, 100, 1200)?;
    problem.trim()?;
    refused(problem.reserve(usize::MAX, 0, 0, 0), "does not fit 32 bits");
    assert_eq!(problem.body_count(), 0);
    Ok(())
}

#[test]
fn time_step_helpers() -> mlcp::Result<()> {
    let mut problem = Problem::new()?;
    problem.add_bodies(1, &[2.0, 4.0])?;
    problem.set_momentum_of_step(0.5, &[1.0, 2.0], &[3.0, -3.0])?;
    let mut k = [0.0; 2];
    problem.read_momentum(&mut k)?;
    assert_eq!(k, [3.5, 6.5]);

    let mut r = [0.0; 2];
    mlcp::timestep::rows(0.5, 0.5, false, &[1.0, -1.0], Some(&[0.25, 0.0]), &mut r)?;
    assert_eq!(r, [-1.25, 1.0]);
    let mut bounced = [-2.0, -2.0];
    mlcp::timestep::restitution(0.5, 0.1, &[0.5, 0.5], &[1.0, 9.0], &[-4.0, -4.0], None, &mut bounced)?;
    assert_eq!(bounced, [2.0, -2.0]);
    let spring = mlcp::timestep::spring(0.5, 2.0, 1.0, 4.0)?;
    assert_eq!((spring.compliance, spring.r), (1.0, -4.0));
    let soft = mlcp::timestep::erp_cfm(0.5, 0.25, 1.0, 2.0)?;
    assert_eq!((soft.compliance, soft.r), (2.0, -1.0));
    assert!(matches!(mlcp::timestep::spring(-1.0, 1.0, 1.0, 0.0), Err(Error::Argument(_))));
    refused(mlcp::timestep::rows(0.5, 0.5, false, &[1.0], None, &mut []), "r has length 0, but 1 is needed");
    Ok(())
}
