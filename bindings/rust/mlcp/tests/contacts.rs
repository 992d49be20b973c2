//! Contacts with friction: in bulk, from rows, changed, with findex; what they do, and what is refused by name.
use mlcp::{
    Body, Compressed, Contact, ContactState, Contacts, Error, Friction, FrictionFields, Problem, RowFields, RowFieldsMut,
    Settings, Solver, SparseMatrix, Strided, Triangle, strided,
};

/// A mass point in space; velocities x, y, z.
const POINT: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// The normal along z, the tangents along x and y.
const FRAME: [f64; 9] = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
const TWO_FRAMES: [f64; 18] = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// Of the body beneath.
const OPPOSITE: [f64; 9] = [0.0, 0.0, -1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0];

#[derive(Clone, Copy)]
struct Touch<T> {
    above: Body,
    beneath: Body,
    jacobian_a: [T; 9],
    jacobian_b: [T; 9],
    r: [T; 3],
    mu: T,
    model: Friction,
    feature: u64,
}

fn refused<T: std::fmt::Debug>(result: mlcp::Result<T>, expected: &str) {
    let error = result.unwrap_err();
    assert!(error.to_string().contains(expected), "\"{error}\" instead of \"{expected}\"");
}

/// Two points above each other on the ground, pushed sideways.
fn points() -> mlcp::Result<(Problem, [Body; 2])> {
    let mut problem = Problem::new()?;
    let ids = problem.add_bodies(3, &[POINT, POINT].concat())?;
    problem.set_momentum(0, &[0.25, 0.0, -1.0, 3.0, 0.0, -1.0])?;
    Ok((problem, [ids[0], ids[1]]))
}

fn solved(problem: &Problem) -> mlcp::Result<(Vec<f64>, Vec<f64>, Vec<ContactState>)> {
    let mut solver = Solver::new()?;
    let report = solver.solve(problem)?;
    assert!(report.is_solved() && report.largest_error <= 1e-9, "{report:?}");
    assert_eq!(solver.contact_facets()?.len(), problem.contact_count());
    let states = solver.contact_states()?.collect();
    Ok((solver.velocities()?.to_vec(), solver.impulses()?.to_vec(), states))
}

#[test]
fn contacts_in_bulk_are_the_same_from_slices_and_from_structs_in_both_precisions() -> mlcp::Result<()> {
    let (mut packed, [low, high]) = points()?;
    let (a, b) = ([low, high], [Body::WORLD, low]);
    let contacts = Contacts::spatial(2)
        .body_a(&a)
        .body_b(&b)
        .jacobian_a(&TWO_FRAMES)
        .jacobian_b(&OPPOSITE) // the world takes none
        .r(&[0.0, 0.0, 0.0, 0.125, 0.0, 0.0])
        .mu(&[0.5, 0.75])
        .model(&[Friction::COULOMB, Friction::CONVEX])
        .key(&[7, 8]);
    assert_eq!(packed.add_contacts(&contacts)?, 0..6);

    macro_rules! in_structs {
        ($real:ty) => {{
            let (mut problem, _) = points()?;
            let touch = |above, beneath, z, mu, model, feature| Touch::<$real> {
                above,
                beneath,
                jacobian_a: FRAME.map(|entry| entry as $real),
                jacobian_b: OPPOSITE.map(|entry| entry as $real),
                r: [z, 0.0, 0.0],
                mu,
                model,
                feature,
            };
            let touches =
                [touch(low, Body::WORLD, 0.0, 0.5, Friction::COULOMB, 7), touch(high, low, 0.125, 0.75, Friction::CONVEX, 8)];
            let contacts = Contacts::spatial(2)
                .body_a(strided!(&touches, Touch<$real>, above))
                .body_b(strided!(&touches, Touch<$real>, beneath))
                .jacobian_a(strided!(&touches, Touch<$real>, jacobian_a))
                .jacobian_b(strided!(&touches, Touch<$real>, jacobian_b))
                .r(strided!(&touches, Touch<$real>, r))
                .mu(strided!(&touches, Touch<$real>, mu))
                .model(strided!(&touches, Touch<$real>, model))
                .key(strided!(&touches, Touch<$real>, feature));
            assert_eq!(problem.add_contacts(&contacts)?, 0..6);
            problem
        }};
    }
    let expected = solved(&packed)?;
    for problem in [in_structs!(f64), in_structs!(f32)] {
        assert_eq!(problem.contacts()?, packed.contacts()?);
        let (ours, theirs) = (problem.jacobian()?.entries, packed.jacobian()?.entries);
        assert_eq!((ours.pointers, ours.indices, ours.values), (theirs.pointers, theirs.indices, theirs.values));
        let (mut r, mut key) = ([0.0; 6], [0; 6]);
        problem.read_rows(RowFieldsMut { r: Some(&mut r), key: Some(&mut key), ..Default::default() })?;
        assert_eq!((r, key), ([0.0, 0.0, 0.0, 0.125, 0.0, 0.0], [7, 7, 7, 8, 8, 8]));
        assert_eq!(solved(&problem)?, expected);
    }
    assert_eq!(expected.2, [ContactState::Sliding, ContactState::Sliding]);
    Ok(())
}

