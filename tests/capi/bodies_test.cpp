#include "support.h"

using namespace capi;

namespace {

struct Bodies : testing::Test {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();

  int32_t offset(int32_t body) const {
    int32_t first = -1;
    EXPECT_EQ(mlcp_problem_body_range(p, body, &first, nullptr), MLCP_OK);
    return first;
  }
};

}  // namespace

TEST_F(Bodies, NewProblemIsEmpty) {
  EXPECT_EQ(mlcp_problem_velocity_count(p), 0);
  EXPECT_EQ(mlcp_problem_row_count(p), 0);
  EXPECT_EQ(mlcp_problem_body_count(p), 0);
  EXPECT_EQ(mlcp_problem_entry_count(p), 0);
  EXPECT_STREQ(mlcp_problem_error(p), "");
  EXPECT_EQ(mass_of(p).pointers, std::vector<int32_t>{0});
}

TEST_F(Bodies, IdsAndOffsetsInOrderOfAdding) {
  const std::vector<double> masses = {1, 0, 0, 2, 3, 0.5, 0.5, 4};
  int32_t ids[2] = {-1, -1};
  ASSERT_EQ(mlcp_problem_bodies_add(p, 2, 2, masses.data(), 0, ids), MLCP_OK);
  EXPECT_EQ(ids[0], 0);
  EXPECT_EQ(ids[1], 1);
  EXPECT_EQ(add_body(p, 3), 2);
  EXPECT_EQ(mlcp_problem_velocity_count(p), 7);
  int32_t first = -1, dimension = -1;
  EXPECT_EQ(mlcp_problem_body_range(p, 2, &first, &dimension), MLCP_OK);
  EXPECT_EQ(first, 4);
  EXPECT_EQ(dimension, 3);
  const std::vector<double> mass = dense(mass_of(p), false);
  EXPECT_EQ(mass[0 * 7 + 0], 1);
  EXPECT_EQ(mass[2 * 7 + 3], 0.5);
  EXPECT_EQ(mass[3 * 7 + 2], 0.5);
  EXPECT_EQ(mass[6 * 7 + 6], 1);
}

TEST_F(Bodies, StrideInBytesMayBeUnaligned) {
  struct [[gnu::packed]] Engine {
    char name;
    double mass[1];
    char tail[3];
  } engine[3] = {{'a', {1}, {}}, {'b', {2}, {}}, {'c', {3}, {}}};
  const auto* masses = reinterpret_cast<const double*>(reinterpret_cast<const char*>(engine) + 1);
  ASSERT_EQ(mlcp_problem_bodies_add(p, 3, 1, masses, sizeof(Engine), nullptr), MLCP_OK);
  EXPECT_EQ(mass_of(p).values, (std::vector<double>{1, 2, 3}));
}

TEST_F(Bodies, NoneToAdd) { EXPECT_EQ(mlcp_problem_bodies_add(p, 0, 6, nullptr, 0, nullptr), MLCP_OK); }

TEST_F(Bodies, NegativeCount) {
  expect_refused(p, MLCP_ERROR_RANGE, "count = -1", [&] { return mlcp_problem_bodies_add(p, -1, 1, nullptr, 0, nullptr); });
}

TEST_F(Bodies, DimensionZero) {
  const double mass = 1;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "dimension = 0", [&] { return mlcp_problem_bodies_add(p, 1, 0, &mass, 0, nullptr); });
}

TEST_F(Bodies, MassesNull) {
  expect_refused(p, MLCP_ERROR_NULL, "masses", [&] { return mlcp_problem_bodies_add(p, 1, 3, nullptr, 0, nullptr); });
}

TEST_F(Bodies, TooLargeToNumber) {
  const double mass = 1;
  expect_refused(p, MLCP_ERROR_RANGE, "entries of M", [&] { return mlcp_problem_bodies_add(p, 1, 50000, &mass, 0, nullptr); });
  expect_refused(p, MLCP_ERROR_RANGE, "entries of M", [&] {
    return mlcp_problem_bodies_add(p, std::numeric_limits<int32_t>::max(), 6, &mass, 0, nullptr);
  });
}

