#include "support.h"

using namespace capi;

namespace {

struct Values : testing::Test {
  ProblemHandle problem = make_rich_problem();
  mlcp_problem* p = problem.get();
  const int32_t m = 4;

  struct Fields {
    std::vector<double> r, lo, hi, compliance;
    std::vector<uint64_t> key;
  };
  Fields fields() const {
    const size_t count = mlcp_problem_row_count(p);
    Fields f{std::vector<double>(count), std::vector<double>(count), std::vector<double>(count), std::vector<double>(count),
             std::vector<uint64_t>(count)};
    EXPECT_EQ(mlcp_problem_get_rows(p, static_cast<int32_t>(count), f.r.data(), f.lo.data(), f.hi.data(), f.compliance.data(),
                                    f.key.data()),
              MLCP_OK);
    return f;
  }
};

}  // namespace

TEST_F(Values, RightHandSide) {
  const double r[] = {5, 6}, bad[] = {5, not_a_number};
  ASSERT_EQ(mlcp_problem_rows_set_r(p, 1, 2, r), MLCP_OK);
  EXPECT_EQ(fields().r, (std::vector<double>{0, 5, 6, -1}));
  expect_refused(p, MLCP_ERROR_ARGUMENT, "r[1]", [&] { return mlcp_problem_rows_set_r(p, 1, 2, bad); });
  expect_refused(p, MLCP_ERROR_RANGE, "first = 3", [&] { return mlcp_problem_rows_set_r(p, 3, 2, r); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = -1", [&] { return mlcp_problem_rows_set_r(p, 3, -1, r); });
  expect_refused(p, MLCP_ERROR_NULL, "r is NULL", [&] { return mlcp_problem_rows_set_r(p, 0, 1, nullptr); });
  const int32_t most = std::numeric_limits<int32_t>::max();
  expect_refused(p, MLCP_ERROR_RANGE, "first", [&] { return mlcp_problem_rows_set_r(p, most, most, r); });
}

TEST_F(Values, Bounds) {
  const double lo[] = {-inf, 1}, hi[] = {4, 1}, above[] = {5, 1};
  ASSERT_EQ(mlcp_problem_rows_set_bounds(p, 2, 2, lo, hi), MLCP_OK);
  EXPECT_EQ(fields().lo, (std::vector<double>{0, 0, -inf, 1}));
  EXPECT_EQ(fields().hi, (std::vector<double>{inf, inf, 4, 1}));
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[0] = 5 is above hi[0] = 4",
                 [&] { return mlcp_problem_rows_set_bounds(p, 2, 2, above, hi); });
  expect_refused(p, MLCP_ERROR_NULL, "lo is NULL", [&] { return mlcp_problem_rows_set_bounds(p, 2, 2, nullptr, hi); });
  expect_refused(p, MLCP_ERROR_NULL, "hi is NULL", [&] { return mlcp_problem_rows_set_bounds(p, 2, 2, lo, nullptr); });
  expect_refused(p, MLCP_ERROR_RANGE, "first = 4", [&] { return mlcp_problem_rows_set_bounds(p, 4, 1, lo, hi); });
}

TEST_F(Values, ComplianceDiagonal) {
  const double soft[] = {2, -3}, negative[] = {-1}, bad[] = {inf};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "compliance[0] = -1",
                 [&] { return mlcp_problem_rows_set_compliance(p, 0, 1, negative); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "compliance[0]", [&] { return mlcp_problem_rows_set_compliance(p, 1, 1, bad); });
  expect_refused(p, MLCP_ERROR_RANGE, "first = 4", [&] { return mlcp_problem_rows_set_compliance(p, 4, 1, soft); });
  ASSERT_EQ(mlcp_problem_rows_set_compliance(p, 0, 2, soft), MLCP_OK) << mlcp_problem_error(p);
  const std::vector<double> sigma = dense(compliance_of(p), false);
  EXPECT_EQ(sigma, (std::vector<double>{2, 0, 0, 0.125, 0, -3, 0, 0, 0, 0, 0.0625, 0, 0.125, 0, 0, 1}));
}

TEST_F(Values, Keys) {
  const uint64_t keys[] = {4, 5};
  ASSERT_EQ(mlcp_problem_rows_set_keys(p, 1, 2, keys), MLCP_OK);
  EXPECT_EQ(fields().key, (std::vector<uint64_t>{17, 4, 5, 99}));
  expect_refused(p, MLCP_ERROR_RANGE, "first = -1", [&] { return mlcp_problem_rows_set_keys(p, -1, 2, keys); });
  expect_refused(p, MLCP_ERROR_NULL, "keys", [&] { return mlcp_problem_rows_set_keys(p, 0, 2, nullptr); });
}

TEST_F(Values, JacobianInTheOrderOfAdding) {
  const double values[] = {7, 8, 9}, bad[] = {7, inf, 9};
  ASSERT_EQ(mlcp_problem_row_set_jacobian(p, 0, values, 3), MLCP_OK);
  const Matrix j = jacobian_of(p);
  EXPECT_EQ(std::vector<int32_t>(j.indices.begin(), j.indices.begin() + 3), (std::vector<int32_t>{0, 4, 2}));
  EXPECT_EQ(std::vector<double>(j.values.begin(), j.values.begin() + 3), (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(mlcp_problem_row_set_jacobian(p, 1, nullptr, 0), MLCP_OK);
  expect_refused(p, MLCP_ERROR_RANGE, "count = 2", [&] { return mlcp_problem_row_set_jacobian(p, 0, values, 2); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[1]", [&] { return mlcp_problem_row_set_jacobian(p, 0, bad, 3); });
  expect_refused(p, MLCP_ERROR_RANGE, "row = 4", [&] { return mlcp_problem_row_set_jacobian(p, 4, values, 3); });
  expect_refused(p, MLCP_ERROR_RANGE, "row = -1", [&] { return mlcp_problem_row_set_jacobian(p, -1, values, 3); });
  expect_refused(p, MLCP_ERROR_NULL, "values", [&] { return mlcp_problem_row_set_jacobian(p, 0, nullptr, 3); });
}

TEST_F(Values, ReadingTheWrongLength) {
  double r[5];
  EXPECT_EQ(mlcp_problem_get_rows(p, 5, r, nullptr, nullptr, nullptr, nullptr), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_problem_get_rows(nullptr, 0, r, nullptr, nullptr, nullptr, nullptr), MLCP_ERROR_NULL);
}

TEST_F(Values, RemoveRowsKeepsTheOrder) {
  const int32_t gone[] = {2, 0};
  ASSERT_EQ(mlcp_problem_rows_remove(p, 2, gone), MLCP_OK) << mlcp_problem_error(p);
  const Fields left = fields();
  EXPECT_EQ(left.key, (std::vector<uint64_t>{0, 99}));
  EXPECT_EQ(left.r, (std::vector<double>{0, -1}));
  EXPECT_EQ(left.lo, (std::vector<double>{0, -2}));
  EXPECT_EQ(left.compliance, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(jacobian_of(p).pointers, (std::vector<int32_t>{0, 0, 0}));
  EXPECT_EQ(compliance_of(p).indices, (std::vector<int32_t>{0, 1}));
}

TEST_F(Values, RemoveRowsRenumbersTheCompliance) {
  const int32_t gone[] = {1, 2};
  ASSERT_EQ(mlcp_problem_rows_remove(p, 2, gone), MLCP_OK);
  EXPECT_EQ(dense(compliance_of(p), false), (std::vector<double>{0.25, 0.125, 0.125, 1}));
  EXPECT_EQ(jacobian_of(p).pointers, (std::vector<int32_t>{0, 3, 3}));
  const double soft[] = {3, 4};
  ASSERT_EQ(mlcp_problem_rows_set_compliance(p, 0, 2, soft), MLCP_OK);
  EXPECT_EQ(dense(compliance_of(p), false), (std::vector<double>{3, 0.125, 0.125, 4}));
}

TEST_F(Values, RemoveRowsRefused) {
  const int32_t twice[] = {1, 1}, out[] = {0, 4}, below[] = {-1};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "rows[1] = 1", [&] { return mlcp_problem_rows_remove(p, 2, twice); });
  expect_refused(p, MLCP_ERROR_RANGE, "rows[1] = 4", [&] { return mlcp_problem_rows_remove(p, 2, out); });
  expect_refused(p, MLCP_ERROR_RANGE, "rows[0] = -1", [&] { return mlcp_problem_rows_remove(p, 1, below); });
  expect_refused(p, MLCP_ERROR_NULL, "rows is NULL", [&] { return mlcp_problem_rows_remove(p, 1, nullptr); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = -1", [&] { return mlcp_problem_rows_remove(p, -1, twice); });
  EXPECT_EQ(mlcp_problem_rows_remove(p, 0, nullptr), MLCP_OK);
}

TEST_F(Values, ClearRowsLeavesTheBodies) {
  ASSERT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
  EXPECT_EQ(mlcp_problem_row_count(p), 0);
  EXPECT_EQ(mlcp_problem_entry_count(p), 0);
  EXPECT_EQ(compliance_of(p).pointers, std::vector<int32_t>{0});
  EXPECT_EQ(mlcp_problem_body_count(p), 4);
  EXPECT_EQ(add_row(p, {1}, {2}), 0);
}

namespace {

mlcp_status set_sigma(mlcp_problem* p, int32_t count, const std::vector<int32_t>& pointers, const std::vector<int32_t>& rows,
                      const std::vector<double>& values, mlcp_triangle triangle = MLCP_FULL) {
  return mlcp_problem_set_compliance_matrix(p, count, pointers.data(), rows.data(), values.data(), triangle);
}

}  // namespace

TEST_F(Values, ComplianceMatrixInAnyOrderAndTriangle) {
  ProblemHandle other = make_rich_problem();
  ASSERT_EQ(set_sigma(p, 4, {0, 2, 4, 6, 7}, {2, 0, 2, 1, 0, 1, 3}, {0.5, 1, 0.25, 2, 0.5, 0.25, 4}), MLCP_OK)
      << mlcp_problem_error(p);
  ASSERT_EQ(set_sigma(other.get(), 4, {0, 1, 2, 4, 5}, {0, 1, 1, 0, 3}, {1, 2, 0.25, 0.5, 4}, MLCP_UPPER), MLCP_OK);
  EXPECT_EQ(compliance_of(p).indices, (std::vector<int32_t>{0, 2, 1, 2, 0, 1, 2, 3}));
  EXPECT_EQ(dense(compliance_of(p), false), (std::vector<double>{1, 0, 0.5, 0, 0, 2, 0.25, 0, 0.5, 0.25, 0, 0, 0, 0, 0, 4}));
  EXPECT_EQ(snapshot(p), snapshot(other.get()));
}

/// New values over the pattern that is there go straight to their places; what is wrong with them is found all the same.
TEST_F(Values, ComplianceMatrixOverTheSamePattern) {
  const std::vector<int32_t> pointers{0, 2, 4, 7, 8}, rows{0, 2, 1, 2, 0, 1, 2, 3};
  const auto set = [&](mlcp_problem* to, const std::vector<double>& values) { return set_sigma(to, 4, pointers, rows, values); };
  ASSERT_EQ(set(p, {1, 0.5, 2, 0.25, 0.5, 0.25, 0, 4}), MLCP_OK) << mlcp_problem_error(p);
  const std::vector<double> next{2, -0.5, 3, 0.75, -0.5, 0.75, 1, 0};
  ProblemHandle other = make_rich_problem();
  ASSERT_EQ(set(p, next), MLCP_OK) << mlcp_problem_error(p);
  ASSERT_EQ(set(other.get(), next), MLCP_OK);
  EXPECT_EQ(dense(compliance_of(p), false), (std::vector<double>{2, 0, -0.5, 0, 0, 3, 0.75, 0, -0.5, 0.75, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(snapshot(p), snapshot(other.get()));

  expect_refused(p, MLCP_ERROR_ARGUMENT, "not symmetric", [&] { return set(p, {2, -0.5, 3, 0.75, -0.5, 0.5, 1, 0}); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[1]", [&] { return set(p, {2, not_a_number, 3, 0.75, not_a_number, 0.75, 1, 0}); });
  const double inf = std::numeric_limits<double>::infinity();
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[3]", [&] { return set(p, {2, -0.5, 3, inf, -0.5, inf, 1, 0}); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[6]", [&] { return set(p, {2, -0.5, 3, 0.75, -0.5, 0.75, inf, 0}); });
  expect_refused(p, MLCP_ERROR_NULL, "row_indices", [&] { return mlcp_problem_set_compliance_matrix(p, 4, pointers.data(), nullptr, next.data(), MLCP_FULL); });
  EXPECT_EQ(set(p, {2, -0.5, 3, 0.75, -0.5 * (1 + 1e-16), 0.75, 1, 0}), MLCP_OK);
}

TEST_F(Values, ComplianceMatrixReplacesEveryCompliance) {
  ASSERT_EQ(set_sigma(p, 4, {0, 0, 0, 0, 0}, {}, {}), MLCP_OK);
  EXPECT_EQ(fields().compliance, (std::vector<double>{0, 0, 0, 0}));
}

TEST_F(Values, ComplianceMatrixOfNoRowsWithoutArrays) {
  ASSERT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
  for (mlcp_triangle triangle : {MLCP_FULL, MLCP_LOWER, MLCP_UPPER})
    EXPECT_EQ(mlcp_problem_set_compliance_matrix(p, 0, nullptr, nullptr, nullptr, triangle), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(compliance_of(p).pointers, std::vector<int32_t>{0});
}

TEST_F(Values, ComplianceMatrixIndefiniteDiagonalOnlyWithoutEntries) {
  EXPECT_EQ(set_sigma(p, 4, {0, 0, 1, 1, 1}, {1}, {-2}), MLCP_OK);
  expect_refused(p, MLCP_ERROR_ARGUMENT, "diagonal entry 2", [&] { return set_sigma(p, 4, {0, 0, 0, 1, 1}, {2}, {-2}); });
}

TEST_F(Values, ComplianceMatrixRefused) {
  expect_refused(p, MLCP_ERROR_RANGE, "count = 3", [&] { return set_sigma(p, 3, {0, 0, 0, 0}, {}, {}); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = -1", [&] { return set_sigma(p, -1, {0}, {}, {}); });
  expect_refused(p, MLCP_ERROR_RANGE, "row_indices[0] = 4", [&] { return set_sigma(p, 4, {0, 1, 1, 1, 1}, {4}, {1}); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "row_indices[1] = 1", [&] { return set_sigma(p, 4, {0, 2, 2, 2, 2}, {1, 1}, {1, 1}); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[0]", [&] { return set_sigma(p, 4, {0, 1, 1, 1, 1}, {0}, {not_a_number}); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "not symmetric", [&] { return set_sigma(p, 4, {0, 1, 1, 1, 1}, {1}, {0.5}); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "triangle = -1", [&] { return set_sigma(p, 4, {0, 0, 0, 0, 0}, {}, {}, -1); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "upper triangle",
                 [&] { return set_sigma(p, 4, {0, 1, 1, 1, 1}, {1}, {0.5}, MLCP_UPPER); });
}

TEST_F(Values, ComplianceMatrixRoundedApartAndOverflowing) {
  EXPECT_EQ(set_sigma(p, 4, {0, 2, 4, 4, 4}, {0, 1, 0, 1}, {1, 0.1, 0.1 + 1e-16, 1}), MLCP_OK);
  EXPECT_EQ(set_sigma(p, 4, {0, 2, 4, 4, 4}, {0, 1, 0, 1}, {1e300, 1e300, 1e300, 1e300}), MLCP_OK);
  EXPECT_EQ(set_sigma(p, 4, {0, 1, 2, 2, 2}, {1, 0}, {1e-3, 1e-3 * (1 + 4e-16)}), MLCP_OK);
}
