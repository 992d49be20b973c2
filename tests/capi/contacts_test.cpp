#include <cstddef>
#include <limits>

#include "support.h"

using namespace capi;

namespace {

/// A contact in space between a body of 3 velocities and the world, the normal along the last one.
struct Contacts : testing::Test {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();
  int32_t body = add_body(p, 3, 2);
  const double jacobian[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
  const double mu = 0.5;
  const uint64_t key = 77;
  mlcp_contacts contacts;

  Contacts() {
    mlcp_contacts_init(&contacts, sizeof contacts);
    contacts.count = 1;
    contacts.body_a = &body;
    contacts.jacobian_a = jacobian;
    contacts.mu = &mu;
    contacts.key = &key;
  }
  void add() { ASSERT_EQ(mlcp_problem_contacts_add(p, &contacts, nullptr), MLCP_OK) << mlcp_problem_error(p); }
  void push(double x, double y, double down) {
    const double k[] = {x, y, -down};
    ASSERT_EQ(mlcp_problem_set_momentum(p, 0, 3, k), MLCP_OK);
  }
};

mlcp_report solve(const SolverHandle& solver, const mlcp_problem* p, const mlcp_mask* start = nullptr) {
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  EXPECT_EQ(mlcp_solve(solver.get(), p, nullptr, start, &report), MLCP_OK) << mlcp_solver_error(solver.get());
  return report;
}

mlcp_contact_state state_of(const SolverHandle& solver, int32_t contact) {
  const mlcp_contact_state* state = nullptr;
  int32_t count = 0;
  EXPECT_EQ(mlcp_solver_contact_states(solver.get(), &state, &count), MLCP_OK);
  return contact < count ? state[contact] : uint8_t(255);
}

}  // namespace

TEST_F(Contacts, DefaultsAreAsDocumented) {
  mlcp_contacts c;
  mlcp_contacts_init(&c, sizeof c);
  EXPECT_EQ(c.struct_size, sizeof c);
  EXPECT_EQ(c.dimension, 3);
  EXPECT_EQ(c.model, nullptr);
  mlcp_contacts_f32 f;
  mlcp_contacts_f32_init(&f, sizeof f);
  EXPECT_EQ(f.dimension, 3);
  mlcp_settings s;
  mlcp_settings_init(&s, sizeof s);
  EXPECT_EQ(s.facets, 0);
  EXPECT_EQ(s.max_shifts, 0);
}

TEST_F(Contacts, RowsAreTheCallersAndCarryTheKey) {
  int32_t first = -1;
  add_row(p, {0}, {1});
  ASSERT_EQ(mlcp_problem_contacts_add(p, &contacts, &first), MLCP_OK);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(mlcp_problem_row_count(p), 4);
  EXPECT_EQ(mlcp_problem_contact_count(p), 1);
  uint64_t keys[4];
  double lo[4], hi[4];
  ASSERT_EQ(mlcp_problem_get_rows(p, 4, nullptr, lo, hi, nullptr, keys), MLCP_OK);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(keys[i], key);
  EXPECT_EQ(lo[1], 0);
  EXPECT_EQ(hi[1], inf);
  EXPECT_EQ(lo[2], -inf);
  EXPECT_EQ(dense(jacobian_of(p), true), (std::vector<double>{1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0}));
  int32_t row = 0, dimension = 0, facets = -1;
  mlcp_friction model = -1;
  double coefficient = 0;
  ASSERT_EQ(mlcp_problem_get_contacts(p, 1, &row, &dimension, &model, &coefficient, &facets), MLCP_OK);
  EXPECT_EQ(row, 1);
  EXPECT_EQ(dimension, 3);
  EXPECT_EQ(model, MLCP_FRICTION_COULOMB);
  EXPECT_EQ(coefficient, 0.5);
  EXPECT_EQ(facets, 0);
  EXPECT_EQ(mlcp_problem_get_contacts(p, 2, &row, nullptr, nullptr, nullptr, nullptr), MLCP_ERROR_RANGE);
}

TEST_F(Contacts, SlidesAndSticks) {
  add();
  const SolverHandle solver = make_solver();
  push(3, 4, 4);  // slides: |k_T| = 5 > µ 4
  mlcp_report report = solve(solver, p);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_EQ(state_of(solver, 0), MLCP_CONTACT_SLIDING);
  EXPECT_EQ(report.contacts_sliding, 1);
  std::vector<double> g = impulses(solver.get());
  EXPECT_NEAR(g[0], 4, 1e-8);
  EXPECT_NEAR(g[1], -1.2, 1e-8);
  EXPECT_NEAR(g[2], -1.6, 1e-8);
  const int32_t* facets = nullptr;
  int32_t count = 0;
  ASSERT_EQ(mlcp_solver_contact_facets(solver.get(), &facets, &count), MLCP_OK);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(facets[0], report.facets);
  EXPECT_GE(facets[0], 7);  // one was aimed at the slip

  push(0.3, 0.4, 4);
  report = solve(solver, p);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_EQ(state_of(solver, 0), MLCP_CONTACT_STICKING);
  g = impulses(solver.get());
  const double rounding = 16 * 4 * std::numeric_limits<double>::epsilon() / 2;  // of the facets' impulses, each at most 4 N·s
  EXPECT_NEAR(g[1], -0.3, rounding);
  EXPECT_NEAR(g[2], -0.4, rounding);
}

TEST_F(Contacts, SinglePrecisionGivesTheSameProblem) {
  const float jacobian32[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0}, mu32 = 0.5f;
  mlcp_contacts_f32 c;
  mlcp_contacts_f32_init(&c, sizeof c);
  c.count = 1;
  c.body_a = &body;
  c.jacobian_a = jacobian32;
  c.mu = &mu32;
  c.key = &key;
  ProblemHandle other = make_problem();
  add_body(other.get(), 3, 2);
  ASSERT_EQ(mlcp_problem_contacts_add_f32(other.get(), &c, nullptr), MLCP_OK) << mlcp_problem_error(other.get());
  add();
  EXPECT_EQ(snapshot(p), snapshot(other.get()));
}

TEST_F(Contacts, StridesReachIntoTheCallersStructs) {
  struct Engine {
    int32_t a, b;
    double jacobian_a[9], jacobian_b[9], r[3], compliance[3], mu, bound;
    mlcp_friction model;
    int32_t facets;
    uint64_t key;
  } list[2] = {};
  const int32_t second = add_body(p, 3, 1);
  for (int c = 0; c < 2; ++c) {
    list[c] = {body, c ? second : MLCP_WORLD, {0, 0, 1, 1, 0, 0, 0, 1, 0}, {0, 0, -1, -1, 0, 0, 0, -1, 0}, {1, 2, 3}, {4, 5, 6}, 0.25 + c, 7,
               c ? MLCP_FRICTION_BOX : MLCP_FRICTION_CONVEX, 8, uint64_t(100 + c)};
  }
  mlcp_contacts c;
  mlcp_contacts_init(&c, sizeof c);
  c.count = 2;
  c.body_a = &list[0].a;
  c.body_b = &list[0].b;
  c.jacobian_a = list[0].jacobian_a;
  c.jacobian_b = list[0].jacobian_b;
  c.r = list[0].r;
  c.compliance = list[0].compliance;
  c.mu = &list[0].mu;
  c.bound = &list[0].bound;
  c.model = &list[0].model;
  c.facets = &list[0].facets;
  c.key = &list[0].key;
  c.jacobian_a_stride = c.jacobian_b_stride = c.vector_stride = c.value_stride = c.choice_stride = c.body_stride = c.key_stride = sizeof(Engine);
  ASSERT_EQ(mlcp_problem_contacts_add(p, &c, nullptr), MLCP_OK) << mlcp_problem_error(p);
  double r[6], lo[6], hi[6], compliance[6], mus[2];
  uint64_t keys[6];
  mlcp_friction model[2];
  ASSERT_EQ(mlcp_problem_get_rows(p, 6, r, lo, hi, compliance, keys), MLCP_OK);
  ASSERT_EQ(mlcp_problem_get_contacts(p, 2, nullptr, nullptr, model, mus, nullptr), MLCP_OK);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(r[i], 1 + i % 3);
    EXPECT_EQ(compliance[i], 4 + i % 3);
    EXPECT_EQ(keys[i], uint64_t(100 + i / 3));
  }
  EXPECT_EQ(mus[1], 1.25);
  EXPECT_EQ(model[1], MLCP_FRICTION_BOX);
  EXPECT_EQ(hi[4], 7);
  EXPECT_EQ(lo[5], -7);
  EXPECT_EQ(mlcp_problem_entry_count(p), 9 + 18);
}