TEST_F(Bodies, NanInTheSecondMassNamesIt) {
  const double masses[] = {1, 2, not_a_number};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "masses[2]", [&] { return mlcp_problem_bodies_add(p, 3, 1, masses, 0, nullptr); });
}

TEST_F(Bodies, InfInAMass) {
  const double mass[] = {1, inf, inf, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "not finite", [&] { return mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr); });
}

TEST_F(Bodies, ZeroOnTheDiagonal) {
  const double mass[] = {1, 0, 0, 0};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "diagonal entry 1", [&] { return mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr); });
}

TEST_F(Bodies, Asymmetric) {
  const double mass[] = {1, 0.1, 0.2, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "not symmetric", [&] { return mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr); });
}

TEST_F(Bodies, AsymmetryOfRoundingIsAveraged) {
  const double mass[] = {1, 0.1, 0.1 + 4e-16, 1};
  ASSERT_EQ(mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr), MLCP_OK);
  const Matrix stored = mass_of(p);
  EXPECT_EQ(stored.values[1], stored.values[2]);
  EXPECT_NEAR(stored.values[1], 0.1, 1e-15);
}

TEST_F(Bodies, Indefinite) {
  const double mass[] = {1, 2, 2, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "pivot 1", [&] { return mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr); });
}

TEST_F(Bodies, IndefiniteBehindAPivotOfZero) {
  const double mass[] = {1, 1, 0, 1, 1, 0.5, 0, 0.5, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "not positive definite",
                 [&] { return mlcp_problem_bodies_add(p, 1, 3, mass, 0, nullptr); });
}

TEST_F(Bodies, SemidefiniteToRoundingIsLegal) {
  const double mass[] = {1, 1, 1, 1 - 1e-14};
  EXPECT_EQ(mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr), MLCP_OK);
}

TEST_F(Bodies, HugeAndDenormalMasses) {
  const double huge[] = {1e300, 5e299, 5e299, 1e300}, tiny[] = {5e-324, 0, 0, 1e-310}, mixed[] = {1e300, 0.5, 0.5, 1e-300};
  for (const double* mass : {huge, tiny, mixed}) EXPECT_EQ(mlcp_problem_bodies_add(p, 1, 2, mass, 0, nullptr), MLCP_OK);
}

TEST_F(Bodies, SparseBothTriangles) {
  const int32_t pointers[] = {0, 2, 4}, rows[] = {1, 0, 0, 1};
  const double values[] = {0.5, 2, 0.5, 3};
  int32_t id = -1;
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL, &id), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(id, 0);
  EXPECT_EQ(mass_of(p).indices, (std::vector<int32_t>{1, 0, 0, 1}));
  EXPECT_EQ(mass_of(p).values, (std::vector<double>{0.5, 2, 0.5, 3}));
}

TEST_F(Bodies, SparseTrianglesGiveTheSameMatrix) {
  const int32_t full_p[] = {0, 2, 5, 7}, full_r[] = {0, 1, 0, 1, 2, 1, 2}, lower_p[] = {0, 2, 4, 5}, lower_r[] = {0, 1, 1, 2, 2},
                upper_p[] = {0, 1, 3, 5}, upper_r[] = {0, 0, 1, 1, 2};
  const double full[] = {4, -1, -1, 5, 2, 2, 6}, lower[] = {4, -1, 5, 2, 6}, upper[] = {4, -1, 5, 2, 6};
  add_body(p, 2);
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 3, full_p, full_r, full, MLCP_FULL, nullptr), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 3, lower_p, lower_r, lower, MLCP_LOWER, nullptr), MLCP_OK);
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 3, upper_p, upper_r, upper, MLCP_UPPER, nullptr), MLCP_OK);
  const std::vector<double> mass = dense(mass_of(p), false);
  const int32_t n = 11;
  for (int32_t i = 0; i < 3; ++i)
    for (int32_t j = 0; j < 3; ++j) {
      EXPECT_EQ(mass[(2 + i) * n + 2 + j], mass[(5 + i) * n + 5 + j]);
      EXPECT_EQ(mass[(2 + i) * n + 2 + j], mass[(8 + i) * n + 8 + j]);
      EXPECT_EQ(mass[(2 + i) * n + 2 + j], mass[(2 + j) * n + 2 + i]);
    }
}

