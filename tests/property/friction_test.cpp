#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "assemble/bodies.h"
#include "assemble/contacts.h"
#include "assemble/rows.h"
#include "assemble/values.h"
#include "contact_solver.h"
#include "friction/stewart_trinkle.h"
#include "support/build.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

using mlcp::Contact;
using mlcp::ContactVector;

struct Solved {
  mlcp_report report{};
  std::vector<double> v, gamma, w;
  std::vector<mlcp_contact_state> state;
  mlcp::Mask mask{mlcp::Memory()};
};

Solved solve_contacts(mlcp::ContactSolver& solver, const mlcp::Problem& p, const mlcp::Mask* start = nullptr, const mlcp::Mask* enabled = nullptr) {
  Solved s;
  solver.solve(p, enabled, start, s.report);
  const mlcp::Result& r = solver.result();
  s.v.assign(r.v.begin(), r.v.end());
  s.gamma.assign(r.gamma.begin(), r.gamma.end());
  s.w.assign(r.w.begin(), r.w.end());
  s.state.assign(solver.contact_states().begin(), solver.contact_states().end());
  s.mask.state.assign(r.mask.state.span());
  s.mask.slip.assign(r.mask.slip.span());
  return s;
}

Solved solve_contacts(const mlcp::Problem& p, std::int32_t facets = 0, double tolerance = 1e-10) {
  mlcp::Settings settings = mlcp::default_settings();
  settings.facets = facets;
  settings.tolerance = tolerance;
  mlcp::ContactSolver solver(settings, mlcp::Memory());
  return solve_contacts(solver, p);
}

/// A block of mass 2 on a slope in the plane: normal and tangent impulse on its two velocities. k: what a step would bring it.
mlcp::Problem block(double k_normal, double k_tangent, double mu, mlcp_friction model = MLCP_FRICTION_COULOMB) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 2);
  set_k(p, Eigen::Vector2d(k_normal, k_tangent));
  add_row(p, {{0, 1}});
  add_row(p, {{1, 1}});
  const std::int32_t row = 0;
  mlcp::contacts_declare(p, 1, 2, &row, {&model, &mu, nullptr, nullptr});
  return p;
}

TEST(Friction, block_on_a_slope_sticks_below_the_critical_angle_and_slides_above) {
  const double mu = 0.5, weight = 2 * 9.81 * 0.01;
  for (const double degrees : {5.0, 26.0, 27.0, 60.0}) {  // atan(0.5) = 26.565°
    const double angle = degrees * M_PI / 180, normal = weight * std::cos(angle), pull = weight * std::sin(angle);
    const Solved s = solve_contacts(block(-normal, pull, mu));
    ASSERT_EQ(s.report.outcome, MLCP_SOLVED);
    const bool slides = std::tan(angle) > mu;
    EXPECT_EQ(s.state[0], slides ? MLCP_CONTACT_SLIDING : MLCP_CONTACT_STICKING);
    EXPECT_NEAR(s.gamma[0], normal, 1e-15);
    EXPECT_NEAR(s.gamma[1], slides ? -mu * normal : -pull, 1e-15);
    EXPECT_NEAR(s.v[0], 0, 1e-15) << "Coulomb does not open";
    EXPECT_NEAR(s.v[1], slides ? (pull - mu * normal) / 2 : 0, 1e-15);
    EXPECT_EQ(s.mask.state[0], MLCP_ROW_ACTIVE);
    EXPECT_EQ(s.mask.state[1], slides ? MLCP_ROW_AT_LOWER : MLCP_ROW_ACTIVE);
  }
}

TEST(Friction, convex_model_opens_by_mu_times_the_slip) {
  const Solved s = solve_contacts(block(-1, 4, 0.5, MLCP_FRICTION_CONVEX));
  ASSERT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_NEAR(s.w[0], 0.5 * std::abs(s.w[1]), 1e-15);
  EXPECT_EQ(s.state[0], MLCP_CONTACT_SLIDING);
}

TEST(Friction, open_contact_does_nothing) {
  const Solved s = solve_contacts(block(1, 4, 0.5));
  EXPECT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_EQ(s.state[0], MLCP_CONTACT_OPEN);
  EXPECT_EQ(s.gamma[0], 0);
  EXPECT_EQ(s.gamma[1], 0);
}