#[test]
fn coulombs_law_holds_in_what_comes_out() -> mlcp::Result<()> {
    let (mut problem, [low, high]) = points()?;
    let both = [low, high];
    problem.add_contacts(&Contacts::spatial(2).body_a(&both).jacobian_a(&TWO_FRAMES).mu(&[0.5, 0.5]))?;
    let (v, gamma, states) = solved(&problem)?;
    assert_eq!(states, [ContactState::Sticking, ContactState::Sliding]);
    assert!(v[0].abs() < 1e-9 && (gamma[1] + 0.25).abs() < 1e-9, "the slow one stops: {v:?}");
    assert!((v[3] - 2.5).abs() < 1e-9 && (gamma[4] + 0.5).abs() < 1e-9, "the fast one loses µ γ_n: {v:?}");
    assert!(v[2].abs() < 1e-9 && v[5].abs() < 1e-9, "sliding does not lift");

    problem.set_friction(1, &FrictionFields { mu: Some(&[4.0]), ..Default::default() })?;
    assert_eq!(solved(&problem)?.2, [ContactState::Sticking; 2]);
    problem.set_friction(0, &FrictionFields { model: Some(&[Friction::NONE; 2]), ..Default::default() })?;
    assert_eq!(solved(&problem)?.0, [0.25, 0.0, 0.0, 3.0, 0.0, 0.0]);
    let boxed = FrictionFields { model: Some(&[Friction::BOX; 2]), bound: Some(&[0.125, 0.25]), ..Default::default() };
    problem.set_friction(0, &boxed)?;
    let (v, ..) = solved(&problem)?;
    assert!((v[0] - 0.125).abs() < 1e-12 && (v[3] - 2.75).abs() < 1e-12, "{v:?}");
    Ok(())
}

#[test]
fn facets_are_counted_and_the_report_tells_of_contacts() -> mlcp::Result<()> {
    let (mut problem, [low, high]) = points()?;
    let bodies = [low, high];
    let contacts = Contacts::spatial(2).body_a(&bodies).jacobian_a(&TWO_FRAMES).mu(&[0.5, 0.5]);
    problem.add_contacts(&contacts.facets(&[4, 0]))?;
    assert_eq!(problem.contacts()?.iter().map(|contact| contact.facets).collect::<Vec<_>>(), [4, 0]);
    let mut solver = Solver::with_settings(&Settings::new().facets(6))?;
    let report = solver.solve(&problem)?;
    assert!(report.is_solved(), "{report:?}");
    assert_eq!((report.contacts_open, report.contacts_sticking, report.contacts_sliding), (0, 1, 1));
    assert_eq!(solver.contact_facets()?, [4, 6]);
    assert_eq!((report.facets, report.generators), (6, 10));
    assert!(report.cone_error <= report.largest_error && report.worst_contact.is_some() && report.shift_iterations > 0);
    Ok(())
}

#[test]
fn a_contact_declared_over_rows_is_the_one_added_in_bulk() -> mlcp::Result<()> {
    let (mut added, [low, _]) = points()?;
    added.add_contacts(&Contacts::spatial(1).body_a(&[low]).jacobian_a(&FRAME).mu(&[0.5]))?;
    let (mut declared, _) = points()?;
    let jacobian = Compressed { pointers: &[0, 3, 6, 9], indices: &[0, 1, 2, 0, 1, 2, 0, 1, 2], values: &FRAME };
    declared.add_rows_csr(jacobian, &RowFields::default())?;
    declared.declare_contacts(&[Contact { row: 0, dimension: 3, friction: Friction::COULOMB, mu: 0.5, facets: 0 }])?;
    assert_eq!(added.contacts()?, declared.contacts()?);
    assert_eq!(solved(&added)?, solved(&declared)?);
    Ok(())
}

