#include "factorize/dense_response.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

/// Components and numbers of a problem.
struct Loaded {
  mlcp::Components components{mlcp::Memory()};
  mlcp::DenseResponse response{mlcp::Memory()};
  explicit Loaded(const mlcp::Problem& p) {
    components.update(p, nullptr);
    response.prepare(p, components);
  }
};

TEST(DenseResponse, IsTheReducedProblemOfEachComponent) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_most = 6, .rows_most = 8, .disabled = 0});
    Loaded loaded(p);
    const Reduced reduced = reduce(dense(p));
    for (int c = 0; c < loaded.components.count(); ++c) {
      ASSERT_TRUE(loaded.response.compute(p, c)) << "seed " << seed;
      const mlcp::DenseIsland s = loaded.response.island(c);
      for (int i = 0; i < s.m; ++i) {
        ASSERT_NEAR(s.b[i], static_cast<double>(reduced.b[s.row[i]]), 1e-12 * (1 + s.size[i])) << "seed " << seed;
        for (int j = 0; j < s.m; ++j) {
          const double scale = std::sqrt(s.response(i, i) * s.response(j, j));
          ASSERT_NEAR(s.response(i, j), static_cast<double>(reduced.A(s.row[i], s.row[j])), 1e-12 * scale) << "seed " << seed;
        }
      }
    }
  }
}

TEST(DenseResponse, CorrectionSolvesTheSaddlePointSystem) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(1, 5), 3, 2);
    Loaded loaded(p);
    const Dense d = dense(p);
    for (int c = 0; c < loaded.components.count(); ++c) {
      ASSERT_TRUE(loaded.response.compute(p, c));
      mlcp::DenseIsland s = loaded.response.island(c);
      *s.members = 0;
      for (int i = 0; i < s.m; i += 2) s.member[(*s.members)++] = i;
      mlcp::DenseResponse::factor_active(s, 1e-9);
      const int active = *s.members;
      Matrix K = Matrix::Zero(s.n + active, s.n + active);
      Vector b(s.n + active);
      for (int a = 0; a < s.n; ++a)
        for (int e = 0; e < s.n; ++e) K(a, e) = d.M(s.velocity(a), s.velocity(e));
      for (int t = 0; t < active; ++t)
        for (int a = 0; a < s.n; ++a) {
          K(s.n + t, a) = d.J(s.row[s.member[t]], s.velocity(a));
          K(a, s.n + t) = -K(s.n + t, a);
        }
      for (int t = 0; t < active; ++t)
        for (int u = 0; u < active; ++u) K(s.n + t, s.n + u) = d.S(s.row[s.member[t]], s.row[s.member[u]]);
      const auto x = [&](int a) -> double& { return a < s.n ? s.x[a] : s.x_rows()[a - s.n]; };
      for (int a = 0; a < s.n + active; ++a) b[a] = x(a) = random.uniform();
      mlcp::DenseResponse::correct(s);
      const Vector expected = K.fullPivLu().solve(b);
      for (int a = 0; a < s.n + active; ++a) ASSERT_NEAR(x(a), static_cast<double>(expected[a]), 1e-9 * (1 + expected.norm())) << "seed " << seed;
    }
  }
}

TEST(DenseResponse, DependentRowsAreLeftOutOfTheFactor) {
  mlcp::Problem p = empty_problem();
  add_body(p, Eigen::MatrixXd::Identity(2, 2));
  for (int i = 0; i < 3; ++i) add_row(p, {{0, 1.0 + i}, {1, 2.0}});
  Loaded loaded(p);
  ASSERT_TRUE(loaded.response.compute(p, 0));
  mlcp::DenseIsland s = loaded.response.island(0);
  for (*s.members = 0; *s.members < 3; ++*s.members) s.member[*s.members] = *s.members;
  mlcp::DenseResponse::factor_active(s, 1e-9);
  EXPECT_EQ(*s.members, 2);
  EXPECT_NEAR(mlcp::DenseResponse::schur(s, 2), 0, 1e-13);
}

// The inverse of a denormal pivot overflows, and infinity times the zeros of the rows that fill the block is no number.
TEST(DenseResponse, RowsWithPivotsThatHaveNoInverseAreLeftOutOfTheFactor) {
  for (const double other : {0.0, 1.0, 1e150}) {
    mlcp::Problem p = empty_problem();
    add_body(p, Eigen::MatrixXd::Identity(2, 2));
    add_row(p, {{0, 1e-158}});
    if (other != 0) add_row(p, {{0, other}, {1, other}});
    Loaded loaded(p);
    ASSERT_TRUE(loaded.response.compute(p, 0));
    mlcp::DenseIsland s = loaded.response.island(0);
    ASSERT_GT(s.response(0, 0), 0);
    for (*s.members = 0; *s.members < s.m; ++*s.members) s.member[*s.members] = *s.members;
    mlcp::DenseResponse::factor_active(s, 1e-13);
    ASSERT_EQ(*s.members, s.m - 1);
    if (other != 0) {
      EXPECT_EQ(s.member[0], 1);
    }
  }
}

TEST(DenseResponse, AnIndefiniteMassIsRefused) {
  mlcp::Problem p = empty_problem();
  add_sparse_body(p, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
  add_row(p, {{0, 1}});
  Loaded loaded(p);
  EXPECT_FALSE(loaded.response.compute(p, 0));
}

}  // namespace
}  // namespace support