TEST_F(Contacts, RefusesAndChangesNothing) {
  const auto refused = [&](mlcp_status status, const char* part) {
    expect_refused(p, status, part, [&] { return mlcp_problem_contacts_add(p, &contacts, nullptr); });
  };
  for (const double bad : {-0.1, inf, not_a_number}) {
    contacts.mu = &bad;
    refused(MLCP_ERROR_ARGUMENT, "mu[0]");
  }
  contacts.mu = &mu;
  contacts.dimension = 4;
  refused(MLCP_ERROR_ARGUMENT, "dimension = 4");
  contacts.dimension = 3;
  const mlcp_friction unknown = 9;
  contacts.model = &unknown;
  refused(MLCP_ERROR_ARGUMENT, "model[0] = 9");
  contacts.model = nullptr;
  const int32_t two = 2;
  contacts.facets = &two;
  refused(MLCP_ERROR_ARGUMENT, "facets[0] = 2");
  contacts.facets = nullptr;
  const double negative = -1;
  contacts.bound = &negative;
  refused(MLCP_ERROR_ARGUMENT, "bound[0]");
  contacts.bound = nullptr;
  contacts.body_b = &body;
  refused(MLCP_ERROR_NULL, "jacobian_b");
  contacts.body_b = nullptr;
  contacts.count = -1;
  refused(MLCP_ERROR_RANGE, "count");
  contacts.struct_size = 4;
  refused(MLCP_ERROR_ARGUMENT, "struct_size");
}