#[test]
fn findex_goes_in_comes_back_and_bounds_follow_the_normal_impulse() -> mlcp::Result<()> {
    let a = Compressed { pointers: &[0, 1, 2, 3], indices: &[0, 1, 2], values: &[2.0, 1.0, 1.0] };
    let reduced = || SparseMatrix::csr(3, 3, a);
    let (r, lo, hi) = ([4.0, 5.0, -0.25], [0.0, -0.5, -0.5], [f64::INFINITY, 0.5, 0.5]);
    let fields = RowFields { r: Some(&r), lo: Some(&lo), hi: Some(&hi), ..Default::default() };
    let mut problem = Problem::reduced(reduced()?, Triangle::Full, &fields)?;
    problem.set_findex(1, &[0, 0])?;
    let mut findex = [9; 3];
    problem.read_findex(&mut findex)?;
    assert_eq!(findex, [-1, 0, 0]);
    // γ_n = 2, so that the first tangent row is at 0.5 · 2 and the second one is free
    assert_eq!(solved(&problem)?.1, [2.0, 1.0, -0.25]);

    refused(problem.set_findex(1, &[1]), "findex[0] = 1");
    refused(problem.read_findex(&mut [0]), "findex has length 1, but 3 is needed");
    refused(Problem::reduced(reduced()?, Triangle::Full, &RowFields { r: Some(&[1.0]), ..Default::default() }), "r has length 1");
    let soft = RowFields { compliance: Some(&[0.0; 3]), ..Default::default() };
    refused(Problem::reduced(reduced()?, Triangle::Full, &soft), "compliance");
    refused(SparseMatrix::csr(2, 2, a), "pointers has length 4, but 3 is needed");
    Ok(())
}

#[test]
fn contact_arrays_that_do_not_fit_never_reach_the_library() -> mlcp::Result<()> {
    let (mut problem, [low, high]) = points()?;
    let bodies = [low, high];
    let frame_arrays = [FRAME, FRAME];
    let two = Contacts::spatial(2).body_a(&bodies).jacobian_a(&TWO_FRAMES);
    refused(problem.add_contacts(&two.jacobian_a(&FRAME)), "jacobian_a has length 9, but 18 is needed");
    refused(
        problem.add_contacts(&two.jacobian_a(Strided::from(&[[0.0; 6], [0.0; 6]]))),
        "jacobian_a has blocks of 6 numbers, but body 0 of contact 0 needs 9",
    );
    refused(problem.add_contacts(&two.r(&[0.0; 5])), "r has length 5, but 6 is needed");
    refused(problem.add_contacts(&two.r(Strided::from(&[[0.0; 2]; 2]))), "r has blocks of 2 numbers, but 3 are needed");
    refused(problem.add_contacts(&two.compliance(Strided::from(&[[0.0; 3]; 1]))), "compliance has length 1, but 2 is needed");
    refused(problem.add_contacts(&two.mu(&[0.5])), "mu has length 1, but 2 is needed");
    refused(problem.add_contacts(&two.facets(&[4])), "facets has length 1, but 2 is needed");
    refused(
        problem.add_contacts(&two.r(&[0.0; 6]).compliance(Strided::from(&[[0.0; 4]; 2]))),
        "compliance has a stride of 32 bytes, but r one of 24",
    );
    refused(
        problem.set_friction(0, &FrictionFields { mu: Some(&[0.1]), facets: Some(&[]), ..Default::default() }),
        "facets has length 0",
    );
    assert_eq!((problem.row_count(), problem.contact_count()), (0, 0));

    // blocks in arrays of their own
    problem.add_contacts(&two.jacobian_a(Strided::from(&frame_arrays)).r(Strided::from(&[[0.0; 3]; 2])))?;
    assert_eq!((problem.row_count(), problem.contact_count()), (6, 2));
    Ok(())
}

#[test]
fn the_library_names_the_contact_that_it_refuses() -> mlcp::Result<()> {
    let (mut problem, [low, high]) = points()?;
    let bodies = [low, high];
    let two = Contacts::spatial(2).body_a(&bodies).jacobian_a(&TWO_FRAMES);
    refused(problem.add_contacts(&two.mu(&[0.5, -1.0])), "mu[1] = -1");
    refused(problem.add_contacts(&two.facets(&[0, 2])), "facets[1] = 2");
    assert!(matches!(problem.set_friction(3, &FrictionFields { mu: Some(&[0.5]), ..Default::default() }), Err(Error::Range(_))));
    assert_eq!(problem.row_count(), 0);
    Ok(())
}