TEST(Friction, box_bounds_follow_the_normal_impulse) {
  const Solved s = solve_contacts(block(-3, 4, 0.5, MLCP_FRICTION_FINDEX));
  ASSERT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_NEAR(s.gamma[1], -1.5, 1e-10);
  EXPECT_NEAR(s.v[0], 0, 1e-15);
}

TEST(Friction, findex_array_does_what_the_contact_does) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 2);
  set_k(p, Eigen::Vector2d(-3, 4));
  add_row(p, {{0, 1}});
  add_row(p, {{1, 1}}, 0, {-0.5, 0.5});
  const std::int32_t findex[] = {-1, 0};
  mlcp::rows_set_findex(p, 0, 2, findex);
  const Solved a = solve_contacts(p), b = solve_contacts(block(-3, 4, 0.5, MLCP_FRICTION_FINDEX));
  EXPECT_EQ(a.gamma, b.gamma);
  EXPECT_EQ(a.report.constraint_error, b.report.constraint_error);
}

TEST(Friction, fixed_box_is_plain_rows) {
  mlcp::Problem p = block(-3, 4, 0);
  const mlcp_friction model = MLCP_FRICTION_BOX;
  const double bound = 0.75;
  mlcp::contacts_set_friction(p, 0, 1, {&model, nullptr, &bound, nullptr});
  const Solved s = solve_contacts(p);
  EXPECT_EQ(s.gamma[1], -0.75);
  EXPECT_EQ(s.report.shift_iterations, 0);
}

/// Contacts at random between a few bodies and the world, in the plane or in space.
mlcp::Problem random_contacts(Random& random, int bodies, int contacts, int dimension, double mu, mlcp_friction model) {
  mlcp::Problem p = empty_problem();
  Eigen::VectorXd k(3 * bodies);
  for (int b = 0; b < bodies; ++b) add_body(p, 3, random.uniform(0.5, 2));
  for (int j = 0; j < k.size(); ++j) k[j] = random.uniform(-1, 1);
  set_k(p, k);
  std::vector<std::int32_t> row;
  for (int c = 0; c < contacts; ++c) {
    row.push_back(c * dimension);
    const int a = 3 * random.integer(0, bodies - 1), b = 3 * random.integer(0, bodies - 1);
    for (int t = 0; t < dimension; ++t) {
      std::vector<Entry> entries;
      for (int j = 0; j < 3; ++j) entries.push_back({a + j, random.uniform(-1, 1)});
      if (b != a)
        for (int j = 0; j < 3; ++j) entries.push_back({b + j, random.uniform(-1, 1)});
      add_row(p, entries);
    }
  }
  const std::vector<double> mus(contacts, mu);
  const std::vector<mlcp_friction> models(contacts, model);
  mlcp::contacts_declare(p, contacts, dimension, row.data(), {models.data(), mus.data(), nullptr, nullptr});
  return p;
}

/// The largest violation of Coulomb's law by its own definition, in N·s and m/s.
double violation_of_coulombs_law(const mlcp::Problem& p, const Solved& s) {
  double worst = 0;
  for (const Contact& c : p.contacts) {
    const ContactVector g = mlcp::contact_vector(c, s.gamma.data()), w = mlcp::contact_vector(c, s.w.data());
    const double slip = length(w.t), limit = c.mu * g.n;
    worst = std::max({worst, -g.n, -w.n, std::abs(g.n * w.n), length(g.t) - limit});
    if (slip > 1e-6) worst = std::max(worst, std::abs(dot(g.t, w.t) + limit * slip) / slip);
  }
  return worst;
}

TEST(Friction, coulombs_law_in_the_plane_at_random) {
  Random random(11);
  for (int round = 0; round < 40; ++round) {
    const mlcp::Problem p = random_contacts(random, 3, 4, 2, 0.3, MLCP_FRICTION_COULOMB);
    const Solved s = solve_contacts(p);
    ASSERT_EQ(s.report.outcome, MLCP_SOLVED) << "round " << round;
    EXPECT_LE(violation_of_coulombs_law(p, s), 1e-8) << "round " << round;
  }
}

