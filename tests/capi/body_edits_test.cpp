#include "support.h"

using namespace capi;

namespace {

struct BodyEdits : testing::Test {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();

  int32_t offset(int32_t body) const {
    int32_t first = -1;
    EXPECT_EQ(mlcp_problem_body_range(p, body, &first, nullptr), MLCP_OK);
    return first;
  }
  std::vector<double> momentum() const {
    std::vector<double> k(mlcp_problem_velocity_count(p));
    EXPECT_EQ(mlcp_problem_get_momentum(p, static_cast<int32_t>(k.size()), k.data()), MLCP_OK);
    return k;
  }
};

}  // namespace

TEST_F(BodyEdits, DenseMassInPlace) {
  add_body(p, 2);
  const int32_t id = add_body(p, 2);
  const double mass[] = {5, 1, 1, 6};
  ASSERT_EQ(mlcp_problem_body_set_mass(p, id, mass, 4), MLCP_OK);
  EXPECT_EQ(mass_of(p).values, (std::vector<double>{1, 0, 0, 1, 5, 1, 1, 6}));
}

TEST_F(BodyEdits, DenseMassRefused) {
  const int32_t id = add_body(p, 2);
  const double indefinite[] = {1, 2, 2, 1}, asymmetric[] = {1, 0.5, 0, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "mass is not positive definite",
                 [&] { return mlcp_problem_body_set_mass(p, id, indefinite, 4); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "mass is not symmetric",
                 [&] { return mlcp_problem_body_set_mass(p, id, asymmetric, 4); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = 3", [&] { return mlcp_problem_body_set_mass(p, id, indefinite, 3); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = -1", [&] { return mlcp_problem_body_set_mass(p, id, indefinite, -1); });
  expect_refused(p, MLCP_ERROR_NULL, "mass is NULL", [&] { return mlcp_problem_body_set_mass(p, id, nullptr, 4); });
  expect_refused(p, MLCP_ERROR_RANGE, "body = 7", [&] { return mlcp_problem_body_set_mass(p, 7, indefinite, 4); });
  expect_refused(p, MLCP_ERROR_RANGE, "body = -1", [&] { return mlcp_problem_body_set_mass(p, MLCP_WORLD, indefinite, 4); });
}

TEST_F(BodyEdits, SparseMassInTheOrderGiven) {
  add_body(p, 1);
  const int32_t pointers[] = {0, 2, 3}, rows[] = {1, 0, 1};
  const double values[] = {0.5, 2, 3}, next[] = {-0.5, 4, 6};
  int32_t id = -1;
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_LOWER, &id), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_set_mass(p, id, next, 3), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(dense(mass_of(p), false), (std::vector<double>{1, 0, 0, 0, 4, -0.5, 0, -0.5, 6}));
}

TEST_F(BodyEdits, SparseMassRefused) {
  const int32_t pointers[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
  const double values[] = {2, 0.5, 0.5, 3}, asymmetric[] = {2, 0.5, 0.25, 3}, negative[] = {-2, 0, 0, 3};
  const double bad[] = {2, 0, not_a_number, 3};
  int32_t id = -1;
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL, &id), MLCP_OK);
  expect_refused(p, MLCP_ERROR_ARGUMENT, "mass[1] is not symmetric",
                 [&] { return mlcp_problem_body_set_mass(p, id, asymmetric, 4); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "diagonal entry 0", [&] { return mlcp_problem_body_set_mass(p, id, negative, 4); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "mass[2]", [&] { return mlcp_problem_body_set_mass(p, id, bad, 4); });
  const double equal[] = {2, HUGE_VAL, HUGE_VAL, 3}, heavy[] = {2, 0, 0, HUGE_VAL};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "mass[1]", [&] { return mlcp_problem_body_set_mass(p, id, equal, 4); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "mass[3]", [&] { return mlcp_problem_body_set_mass(p, id, heavy, 4); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = 3", [&] { return mlcp_problem_body_set_mass(p, id, values, 3); });
}

TEST_F(BodyEdits, SparseMassOfBothTrianglesInAnyOrder) {
  add_body(p, 1);
  const int32_t pointers[] = {0, 2, 5, 7};
  for (const auto& rows : {std::vector<int32_t>{0, 1, 0, 1, 2, 1, 2}, {1, 0, 2, 1, 0, 2, 1}}) {
    std::vector<double> given(7);
    for (int j = 0, e = 0; j < 3; ++j)
      for (; e < pointers[j + 1]; ++e) given[e] = rows[e] == j ? 2 + j : 0.5 / std::max(1, std::max(j, rows[e]));
    int32_t id = -1;
    ASSERT_EQ(mlcp_problem_body_add_sparse(p, 3, pointers, rows.data(), given.data(), MLCP_FULL, &id), MLCP_OK) << mlcp_problem_error(p);
    for (double& x : given) x *= 2;
    ASSERT_EQ(mlcp_problem_body_set_mass(p, id, given.data(), 7), MLCP_OK) << mlcp_problem_error(p);
    const std::vector<double> m = dense(mass_of(p), false);
    const std::vector<double> block{4, 1, 0, 1, 6, 0.5, 0, 0.5, 8};
    const int n = mlcp_problem_velocity_count(p);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_EQ(m[(n - 3 + i) * n + n - 3 + j], block[3 * i + j]) << i << ", " << j;
    for (int e = 0; e < 7; ++e) {  // any entry off the diagonal that differs from its mirror
      std::vector<double> odd = given;
      odd[e] += 1;
      const bool diagonal = std::count(block.begin(), block.end(), given[e]) == 1;
      EXPECT_EQ(mlcp_problem_body_set_mass(p, id, odd.data(), 7), diagonal ? MLCP_OK : MLCP_ERROR_ARGUMENT) << e;
    }
  }
}

TEST_F(BodyEdits, RemoveMovesTheOthersUp) {
  for (double mass : {1.0, 2.0, 3.0}) add_body(p, 2, mass);
  add_row(p, {0, 4, 5}, {1, 2, 3});
  const double k[] = {1, 2, 3, 4, 5, 6};
  ASSERT_EQ(mlcp_problem_set_momentum(p, 0, 6, k), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_remove(p, 1), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(mlcp_problem_body_count(p), 2);
  EXPECT_EQ(offset(2), 2);
  EXPECT_EQ(jacobian_of(p).indices, (std::vector<int32_t>{0, 2, 3}));
  EXPECT_EQ(momentum(), (std::vector<double>{1, 2, 5, 6}));
  EXPECT_EQ(mass_of(p).values, (std::vector<double>{1, 0, 0, 1, 3, 0, 0, 3}));
  EXPECT_EQ(mass_of(p).indices, (std::vector<int32_t>{0, 1, 0, 1, 2, 3, 2, 3}));
  EXPECT_EQ(mlcp_problem_body_range(p, 1, nullptr, nullptr), MLCP_ERROR_RANGE);
}

TEST_F(BodyEdits, RemoveWhileARowRefersToIt) {
  add_body(p, 2);
  const int32_t id = add_body(p, 2);
  add_row(p, {3}, {0});
  expect_refused(p, MLCP_ERROR_STATE, "row 0", [&] { return mlcp_problem_body_remove(p, id); });
  expect_refused(p, MLCP_ERROR_RANGE, "body = 5", [&] { return mlcp_problem_body_remove(p, 5); });
}

TEST_F(BodyEdits, SmallestFreeIdFirstAndVelocitiesInOrderOfId) {
  for (int i = 0; i < 4; ++i) add_body(p, 1, 1 + i);
  add_row(p, {0, 2, 3}, {1, 2, 3});
  ASSERT_EQ(mlcp_problem_body_remove(p, 1), MLCP_OK);
  const double k[] = {10, 12, 13};
  ASSERT_EQ(mlcp_problem_set_momentum(p, 0, 3, k), MLCP_OK);
  const double given[] = {7};
  ASSERT_EQ(mlcp_problem_body_set_prescribed(p, 2, given, 1), MLCP_OK);
  EXPECT_EQ(add_body(p, 2, 9), 1);
  EXPECT_EQ(offset(0), 0);
  EXPECT_EQ(offset(1), 1);
  EXPECT_EQ(offset(2), 3);
  EXPECT_EQ(offset(3), 4);
  EXPECT_EQ(momentum(), (std::vector<double>{10, 0, 0, 12, 13}));
  EXPECT_EQ(jacobian_of(p).indices, (std::vector<int32_t>{0, 3, 4}));
  EXPECT_EQ(mass_of(p).values, (std::vector<double>{1, 9, 0, 0, 9, 3, 4}));
  EXPECT_EQ(mass_of(p).indices, (std::vector<int32_t>{0, 1, 2, 1, 2, 3, 4}));
  EXPECT_EQ(mass_of(p).pointers, (std::vector<int32_t>{0, 1, 3, 5, 6, 7}));
  EXPECT_EQ(add_body(p, 1), 4);
}

TEST_F(BodyEdits, ManyFreeIdsFilledAtOnce) {
  for (int i = 0; i < 7; ++i) add_body(p, 1, 1 + i);
  for (int32_t id : {1, 2, 4}) ASSERT_EQ(mlcp_problem_body_remove(p, id), MLCP_OK);
  add_row(p, {0, 1, 2, 3}, {1, 2, 3, 4});
  const std::vector<double> masses = {20, 30, 40, 50};
  int32_t ids[4];
  ASSERT_EQ(mlcp_problem_bodies_add(p, 4, 1, masses.data(), 0, ids), MLCP_OK);
  EXPECT_EQ(std::vector<int32_t>(ids, ids + 4), (std::vector<int32_t>{1, 2, 4, 7}));
  EXPECT_EQ(mass_of(p).values, (std::vector<double>{1, 20, 30, 4, 40, 6, 7, 50}));
  EXPECT_EQ(mass_of(p).indices, (std::vector<int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(jacobian_of(p).indices, (std::vector<int32_t>{0, 3, 5, 6}));
  EXPECT_EQ(mlcp_problem_body_count(p), 8);
}

TEST_F(BodyEdits, SparseBodiesKeepTheirOrderWhenOthersComeAndGo) {
  add_body(p, 3);
  const int32_t pointers[] = {0, 2, 3}, rows[] = {1, 0, 1};
  const double values[] = {0.5, 2, 3}, next[] = {0.25, 5, 7};
  for (int i = 0; i < 2; ++i) ASSERT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_LOWER, nullptr), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_remove(p, 0), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_remove(p, 1), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_LOWER, nullptr), MLCP_OK);
  for (int32_t id : {0, 2}) ASSERT_EQ(mlcp_problem_body_set_mass(p, id, next, 3), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(dense(mass_of(p), false), (std::vector<double>{5, 0.25, 0, 0, 0.25, 7, 0, 0, 0, 0, 5, 0.25, 0, 0, 0.25, 7}));
}

TEST_F(BodyEdits, RemovingTheLastGivesItsIdBack) {
  for (int i = 0; i < 3; ++i) add_body(p, 1);
  ASSERT_EQ(mlcp_problem_body_remove(p, 1), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_remove(p, 2), MLCP_OK);
  EXPECT_EQ(mlcp_problem_body_count(p), 1);
  EXPECT_EQ(add_body(p, 1), 1);
  EXPECT_EQ(add_body(p, 1), 2);
}

TEST_F(BodyEdits, SnapshotForgetsNothingAboutRemovedBodies) {
  ProblemHandle rich = make_rich_problem();
  mlcp_problem* copy = nullptr;
  const Bytes bytes = snapshot(rich.get());
  ASSERT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, &copy, nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
  ProblemHandle owner(copy);
  EXPECT_EQ(add_body(copy, 2), 1);
  EXPECT_EQ(add_body(rich.get(), 2), 1);
  EXPECT_EQ(snapshot(copy), snapshot(rich.get()));
}

TEST_F(BodyEdits, PrescribedAndDynamic) {
  const int32_t id = add_body(p, 2);
  const Bytes before = snapshot(p);
  const double v[] = {1, 2}, bad[] = {1, inf};
  expect_refused(p, MLCP_ERROR_RANGE, "count = 3", [&] { return mlcp_problem_body_set_prescribed(p, id, v, 3); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "velocity[1]", [&] { return mlcp_problem_body_set_prescribed(p, id, bad, 2); });
  expect_refused(p, MLCP_ERROR_NULL, "velocity", [&] { return mlcp_problem_body_set_prescribed(p, id, nullptr, 2); });
  expect_refused(p, MLCP_ERROR_RANGE, "body = 9", [&] { return mlcp_problem_body_set_prescribed(p, 9, v, 2); });
  expect_refused(p, MLCP_ERROR_RANGE, "body = 9", [&] { return mlcp_problem_body_set_dynamic(p, 9); });
  ASSERT_EQ(mlcp_problem_body_set_prescribed(p, id, v, 2), MLCP_OK);
  EXPECT_NE(snapshot(p), before);
  ASSERT_EQ(mlcp_problem_body_set_dynamic(p, id), MLCP_OK);
  EXPECT_EQ(snapshot(p), before);
}

TEST_F(BodyEdits, StateOfABody) {
  const int32_t still = add_body(p, 3), moved = add_body(p, 2);
  const double given[] = {1, -2};
  ASSERT_EQ(mlcp_problem_body_set_prescribed(p, moved, given, 2), MLCP_OK);
  int32_t prescribed = -1;
  double v[3] = {9, 9, 9};
  ASSERT_EQ(mlcp_problem_body_state(p, still, &prescribed, 3, v), MLCP_OK);
  EXPECT_EQ(prescribed, 0);
  EXPECT_EQ(std::vector<double>(v, v + 3), (std::vector<double>{0, 0, 0}));
  ASSERT_EQ(mlcp_problem_body_state(p, moved, &prescribed, 2, v), MLCP_OK);
  EXPECT_EQ(prescribed, 1);
  EXPECT_EQ(std::vector<double>(v, v + 3), (std::vector<double>{1, -2, 0}));
  prescribed = 9;
  EXPECT_EQ(mlcp_problem_body_state(p, moved, &prescribed, -7, nullptr), MLCP_OK);
  EXPECT_EQ(prescribed, 1);
  EXPECT_EQ(mlcp_problem_body_state(p, moved, nullptr, 2, v), MLCP_OK);
  EXPECT_EQ(mlcp_problem_body_state(p, moved, nullptr, 0, nullptr), MLCP_OK);
  EXPECT_EQ(mlcp_problem_body_state(p, still, &prescribed, 2, v), MLCP_ERROR_RANGE);
  EXPECT_EQ(prescribed, 1);
  EXPECT_EQ(mlcp_problem_body_state(p, 2, &prescribed, 2, v), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_problem_body_state(p, MLCP_WORLD, &prescribed, 2, v), MLCP_ERROR_RANGE);
}

TEST_F(BodyEdits, IdsOfBodies) {
  int32_t count = -1;
  EXPECT_EQ(mlcp_problem_bodies(p, 0, nullptr, &count), MLCP_OK);
  EXPECT_EQ(count, 0);
  for (int i = 0; i < 5; ++i) add_body(p, 1);
  for (int32_t body : {0, 3}) ASSERT_EQ(mlcp_problem_body_remove(p, body), MLCP_OK);
  EXPECT_EQ(mlcp_problem_bodies(p, 0, nullptr, &count), MLCP_OK);
  EXPECT_EQ(count, 3);
  int32_t ids[4] = {-7, -7, -7, -7};
  count = -1;
  EXPECT_EQ(mlcp_problem_bodies(p, 2, ids, &count), MLCP_ERROR_RANGE);
  EXPECT_EQ(count, 3);
  EXPECT_EQ(ids[0], -7);
  ASSERT_EQ(mlcp_problem_bodies(p, 4, ids, &count), MLCP_OK);
  EXPECT_EQ(std::vector<int32_t>(ids, ids + 4), (std::vector<int32_t>{1, 2, 4, -7}));
  EXPECT_EQ(mlcp_problem_bodies(p, -1, nullptr, &count), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_problem_bodies(p, 4, ids, nullptr), MLCP_ERROR_NULL);
}

TEST_F(BodyEdits, Momentum) {
  add_body(p, 3);
  const double k[] = {1, 2}, bad[] = {1, not_a_number};
  ASSERT_EQ(mlcp_problem_set_momentum(p, 1, 2, k), MLCP_OK);
  EXPECT_EQ(momentum(), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(mlcp_problem_set_momentum(p, 3, 0, nullptr), MLCP_OK);
  expect_refused(p, MLCP_ERROR_ARGUMENT, "k[1]", [&] { return mlcp_problem_set_momentum(p, 0, 2, bad); });
  expect_refused(p, MLCP_ERROR_RANGE, "first = 2", [&] { return mlcp_problem_set_momentum(p, 2, 2, k); });
  expect_refused(p, MLCP_ERROR_RANGE, "first = -1", [&] { return mlcp_problem_set_momentum(p, -1, 2, k); });
  expect_refused(p, MLCP_ERROR_NULL, "k is NULL", [&] { return mlcp_problem_set_momentum(p, 0, 2, nullptr); });
  double out[3];
  EXPECT_EQ(mlcp_problem_get_momentum(p, 2, out), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_problem_get_momentum(p, 3, nullptr), MLCP_OK);
}

TEST_F(BodyEdits, ClearAndClone) {
  ProblemHandle rich = make_rich_problem();
  mlcp_problem* raw = nullptr;
  ASSERT_EQ(mlcp_problem_clone(rich.get(), &raw), MLCP_OK);
  ProblemHandle copy(raw);
  EXPECT_EQ(snapshot(copy.get()), snapshot(rich.get()));
  ASSERT_EQ(mlcp_problem_clear(rich.get()), MLCP_OK);
  EXPECT_NE(snapshot(copy.get()), snapshot(rich.get()));
  EXPECT_EQ(snapshot(rich.get()), snapshot(p));
  EXPECT_EQ(add_body(rich.get(), 3), 0);
  ASSERT_EQ(mlcp_problem_trim(copy.get()), MLCP_OK);
  EXPECT_EQ(mlcp_problem_row_count(copy.get()), 4);
}

TEST_F(BodyEdits, NullHandles) {
  EXPECT_EQ(mlcp_problem_create(nullptr, nullptr), MLCP_ERROR_NULL);
  mlcp_problem_destroy(nullptr);
  mlcp_problem* out = p;
  EXPECT_EQ(mlcp_problem_clone(nullptr, &out), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_clone(p, nullptr), MLCP_ERROR_NULL);
  EXPECT_STREQ(mlcp_problem_error(nullptr), "");
  EXPECT_EQ(mlcp_problem_velocity_count(nullptr), 0);
  EXPECT_EQ(mlcp_problem_row_count(nullptr), 0);
  EXPECT_EQ(mlcp_problem_body_count(nullptr), 0);
  EXPECT_EQ(mlcp_problem_entry_count(nullptr), 0);
  EXPECT_EQ(mlcp_problem_reserve(nullptr, 1, 1, 1, 1), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_trim(nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_clear(nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_bodies_add(nullptr, 0, 1, nullptr, 0, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_body_remove(nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_body_range(nullptr, 0, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_get_momentum(nullptr, 0, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_body_state(nullptr, 0, nullptr, 0, nullptr), MLCP_ERROR_NULL);
  int32_t count = 0;
  EXPECT_EQ(mlcp_problem_bodies(nullptr, 0, nullptr, &count), MLCP_ERROR_NULL);
}

TEST_F(BodyEdits, ReserveRefused) {
  expect_refused(p, MLCP_ERROR_RANGE, "bodies = -1", [&] { return mlcp_problem_reserve(p, -1, 0, 0, 0); });
  expect_refused(p, MLCP_ERROR_RANGE, "velocities = -1", [&] { return mlcp_problem_reserve(p, 0, -1, 0, 0); });
  expect_refused(p, MLCP_ERROR_RANGE, "rows = -1", [&] { return mlcp_problem_reserve(p, 0, 0, -1, 0); });
  expect_refused(p, MLCP_ERROR_RANGE, "entries = -1", [&] { return mlcp_problem_reserve(p, 0, 0, 0, -1); });
  expect_refused(p, MLCP_ERROR_RANGE, "entries of J", [&] { return mlcp_problem_reserve(p, 0, 0, 0, int64_t(1) << 40); });
  const int32_t most = std::numeric_limits<int32_t>::max();
  expect_refused(p, MLCP_ERROR_RANGE, "32-bit", [&] { return mlcp_problem_reserve(p, 0, most, most, 0); });
}
