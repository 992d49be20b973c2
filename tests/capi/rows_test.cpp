#include "support.h"

using namespace capi;

namespace {

struct Rows : testing::Test {
  ProblemHandle problem = make_problem();
  mlcp_problem* p = problem.get();
  mlcp_rows rows;

  Rows() {
    add_body(p, 2);
    add_body(p, 3);
    mlcp_rows_init(&rows, sizeof rows);
  }
  mlcp_status add() { return mlcp_problem_rows_add(p, &rows, nullptr); }
};

constexpr int32_t world = MLCP_WORLD;

}  // namespace

TEST_F(Rows, BlocksOfBothBodiesInOrder) {
  const int32_t a[] = {1, world, 0}, b[] = {0, 1, world};
  const double ja[] = {1, 2, 3, 4, 5}, jb[] = {6, 7, 8, 9, 10};
  rows.count = 3;
  rows.body_a = a;
  rows.body_b = b;
  rows.jacobian_a = ja;
  rows.jacobian_b = jb;
  int32_t first = -1;
  ASSERT_EQ(mlcp_problem_rows_add(p, &rows, &first), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(first, 0);
  const Matrix j = jacobian_of(p);
  EXPECT_EQ(j.pointers, (std::vector<int32_t>{0, 5, 8, 10}));
  EXPECT_EQ(j.indices, (std::vector<int32_t>{2, 3, 4, 0, 1, 2, 3, 4, 0, 1}));
  EXPECT_EQ(j.values, (std::vector<double>{1, 2, 3, 6, 7, 8, 9, 10, 4, 5}));
  EXPECT_EQ(mlcp_problem_entry_count(p), 10);
  ASSERT_EQ(mlcp_problem_rows_add(p, &rows, &first), MLCP_OK);
  EXPECT_EQ(first, 3);
}

TEST_F(Rows, DefaultsOfAbsentArrays) {
  rows.count = 2;
  ASSERT_EQ(add(), MLCP_OK);
  double r[2], lo[2], hi[2], compliance[2];
  uint64_t key[2];
  ASSERT_EQ(mlcp_problem_get_rows(p, 2, r, lo, hi, compliance, key), MLCP_OK);
  EXPECT_EQ(r[1], 0);
  EXPECT_EQ(lo[1], 0);
  EXPECT_EQ(hi[1], inf);
  EXPECT_EQ(compliance[1], 0);
  EXPECT_EQ(key[1], 0u);
}

TEST_F(Rows, ArraysOfStructsByStrides) {
  struct Contact {
    int32_t a, b;
    double ja[2], jb[3];
    double r, lo, hi, soft;
    uint64_t key;
  } contacts[] = {{0, 1, {1, 2}, {3, 4, 5}, 6, 7, 8, 9, 10}, {0, 1, {11, 12}, {13, 14, 15}, 16, 17, 18, 19, 20}};
  rows.count = 2;
  rows.body_a = &contacts[0].a;
  rows.body_b = &contacts[0].b;
  rows.jacobian_a = contacts[0].ja;
  rows.jacobian_b = contacts[0].jb;
  rows.r = &contacts[0].r;
  rows.lo = &contacts[0].lo;
  rows.hi = &contacts[0].hi;
  rows.compliance = &contacts[0].soft;
  rows.key = &contacts[0].key;
  rows.jacobian_a_stride = rows.jacobian_b_stride = rows.value_stride = rows.body_stride = rows.key_stride = sizeof(Contact);
  ASSERT_EQ(add(), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(jacobian_of(p).values, (std::vector<double>{1, 2, 3, 4, 5, 11, 12, 13, 14, 15}));
  double r[2], lo[2], hi[2], compliance[2];
  uint64_t key[2];
  ASSERT_EQ(mlcp_problem_get_rows(p, 2, r, lo, hi, compliance, key), MLCP_OK);
  EXPECT_EQ(r[1], 16);
  EXPECT_EQ(lo[1], 17);
  EXPECT_EQ(hi[1], 18);
  EXPECT_EQ(compliance[1], 19);
  EXPECT_EQ(key[1], 20u);
}

TEST_F(Rows, SinglePrecisionTwin) {
  mlcp_rows_f32 single;
  mlcp_rows_f32_init(&single, sizeof single);
  const int32_t a[] = {0, 1}, b[] = {1, world};
  const float ja[] = {1, 2, 3, 4, 5}, jb[] = {6, 7, 8}, r[] = {0.5f, 0.25f}, hi[] = {INFINITY, 2};
  single.count = 2;
  single.body_a = a;
  single.body_b = b;
  single.jacobian_a = ja;
  single.jacobian_b = jb;
  single.r = r;
  single.hi = hi;
  int32_t first = -1;
  ASSERT_EQ(mlcp_problem_rows_add_f32(p, &single, &first), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(jacobian_of(p).values, (std::vector<double>{1, 2, 6, 7, 8, 3, 4, 5}));
  double out[2], upper[2];
  ASSERT_EQ(mlcp_problem_get_rows(p, 2, out, nullptr, upper, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(out[1], 0.25);
  EXPECT_EQ(upper[0], inf);
  const float bad[] = {0, NAN};
  single.r = bad;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "r[1]", [&] { return mlcp_problem_rows_add_f32(p, &single, nullptr); });
}

TEST_F(Rows, SameBodyTwice) {
  const int32_t a[] = {world, 1}, b[] = {world, 1};
  const double j[] = {1, 2, 3};
  rows.count = 2;
  rows.body_a = a;
  rows.body_b = b;
  rows.jacobian_a = rows.jacobian_b = j;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "body_b[1] = 1", [&] { return add(); });
}

TEST_F(Rows, UnknownBody) {
  const int32_t a[] = {0, 2}, below[] = {0, -2};
  const double j[] = {1, 2, 3, 4, 5, 6};
  rows.count = 2;
  rows.body_a = a;
  rows.jacobian_a = j;
  expect_refused(p, MLCP_ERROR_RANGE, "body_a[1] = 2", [&] { return add(); });
  rows.body_a = below;
  expect_refused(p, MLCP_ERROR_RANGE, "body_a[1] = -2", [&] { return add(); });
}

TEST_F(Rows, JacobianMissing) {
  const int32_t b[] = {world, 1};
  rows.count = 2;
  rows.body_b = b;
  expect_refused(p, MLCP_ERROR_NULL, "body_b[1] = 1", [&] { return add(); });
}

TEST_F(Rows, JacobianNotFinite) {
  const int32_t a[] = {0, 0};
  const double j[] = {1, 2, 3, inf};
  rows.count = 2;
  rows.body_a = a;
  rows.jacobian_a = j;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "jacobian_a of row 1: number 1", [&] { return add(); });
}

TEST_F(Rows, BoundsThatAreNone) {
  rows.count = 2;
  const double low[] = {0, 2}, high[] = {0, 1}, up[] = {0, inf}, down[] = {0, -inf}, bad[] = {0, not_a_number};
  rows.lo = low;
  rows.hi = high;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[1] = 2 is above hi[1] = 1", [&] { return add(); });
  rows.lo = up;
  rows.hi = nullptr;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[1]", [&] { return add(); });
  rows.lo = bad;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[1]", [&] { return add(); });
  rows.lo = down;
  rows.hi = down;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "hi[1]", [&] { return add(); });
  rows.hi = bad;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "hi[1]", [&] { return add(); });
}