TEST_F(Contacts, OlderStructTakesDefaultsForWhatItLacks) {
  mlcp_contacts_init(&contacts, offsetof(mlcp_contacts, mu));
  contacts.count = 1;
  contacts.body_a = &body;
  contacts.jacobian_a = jacobian;
  add();
  double coefficient = -1;
  ASSERT_EQ(mlcp_problem_get_contacts(p, 1, nullptr, nullptr, nullptr, &coefficient, nullptr), MLCP_OK);
  EXPECT_EQ(coefficient, 0);
}

TEST_F(Contacts, RowsGoOnlyTogether) {
  add();
  add_row(p, {0}, {1});
  const int32_t normal = 0, all[] = {0, 2, 1};
  expect_refused(p, MLCP_ERROR_STATE, "contact 0", [&] { return mlcp_problem_rows_remove(p, 1, &normal); });
  add();
  ASSERT_EQ(mlcp_problem_rows_remove(p, 3, all), MLCP_OK) << mlcp_problem_error(p);
  int32_t row = 0;
  ASSERT_EQ(mlcp_problem_get_contacts(p, 1, &row, nullptr, nullptr, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(row, 1);
  ASSERT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
  EXPECT_EQ(mlcp_problem_contact_count(p), 0);
}

TEST_F(Contacts, DeclaredOverRowsThatAreThere) {
  for (int i = 0; i < 6; ++i) add_row(p, {i % 3}, {1});
  const int32_t rows[] = {3, 0};
  ASSERT_EQ(mlcp_problem_contacts_declare(p, 2, 3, rows, nullptr, nullptr, nullptr, nullptr), MLCP_OK) << mlcp_problem_error(p);
  const int32_t again = 5, beyond = 4;
  expect_refused(p, MLCP_ERROR_RANGE, "row[0] = 5", [&] { return mlcp_problem_contacts_declare(p, 1, 2, &again, nullptr, nullptr, nullptr, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "row[0] = 4", [&] { return mlcp_problem_contacts_declare(p, 1, 2, &beyond, nullptr, nullptr, nullptr, nullptr); });
  const double lo = -1, hi = 1;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "normal", [&] { return mlcp_problem_rows_set_bounds(p, 3, 1, &lo, &hi); });
}

TEST_F(Contacts, FrictionChangesInPlace) {
  add();
  push(3, 4, 4);
  const SolverHandle solver = make_solver();
  const mlcp_friction none = MLCP_FRICTION_NONE, box = MLCP_FRICTION_BOX, findex = MLCP_FRICTION_FINDEX;
  const double bound = 1;
  ASSERT_EQ(mlcp_problem_contacts_set_friction(p, 0, 1, &none, nullptr, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(solve(solver, p).shift_iterations, 0);
  EXPECT_EQ(impulses(solver.get())[1], 0);
  ASSERT_EQ(mlcp_problem_contacts_set_friction(p, 0, 1, &box, nullptr, &bound, nullptr), MLCP_OK);
  EXPECT_EQ(solve(solver, p).outcome, MLCP_SOLVED);
  EXPECT_EQ(impulses(solver.get())[2], -1);
  ASSERT_EQ(mlcp_problem_contacts_set_friction(p, 0, 1, &findex, nullptr, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(solve(solver, p).outcome, MLCP_SOLVED);
  EXPECT_NEAR(impulses(solver.get())[2], -2, 1e-9);
  int32_t coupled[3];
  ASSERT_EQ(mlcp_problem_get_findex(p, 3, coupled), MLCP_OK);
  EXPECT_EQ(coupled[0], -1);
  EXPECT_EQ(coupled[2], 0);
}

TEST_F(Contacts, FindexRefuses) {
  for (int i = 0; i < 3; ++i) add_row(p, {i}, {1});
  const double lo[] = {0, -0.5, -0.5}, hi[] = {inf, 0.5, 0.5};
  ASSERT_EQ(mlcp_problem_rows_set_bounds(p, 0, 3, lo, hi), MLCP_OK);
  const auto refused = [&](std::vector<int32_t> findex, mlcp_status status, const char* part) {
    expect_refused(p, status, part, [&] { return mlcp_problem_rows_set_findex(p, 0, 3, findex.data()); });
  };
  refused({-1, 1, 0}, MLCP_ERROR_RANGE, "findex[1] = 1");
  refused({-1, 3, 0}, MLCP_ERROR_RANGE, "findex[1] = 3");
  refused({-1, 0, 1}, MLCP_ERROR_ARGUMENT, "findex[2] = 1");
  refused({1, -1, -1}, MLCP_ERROR_ARGUMENT, "findex[0]");
  const int32_t findex[] = {-1, 0, 0};
  ASSERT_EQ(mlcp_problem_rows_set_findex(p, 0, 3, findex), MLCP_OK);
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[0]", [&] { return mlcp_problem_rows_set_bounds(p, 1, 1, lo, hi); });
  const int32_t normal = 0;
  expect_refused(p, MLCP_ERROR_STATE, "bounds row", [&] { return mlcp_problem_rows_remove(p, 1, &normal); });
}

TEST_F(Contacts, SnapshotReplaysToTheSameBits) {
  add();
  const mlcp_friction box = MLCP_FRICTION_BOX;
  const double bound = 0.25;
  contacts.model = &box;
  contacts.bound = &bound;
  add();
  push(3, 4, 4);
  const SolverHandle solver = make_solver();
  solve(solver, p);
  const mlcp_mask* mask = nullptr;
  ASSERT_EQ(mlcp_solver_mask(solver.get(), &mask), MLCP_OK);
  MaskHandle start = make_mask(0);
  ASSERT_EQ(mlcp_mask_carry(start.get(), p, mask, MLCP_ROW_AT_LOWER), MLCP_OK);
  const Bytes bytes = snapshot(p, solver.get(), nullptr, start.get());
  mlcp_problem* q = nullptr;
  mlcp_solver* other = nullptr;
  mlcp_mask* other_start = nullptr;
  char message[512];
  ASSERT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, &q, &other, nullptr, &other_start, message, sizeof message), MLCP_OK)
      << message;
  const ProblemHandle owner(q);
  const SolverHandle replay(other);
  const MaskHandle replay_start(other_start);
  EXPECT_EQ(snapshot(q, nullptr, nullptr, other_start), snapshot(p, nullptr, nullptr, start.get()));
  const mlcp_report a = solve(solver, p, start.get()), b = solve(replay, q, other_start);
  EXPECT_EQ(impulses(solver.get()), impulses(replay.get()));
  EXPECT_EQ(a.shift_iterations, b.shift_iterations);
}

/// Written by version 0.1 of the library before it knew contacts: a mass of 2 on the ground, k = -3.
TEST_F(Contacts, SnapshotsOfVersion1AreStillRead) {
  const unsigned char bytes[] = {
      0x4d, 0x4c, 0x43, 0x50, 0x53, 0x4e, 0x41, 0x50, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xb4, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00, 0x34, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x72, 0x7d, 0x57, 0x78, 0x96, 0x0d, 0xc6, 0x05, 0x78, 0x9c, 0x63, 0x60, 0x40, 0x05,
      0x53, 0xaf, 0xa9, 0xbd, 0xe0, 0xd6, 0x13, 0xb4, 0x63, 0xc0, 0x01, 0x18, 0xa1, 0x98, 0x09, 0x4c, 0xc2, 0x44, 0x90, 0x80, 0x03, 0x84, 0xe2,
      0x38, 0x80, 0x26, 0x8e, 0x04, 0x3e, 0xd4, 0x23, 0x9b, 0x86, 0x69, 0xc6, 0x07, 0x7b, 0x1c, 0x66, 0x43, 0x01, 0x00, 0xcb, 0x0e, 0x06, 0xb3};
  mlcp_problem* old = nullptr;
  mlcp_solver* settings = nullptr;
  char message[512];
  ASSERT_EQ(mlcp_snapshot_read(bytes, sizeof bytes, nullptr, &old, &settings, nullptr, nullptr, message, sizeof message), MLCP_OK) << message;
  const ProblemHandle owner(old);
  const SolverHandle solver(settings);
  EXPECT_EQ(mlcp_problem_contact_count(old), 0);
  EXPECT_EQ(solve(solver, old).outcome, MLCP_SOLVED);
  EXPECT_EQ(impulses(solver.get()), std::vector<double>{3});
}

TEST_F(Contacts, CarriedMaskStartsWarm) {
  add();
  push(3, 4, 4);
  const SolverHandle solver = make_solver();
  const mlcp_report cold = solve(solver, p);
  const mlcp_mask* mask = nullptr;
  ASSERT_EQ(mlcp_solver_mask(solver.get(), &mask), MLCP_OK);
  MaskHandle last = make_mask(0), start = make_mask(0);
  ASSERT_EQ(mlcp_mask_carry(last.get(), p, mask, MLCP_ROW_AT_LOWER), MLCP_OK);
  ASSERT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
  add_row(p, {0}, {1});
  add();
  ASSERT_EQ(mlcp_mask_carry(start.get(), p, last.get(), MLCP_ROW_AT_LOWER), MLCP_OK);
  EXPECT_EQ(mlcp_mask_states(start.get())[1], MLCP_ROW_ACTIVE);
  const mlcp_report warm = solve(solver, p, start.get());
  EXPECT_EQ(warm.outcome, MLCP_SOLVED);
  EXPECT_LT(warm.shift_iterations, cold.shift_iterations);
}

TEST(ContactAllocation, AWholeStepIsFreeTheSecondTime) {
  Allocator allocator;
  mlcp_solver* made = nullptr;
  ASSERT_EQ(mlcp_solver_create(nullptr, allocator.hooks(), &made), MLCP_OK);
  const SolverHandle solver(made);
  const ProblemHandle problem = make_problem(allocator.hooks());
  mlcp_problem* p = problem.get();
  const int32_t bodies[] = {add_body(p, 3, 2), add_body(p, 3, 1), add_body(p, 3, 3)};
  const double jacobians[27] = {0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0.1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0}, mu[] = {0.3, 0.4, 0.5};
  const double k[] = {3, 4, -4, 1, 0.1, -8, 1, -2, -1};
  mlcp_contacts contacts;
  mlcp_contacts_init(&contacts, sizeof contacts);
  contacts.count = 3;
  contacts.body_a = bodies;
  contacts.jacobian_a = jacobians;
  contacts.mu = mu;
  for (int step = 0; step < 3; ++step) {
    if (step == 2) allocator.fail_at(0);
    ASSERT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
    ASSERT_EQ(mlcp_problem_contacts_add(p, &contacts, nullptr), MLCP_OK);
    ASSERT_EQ(mlcp_problem_set_momentum(p, 0, 9, k), MLCP_OK);
    mlcp_report report;
    mlcp_report_init(&report, sizeof report);
    ASSERT_EQ(mlcp_solve(solver.get(), p, nullptr, nullptr, &report), MLCP_OK) << mlcp_solver_error(solver.get());
    EXPECT_EQ(report.outcome, MLCP_SOLVED);
  }
  EXPECT_EQ(allocator.calls(), 0);
}

TEST(ContactAllocation, SolverIsMadeCleanlyOrNotAtAll) {
  Allocator allocator;
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY && n < 100; ++n) {
    allocator.fail_at(n);
    mlcp_solver* solver = nullptr;
    status = mlcp_solver_create(nullptr, allocator.hooks(), &solver);
    EXPECT_EQ(status == MLCP_OK, solver != nullptr);
    mlcp_solver_destroy(solver);
    EXPECT_EQ(allocator.blocks(), 0);
  }
  EXPECT_EQ(status, MLCP_OK);
}
