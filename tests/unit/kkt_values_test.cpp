#include "factorize/kkt_values.h"

#include <gtest/gtest.h>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

void expect_values_of(const mlcp::Problem& problem, const mlcp::Mask* enabled) {
  const Stage stage(problem, enabled);
  const mlcp::KktPattern& k = stage.pattern();
  const Dense d = dense(problem, enabled);
  const Matrix K = kkt_matrix(d), loaded = stage.loaded();
  for (int p = 0; p < k.size(); ++p) {
    for (int q = 0; q < k.size(); ++q) ASSERT_EQ(loaded(p, q), K(k.node[p], k.node[q])) << p << ' ' << q;
    if (!k.is_row(p)) {
      ASSERT_EQ(stage.values.b[p], d.k[k.node[p]]);
      continue;
    }
    const int i = k.node[p] - d.n(), o = k.row_ordinal[p];
    Real b = d.r[i], a = d.S(i, i);
    for (int j = 0; j < d.n(); ++j) {
      if (!d.dynamic[j]) b -= d.J(i, j) * d.given[j];
      else a += d.J(i, j) * d.J(i, j) / d.M(j, j);
    }
    ASSERT_NEAR(stage.values.b[p], static_cast<double>(b), 1e-14);
    ASSERT_NEAR(stage.values.a[o], static_cast<double>(a), 1e-14 * static_cast<double>(a));
    ASSERT_EQ(stage.values.lo[o], problem.lo[i]);
    ASSERT_EQ(stage.values.hi[o], problem.hi[i]);
    for (auto t = k.row_pointers[o]; t < k.row_pointers[o + 1]; ++t)
      ASSERT_EQ(stage.values.row[t], K(k.node[p], k.node[k.row_columns[t]]));
  }
}

TEST(KktValues, RandomProblemsEqualTheDenseMatrix) {
  Shape shape;
  shape.bodies_most = 5;
  shape.rows_most = 12;
  shape.dimension_most = 15;
  shape.prescribed = 0.3;
  for (int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, shape);
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    expect_values_of(p, random.chance(0.5) ? &enabled : nullptr);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST(KktValues, PrescribedVelocityMovesIntoTheRightHandSide) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 2);
  add_body(p, 1, 2);
  prescribe(p, 1, {3});
  add_row(p, {{0, 1}, {1, -2}}, 0.5);
  const Stage stage(p);
  EXPECT_EQ(stage.values.b[stage.pattern().position[2]], 6.5);
  EXPECT_EQ(stage.values.a[0], 0.5) << "a counts dynamic velocities alone";
}

TEST(KktValues, SofteningAddsToTheDiagonalAndIsUndone) {
  Random random(7);
  const mlcp::Problem p = random_chain(random, 5, 2, 1);
  Stage stage(p);
  const Matrix before = stage.loaded();
  const int rows = stage.pattern().rows();
  stage.values.soften(p, stage.pattern(), 0, rows, 1e-3);
  const Matrix softened = stage.loaded();
  for (int o = 0; o < rows; ++o) {
    const int q = stage.pattern().row_position[o];
    EXPECT_NEAR(static_cast<double>(softened(q, q)), static_cast<double>(before(q, q)) - 1e-3 * stage.values.a[o], 1e-15);
  }
  stage.values.soften(p, stage.pattern(), 0, rows, 0);
  EXPECT_EQ(stage.loaded(), before);
}

}  // namespace
}  // namespace support