TEST_F(Rows, InfiniteBoundsAndEqualBoundsAreLegal) {
  const double lo[] = {-inf, 3}, hi[] = {inf, 3};
  rows.count = 2;
  rows.lo = lo;
  rows.hi = hi;
  EXPECT_EQ(add(), MLCP_OK);
}

TEST_F(Rows, RightHandSideNotFinite) {
  const double r[] = {0, -inf};
  rows.count = 2;
  rows.r = r;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "r[1]", [&] { return add(); });
}

TEST_F(Rows, NegativeComplianceOnlyWithoutEntries) {
  const double soft[] = {-1}, bad[] = {inf}, j[] = {0, 0};
  const int32_t a[] = {0};
  rows.count = 1;
  rows.compliance = soft;
  EXPECT_EQ(add(), MLCP_OK);
  rows.body_a = a;
  rows.jacobian_a = j;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "compliance[0] = -1", [&] { return add(); });
  rows.compliance = bad;
  expect_refused(p, MLCP_ERROR_ARGUMENT, "compliance[0]", [&] { return add(); });
}

TEST_F(Rows, NegativeCount) {
  rows.count = -3;
  expect_refused(p, MLCP_ERROR_RANGE, "count = -3", [&] { return add(); });
}

TEST_F(Rows, OneOverAnyVelocities) {
  EXPECT_EQ(add_row(p, {4, 0}, {1, 0}, 7), 0);
  EXPECT_EQ(add_row(p, {4, 0}, {1, 0}, 7), 1);
  EXPECT_EQ(add_row(p, {}, {}), 2);
  EXPECT_EQ(jacobian_of(p).indices, (std::vector<int32_t>{4, 0, 4, 0}));
  EXPECT_EQ(jacobian_of(p).values, (std::vector<double>{1, 0, 1, 0}));
}