TEST(Friction, coulombs_law_on_the_circular_cone_at_random) {
  Random random(12);
  for (int round = 0; round < 40; ++round) {
    const mlcp::Problem p = random_contacts(random, 4, 3, 3, 0.4, MLCP_FRICTION_COULOMB);
    const Solved s = solve_contacts(p);
    ASSERT_EQ(s.report.outcome, MLCP_SOLVED) << "round " << round << ", error " << s.report.largest_error;
    EXPECT_LE(violation_of_coulombs_law(p, s), 1e-8) << "round " << round;
  }
}

/// The convex pyramid as plain rows n + µ dⱼ t, every one of them.
mlcp::Problem with_all_generators(const mlcp::Problem& p, int facets) {
  const Dense d = dense(p);
  mlcp::Problem all = empty_problem();
  for (int b = 0; b < d.n() / 3; ++b) add_body(all, 3, static_cast<double>(d.M(3 * b, 3 * b)));
  set_k(all, d.k.cast<double>());
  for (const Contact& c : p.contacts)
    for (int j = 0; j < facets; ++j) {
      const double angle = 2 * M_PI * j / facets;
      const Vector row = d.J.row(c.row) + c.mu * (std::cos(angle) * d.J.row(c.row + 1) + std::sin(angle) * d.J.row(c.row + 2));
      std::vector<Entry> entries;
      for (int i = 0; i < row.size(); ++i)
        if (row[i] != 0) entries.push_back({i, static_cast<double>(row[i])});
      add_row(all, entries);
    }
  return all;
}

TEST(Friction, convex_pyramid_is_the_problem_of_all_its_generators) {
  Random random(13);
  for (const int facets : {3, 4, 8, 12}) {
    for (int round = 0; round < 10; ++round) {
      const mlcp::Problem p = random_contacts(random, 3, 3, 3, 0.6, MLCP_FRICTION_CONVEX);
      const Solved s = solve_contacts(p, facets, 1e-12);
      ASSERT_EQ(s.report.outcome, MLCP_SOLVED) << facets << " facets, round " << round;
      mlcp::ContactSolver plain(mlcp::default_settings(), mlcp::Memory());
      const Solved all = solve_contacts(plain, with_all_generators(p, facets));
      for (std::size_t j = 0; j < s.v.size(); ++j) EXPECT_NEAR(s.v[j], all.v[j], 1e-11) << facets << " facets, round " << round;
    }
  }
}

/// Two contacts in the plane, by trying open, stick, slip to either side at both: every solution of Coulomb's law.
std::vector<Vector> coulomb_solutions(const mlcp::Problem& p) {
  const Reduced reduced = reduce(dense(p));
  const int m = static_cast<int>(reduced.b.size()), contacts = m / 2;
  std::vector<Vector> found;
  for (int code = 0; code < (1 << (2 * contacts)); ++code) {
    // γ = B y with one or two unknowns a closed contact, C w = 0 as many equations
    Matrix B = Matrix::Zero(m, m), C = Matrix::Zero(m, m);
    int unknowns = 0;
    for (int c = 0; c < contacts; ++c) {
      const int mode = code >> (2 * c) & 3, n = 2 * c, t = n + 1;
      const Real mu = p.contacts[c].mu;
      if (mode == 1) {
        B(n, unknowns) = 1, C(unknowns++, n) = 1;
        B(t, unknowns) = 1, C(unknowns++, t) = 1;
      } else if (mode >= 2) {
        B(n, unknowns) = 1, B(t, unknowns) = mode == 2 ? mu : -mu, C(unknowns++, n) = 1;
      }
    }
    Vector gamma = Vector::Zero(m);
    if (unknowns > 0) {
      const Matrix K = C.topRows(unknowns) * reduced.A * B.leftCols(unknowns);
      if (std::abs(K.determinant()) < 1e-12L) continue;
      gamma = B.leftCols(unknowns) * K.fullPivLu().solve(-C.topRows(unknowns) * reduced.b);
    }
    const Vector w = reduced.A * gamma + reduced.b;
    bool holds = true;
    for (int c = 0; c < contacts; ++c) {
      const int mode = code >> (2 * c) & 3, n = 2 * c, t = n + 1;
      const Real mu = p.contacts[c].mu, zero = 1e-12L;
      holds &= gamma[n] >= -zero && w[n] >= -zero && std::abs(gamma[t]) <= mu * gamma[n] + zero;
      if (mode == 2) holds &= w[t] <= zero;
      if (mode == 3) holds &= w[t] >= -zero;
    }
    if (holds) found.push_back(gamma);
  }
  return found;
}