TEST_F(Bodies, SparseDuplicate) {
  const int32_t pointers[] = {0, 2}, rows[] = {0, 0};
  const double values[] = {1, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "row_indices[1]",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, rows, values, MLCP_FULL, nullptr); });
}

TEST_F(Bodies, SparseIndexOutOfRange) {
  const int32_t pointers[] = {0, 1}, rows[] = {1};
  const double values[] = {1};
  expect_refused(p, MLCP_ERROR_RANGE, "row_indices[0] = 1",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, rows, values, MLCP_FULL, nullptr); });
}

TEST_F(Bodies, SparseInTheOtherTriangle) {
  const int32_t pointers[] = {0, 1, 3}, rows[] = {0, 0, 1};
  const double values[] = {1, 0.5, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lower triangle",
                 [&] { return mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_LOWER, nullptr); });
}

TEST_F(Bodies, SparseUnknownTriangle) {
  const int32_t pointers[] = {0, 0};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "triangle = 3",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, nullptr, nullptr, 3, nullptr); });
}

TEST_F(Bodies, SparseFallingPointers) {
  const int32_t pointers[] = {0, 2, 1}, rows[] = {0, 1};
  const double values[] = {1, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "column_pointers[2] = 1",
                 [&] { return mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL, nullptr); });
}

TEST_F(Bodies, SparsePointersThatDoNotStartAtZero) {
  const int32_t pointers[] = {1, 2}, rows[] = {0, 0};
  const double values[] = {1, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "column_pointers[0] = 1",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, rows, values, MLCP_FULL, nullptr); });
}

TEST_F(Bodies, SparseAsymmetric) {
  const int32_t pointers[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
  const double values[] = {1, 0.5, 0.25, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "not symmetric",
                 [&] { return mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL, nullptr); });
}

TEST_F(Bodies, SparseMissingMirrorIsAsymmetryUnlessZero) {
  const int32_t pointers[] = {0, 2, 3}, rows[] = {0, 1, 1};
  const double values[] = {1, 1e-200, 1}, zero[] = {1, 0, 1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "not symmetric",
                 [&] { return mlcp_problem_body_add_sparse(p, 2, pointers, rows, values, MLCP_FULL, nullptr); });
  EXPECT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, rows, zero, MLCP_FULL, nullptr), MLCP_OK);
}

TEST_F(Bodies, SparseNegativeDiagonal) {
  const int32_t pointers[] = {0, 1}, rows[] = {0};
  const double values[] = {-1}, zero[] = {0}, bad[] = {not_a_number};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "diagonal entry 0",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, rows, values, MLCP_FULL, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[0]",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, rows, bad, MLCP_FULL, nullptr); });
  EXPECT_EQ(mlcp_problem_body_add_sparse(p, 1, pointers, rows, zero, MLCP_FULL, nullptr), MLCP_OK);
}

TEST_F(Bodies, SparseNullArrays) {
  const int32_t pointers[] = {0, 1}, rows[] = {0};
  const double values[] = {1};
  expect_refused(p, MLCP_ERROR_NULL, "column_pointers",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, nullptr, rows, values, MLCP_FULL, nullptr); });
  expect_refused(p, MLCP_ERROR_NULL, "row_indices",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, nullptr, values, MLCP_FULL, nullptr); });
  expect_refused(p, MLCP_ERROR_NULL, "values",
                 [&] { return mlcp_problem_body_add_sparse(p, 1, pointers, rows, nullptr, MLCP_FULL, nullptr); });
}

TEST_F(Bodies, SparseWithoutEntriesIsLegal) {
  const int32_t pointers[] = {0, 0, 0};
  EXPECT_EQ(mlcp_problem_body_add_sparse(p, 2, pointers, nullptr, nullptr, MLCP_FULL, nullptr), MLCP_OK);
  EXPECT_EQ(mlcp_problem_velocity_count(p), 2);
}