TEST_F(Rows, OneDuplicateColumn) {
  const int32_t columns[] = {3, 1, 3};
  const double values[] = {1, 2, 3};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "columns[2] = 3",
                 [&] { return mlcp_problem_row_add(p, 3, columns, values, 0, 0, inf, 0, 0, nullptr); });
}

TEST_F(Rows, OneRefused) {
  const int32_t columns[] = {5}, below[] = {-1}, fine[] = {0};
  const double values[] = {1}, bad[] = {not_a_number};
  const auto row = [&](int32_t count, const int32_t* c, const double* v, double r, double lo, double hi, double soft) {
    return mlcp_problem_row_add(p, count, c, v, r, lo, hi, soft, 0, nullptr);
  };
  expect_refused(p, MLCP_ERROR_RANGE, "columns[0] = 5", [&] { return row(1, columns, values, 0, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_RANGE, "columns[0] = -1", [&] { return row(1, below, values, 0, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[0]", [&] { return row(1, fine, bad, 0, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_NULL, "columns", [&] { return row(1, nullptr, values, 0, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_NULL, "values", [&] { return row(1, fine, nullptr, 0, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_RANGE, "count = -1", [&] { return row(-1, fine, values, 0, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[0] = 2 is above", [&] { return row(1, fine, values, 0, 2, 1, 0); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "r[0]", [&] { return row(1, fine, values, inf, 0, 1, 0); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "compliance[0]", [&] { return row(1, fine, values, 0, 0, 1, -1); });
}

TEST_F(Rows, CompressedRowsAndColumnsGiveTheSame) {
  const int32_t rp[] = {0, 2, 2, 5}, rc[] = {1, 4, 0, 2, 3}, cp[] = {0, 1, 2, 3, 4, 5}, cr[] = {2, 0, 2, 2, 0};
  const double rv[] = {1, 2, 3, 4, 5}, cv[] = {3, 1, 4, 5, 2}, r[] = {1, 2, 3}, lo[] = {-inf, 0, -1}, hi[] = {inf, 1, 1},
               soft[] = {0, 0.5, 0};
  const uint64_t key[] = {1, 0, 1};
  ProblemHandle other = make_problem();
  add_body(other.get(), 2);
  add_body(other.get(), 3);
  int32_t first = -1;
  ASSERT_EQ(mlcp_problem_rows_add_csr(p, 3, rp, rc, rv, r, lo, hi, soft, key, &first), MLCP_OK) << mlcp_problem_error(p);
  EXPECT_EQ(first, 0);
  ASSERT_EQ(mlcp_problem_rows_add_csc(other.get(), 3, cp, cr, cv, r, lo, hi, soft, key, &first), MLCP_OK);
  EXPECT_EQ(snapshot(p), snapshot(other.get()));
  ASSERT_EQ(mlcp_problem_rows_add_csc(p, 3, cp, cr, cv, nullptr, nullptr, nullptr, nullptr, nullptr, &first), MLCP_OK);
  EXPECT_EQ(first, 3);
  EXPECT_EQ(jacobian_of(p).pointers, (std::vector<int32_t>{0, 2, 2, 5, 7, 7, 10}));
}

TEST_F(Rows, CompressedOfNothing) {
  const double* none = nullptr;
  EXPECT_EQ(mlcp_problem_rows_add_csr(p, 0, nullptr, nullptr, none, none, none, none, none, nullptr, nullptr), MLCP_OK);
  mlcp_problem* bare = make_problem().release();
  EXPECT_EQ(mlcp_problem_rows_add_csc(bare, 2, nullptr, nullptr, none, none, none, none, none, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(mlcp_problem_row_count(bare), 2);
  mlcp_problem_destroy(bare);
}

TEST_F(Rows, CompressedRowsRefused) {
  const auto csr = [&](const int32_t* pointers, const int32_t* columns, const double* values, const double* lo) {
    return mlcp_problem_rows_add_csr(p, 2, pointers, columns, values, nullptr, lo, nullptr, nullptr, nullptr, nullptr);
  };
  const int32_t pointers[] = {0, 1, 3}, falling[] = {0, 3, 1}, late[] = {1, 1, 3}, columns[] = {0, 1, 4}, out[] = {0, 1, 5},
                twice[] = {0, 1, 1};
  const double values[] = {1, 2, 3}, bad[] = {1, 2, inf}, lo[] = {0, not_a_number};
  expect_refused(p, MLCP_ERROR_ARGUMENT, "row_pointers[2] = 1", [&] { return csr(falling, columns, values, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "row_pointers[0] = 1", [&] { return csr(late, columns, values, nullptr); });
  expect_refused(p, MLCP_ERROR_RANGE, "columns[2] = 5", [&] { return csr(pointers, out, values, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "columns[2] = 1", [&] { return csr(pointers, twice, values, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[2]", [&] { return csr(pointers, columns, bad, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "lo[1]", [&] { return csr(pointers, columns, values, lo); });
  expect_refused(p, MLCP_ERROR_NULL, "row_pointers", [&] { return csr(nullptr, columns, values, nullptr); });
  expect_refused(p, MLCP_ERROR_NULL, "columns", [&] { return csr(pointers, nullptr, values, nullptr); });
  expect_refused(p, MLCP_ERROR_NULL, "values", [&] { return csr(pointers, columns, nullptr, nullptr); });
}

TEST_F(Rows, CompressedColumnsRefused) {
  const auto csc = [&](const int32_t* pointers, const int32_t* indices, const double* values, const double* soft) {
    return mlcp_problem_rows_add_csc(p, 2, pointers, indices, values, nullptr, nullptr, nullptr, soft, nullptr, nullptr);
  };
  const int32_t pointers[] = {0, 2, 2, 2, 2, 3}, indices[] = {1, 0, 1}, out[] = {1, 0, 2}, twice[] = {1, 1, 0};
  const double values[] = {1, 2, 3}, bad[] = {1, not_a_number, 3}, soft[] = {0, -1};
  expect_refused(p, MLCP_ERROR_RANGE, "row_indices[2] = 2", [&] { return csc(pointers, out, values, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "row_indices[1] = 1", [&] { return csc(pointers, twice, values, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "values[1]", [&] { return csc(pointers, indices, bad, nullptr); });
  expect_refused(p, MLCP_ERROR_ARGUMENT, "compliance[1]", [&] { return csc(pointers, indices, values, soft); });
  expect_refused(p, MLCP_ERROR_NULL, "column_pointers", [&] { return csc(nullptr, indices, values, nullptr); });
}

TEST_F(Rows, NullHandles) {
  EXPECT_EQ(mlcp_problem_rows_add(nullptr, &rows, nullptr), MLCP_ERROR_NULL);
  expect_refused(p, MLCP_ERROR_NULL, "rows is NULL", [&] { return mlcp_problem_rows_add(p, nullptr, nullptr); });
  EXPECT_EQ(mlcp_problem_row_add(nullptr, 0, nullptr, nullptr, 0, 0, 0, 0, 0, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_problem_rows_clear(nullptr), MLCP_ERROR_NULL);
}