TEST(Friction, finds_one_of_the_solutions_that_enumeration_finds) {
  Random random(14);
  for (int round = 0; round < 60; ++round) {
    const mlcp::Problem p = random_contacts(random, 2, 3, 2, round % 2 ? 0.3 : 1.0, MLCP_FRICTION_COULOMB);
    const std::vector<Vector> all = coulomb_solutions(p);
    const Solved s = solve_contacts(p);
    if (all.empty()) continue;
    ASSERT_EQ(s.report.outcome, MLCP_SOLVED) << "round " << round;
    // the enumeration has vertices; where contacts depend on each other, the same velocity has other impulses too
    const Matrix A = reduce(dense(p)).A;
    Real nearest = 1e30L;
    for (const Vector& gamma : all) nearest = std::min(nearest, (A * (gamma - widen(s.gamma))).cwiseAbs().maxCoeff());
    EXPECT_LE(nearest, 1e-8L) << "round " << round;
  }
}

TEST(Friction, lemke_on_the_stewart_trinkle_form_finds_them_too) {
  Random random(15);
  int tried = 0;
  for (int round = 0; round < 60; ++round) {
    const mlcp::Problem p = random_contacts(random, 1, 3, 2, round % 2 ? 0.5 : 2.0, MLCP_FRICTION_COULOMB);
    const std::vector<Vector> all = coulomb_solutions(p);
    mlcp::StewartTrinkle lemke{mlcp::Memory()};
    const std::vector<std::int32_t> island(p.m(), 0);
    if (all.empty() || !lemke.solve(p, nullptr, island, 0, 0)) continue;
    ++tried;
    Real nearest = 1e30L;
    const Reduced reduced = reduce(dense(p));
    for (const Vector& gamma : all) {
      const Vector w = reduced.A * gamma + reduced.b;
      Real worst = 0;
      for (std::size_t c = 0; c < p.contacts.size(); ++c) worst = std::max(worst, std::abs(w[2 * int(c) + 1] - lemke.slip(p, c).x));
      nearest = std::min(nearest, worst);
    }
    EXPECT_LE(nearest, 1e-9L) << "round " << round;
  }
  EXPECT_GE(tried, 40);
}

TEST(Friction, frictionless_contacts_give_the_bits_of_plain_rows) {
  Random random(16);
  mlcp::Problem p = random_contacts(random, 4, 5, 3, 0.5, MLCP_FRICTION_NONE);
  mlcp::Problem plain(p, mlcp::Memory());
  mlcp::rows_clear(plain);
  for (const Contact& c : p.contacts) {
    std::vector<Entry> entries;
    for (std::int32_t e = p.jacobian.pointers[c.row]; e < p.jacobian.pointers[c.row + 1]; ++e)
      entries.push_back({p.jacobian.indices[e], p.jacobian.values[e]});
    add_row(plain, entries);
  }
  const Solved a = solve_contacts(p), b = solve_contacts(plain);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.report.shift_iterations, 0);
  EXPECT_EQ(a.report.generators, 0);
}

TEST(Friction, a_disabled_tangent_row_leaves_friction_out_and_a_disabled_normal_the_contact) {
  mlcp::Problem p = block(-3, 4, 0.5);
  mlcp::ContactSolver solver(mlcp::default_settings(), mlcp::Memory());
  const mlcp::Mask no_tangent = mask_of({MLCP_ROW_ACTIVE, MLCP_ROW_DISABLED}), no_normal = mask_of({MLCP_ROW_DISABLED, MLCP_ROW_ACTIVE});
  const Solved a = solve_contacts(solver, p, nullptr, &no_tangent);
  EXPECT_EQ(a.gamma[0], 3);
  EXPECT_EQ(a.gamma[1], 0);
  const Solved b = solve_contacts(solver, p, nullptr, &no_normal);
  EXPECT_EQ(b.gamma[0], 0);
  EXPECT_EQ(b.gamma[1], 0);
  EXPECT_EQ(b.state[0], MLCP_CONTACT_DISABLED);
}

TEST(Friction, warm_start_from_its_own_mask_takes_a_fraction_of_the_shifts) {
  Random random(17);
  const mlcp::Problem p = random_contacts(random, 4, 4, 3, 0.4, MLCP_FRICTION_COULOMB);
  mlcp::ContactSolver solver(mlcp::default_settings(), mlcp::Memory());
  const Solved cold = solve_contacts(solver, p), warm = solve_contacts(solver, p, &cold.mask);
  ASSERT_EQ(warm.report.outcome, MLCP_SOLVED);
  EXPECT_LE(4 * warm.report.shift_iterations, cold.report.shift_iterations);
}

TEST(Friction, squeezed_contact_is_infeasible_with_a_certificate_in_the_callers_rows) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  set_k(p, Eigen::Vector2d(0, 1));
  std::vector<std::int32_t> row;
  for (const double side : {1.0, -1.0}) {
    row.push_back(p.m());
    add_row(p, {{0, side}}, 1);
    add_row(p, {{1, 1}});
  }
  const std::vector<double> mu(2, 0.5);
  const std::vector<mlcp_friction> model(2, MLCP_FRICTION_CONVEX);
  mlcp::contacts_declare(p, 2, 2, row.data(), {model.data(), mu.data(), nullptr, nullptr});
  mlcp::ContactSolver solver(mlcp::default_settings(), mlcp::Memory());
  const Solved s = solve_contacts(solver, p);
  EXPECT_EQ(s.report.outcome, MLCP_INFEASIBLE);
  const mlcp::Result& r = solver.result();
  ASSERT_EQ(r.certificates.size(), 1u);
  const Dense d = dense(p);
  Vector jty = Vector::Zero(d.n());
  Real gap = 0;
  for (std::size_t i = 0; i < r.certificate_row.size(); ++i) {
    jty += r.certificate_y[i] * d.J.row(r.certificate_row[i]).transpose();
    gap += r.certificate_y[i] * d.r[r.certificate_row[i]];
  }
  EXPECT_LE(jty.cwiseAbs().maxCoeff(), 1e-12L);
  EXPECT_GT(gap, 0);
}

/// A unit mass between walls that close in on it, with friction on both and pulled along them.
mlcp::Problem between_closing_walls(const Eigen::Vector2d& k) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  set_k(p, k);
  std::vector<std::int32_t> row;
  for (const double side : {1.0, -1.0}) {
    row.push_back(p.m());
    add_row(p, {{0, side}}, 1);
    add_row(p, {{1, 1}});
  }
  const std::vector<double> mu(2, 0.5);
  mlcp::contacts_declare(p, 2, 2, row.data(), {nullptr, mu.data(), nullptr, nullptr});
  return p;
}

/// No slip resolves a conflict of normals, so that a look at them ends the iteration, and what proves it has no tangents.
TEST(Friction, normals_in_conflict_end_the_iteration_at_once) {
  mlcp::ContactSolver solver(mlcp::default_settings(), mlcp::Memory());
  for (const double pull : {0.0, 0.7}) {
    const Solved s = solve_contacts(solver, between_closing_walls({0, pull}));
    EXPECT_EQ(s.report.outcome, MLCP_INFEASIBLE);
    EXPECT_EQ(s.report.shift_iterations, 1);
    const mlcp::Result& r = solver.result();
    ASSERT_EQ(r.certificate_row.size(), 2u);
    EXPECT_EQ(r.certificate_row[0], 0);
    EXPECT_EQ(r.certificate_row[1], 2);
    EXPECT_EQ(r.certificate_y[0], r.certificate_y[1]);
    EXPECT_GT(r.certificate_y[0], 0);
  }
}

TEST(Friction, plain_rows_in_conflict_beside_a_contact_end_the_iteration_at_once) {
  mlcp::Problem p = block(-1, 4, 0.5);
  add_row(p, {{1, 1}}, 1, bilateral);
  add_row(p, {{1, 2}}, 5, bilateral);
  mlcp::ContactSolver solver(mlcp::default_settings(), mlcp::Memory());
  const Solved s = solve_contacts(solver, p);
  EXPECT_EQ(s.report.outcome, MLCP_INFEASIBLE);
  EXPECT_EQ(s.report.shift_iterations, 1);
  ASSERT_EQ(solver.result().certificate_row.size(), 2u);
  EXPECT_EQ(solver.result().certificate_row[0], 2);
  EXPECT_EQ(solver.result().certificate_row[1], 3);
}

/// The island in conflict waits for the others.
TEST(Friction, a_conflict_spoils_no_other_island) {
  mlcp::Problem p = between_closing_walls({0, 0});
  add_body(p, 2, 2);
  set_k(p, Eigen::Vector4d(0, 0, -1, 4));
  const std::int32_t row = p.m();
  add_row(p, {{2, 1}});
  add_row(p, {{3, 1}});
  const double mu = 0.5;
  mlcp::contacts_declare(p, 1, 2, &row, {nullptr, &mu, nullptr, nullptr});
  mlcp::ContactSolver solver(mlcp::default_settings(), mlcp::Memory());
  const Solved s = solve_contacts(solver, p);
  EXPECT_EQ(s.report.outcome, MLCP_INFEASIBLE);
  EXPECT_EQ(s.report.islands_failed, 1);
  EXPECT_LT(s.report.shift_iterations, 20);
  EXPECT_NEAR(s.v[2], 0, 1e-12);
  EXPECT_NEAR(s.v[3], (4 - mu) / 2, 1e-9);
}

/// A body held fast on a belt that runs below it: without a shift the rows inside contradict each other, and yet there is a solution.
TEST(Friction, what_conflicts_without_a_shift_alone_is_solved) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  set_k(p, Eigen::Vector2d(-1, 0));
  add_row(p, {{0, 1}});
  add_row(p, {{1, 1}}, 1);  // the belt
  add_row(p, {{0, 1}}, 0, bilateral);
  add_row(p, {{1, 1}}, 0, bilateral);
  const std::int32_t row = 0;
  const double mu = 0.5;
  mlcp::contacts_declare(p, 1, 2, &row, {nullptr, &mu, nullptr, nullptr});
  const Solved s = solve_contacts(p);
  EXPECT_EQ(s.report.outcome, MLCP_SOLVED);
  EXPECT_NEAR(s.v[0], 0, 1e-12);
  EXPECT_NEAR(s.v[1], 0, 1e-12);
}

TEST(Friction, work_limit_counts_all_solves) {
  Random random(17);
  const mlcp::Problem p = random_contacts(random, 4, 4, 3, 0.4, MLCP_FRICTION_COULOMB);
  mlcp::Settings settings = mlcp::default_settings();
  mlcp::ContactSolver free(settings, mlcp::Memory());
  const Solved all = solve_contacts(free, p);
  settings.max_work = all.report.work / 2;
  mlcp::ContactSolver limited(settings, mlcp::Memory());
  const Solved half = solve_contacts(limited, p);
  EXPECT_EQ(half.report.outcome, MLCP_WORK_LIMIT);
  EXPECT_LT(half.report.shift_iterations, all.report.shift_iterations);
  EXPECT_EQ(limited.settings().max_work, settings.max_work);
}

TEST(Friction, shift_limit_is_an_honest_outcome) {
  Random random(18);
  const mlcp::Problem p = random_contacts(random, 4, 4, 3, 0.9, MLCP_FRICTION_COULOMB);
  mlcp::Settings settings = mlcp::default_settings();
  settings.max_shifts = 1;
  mlcp::ContactSolver solver(settings, mlcp::Memory());
  const Solved s = solve_contacts(solver, p);
  EXPECT_EQ(s.report.shift_iterations, 1);
  EXPECT_EQ(s.report.outcome, s.report.largest_error <= 1e-9 ? MLCP_SOLVED : MLCP_ITERATION_LIMIT);
}

}  // namespace
}  // namespace support
