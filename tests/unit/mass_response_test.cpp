#include "factorize/mass_response.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "analyze/analysis.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

TEST(MassResponse, IsTheColumnOfInverseMassTimesJacobian) {
  for (int seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, random.integer(1, 6), random.integer(1, 6), 1);
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, true, {});
    mlcp::KktValues values{mlcp::Memory()};
    values.load(p, analysis.pattern);
    mlcp::MassResponse response{mlcp::Memory()};
    response.prepare(analysis.parts, analysis.pattern);
    std::int64_t work = 0;
    const Dense d = dense(p);
    const Matrix inverse = d.M.inverse();
    for (const mlcp::Island& island : analysis.symbolic.islands) {
      ASSERT_TRUE(response.compute(island, values, work));
      for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
        const int row = analysis.pattern.node[analysis.pattern.row_position[o]] - p.n();
        const Vector expected = inverse * d.J.row(row).transpose();
        std::vector<double> x(analysis.pattern.size(), 0.0);
        response.velocity.assign(response.velocity.size(), 0.0);
        response.rows().add(o, 1, response.velocity.data());
        response.give(island, x.data());
        ASSERT_NEAR(response.rows().product(o, response.velocity.data()), static_cast<double>(d.J.row(row) * expected), 1e-12) << "seed " << seed;
        for (int j = 0; j < p.n(); ++j) ASSERT_NEAR(x[analysis.pattern.position[j]], static_cast<double>(expected[j]), 1e-12) << "seed " << seed;
        ASSERT_NEAR(response.diagonal[o], static_cast<double>(d.J.row(row) * expected), 1e-12) << "seed " << seed;
      }
    }
  }
}

/// Any number of islands: bodies with dense, sparse and diagonal masses, some prescribed, rows on any of them, compliance.
struct Response {
  mlcp::Problem problem = empty_problem();
  mlcp::Analysis analysis{mlcp::Memory()};
  mlcp::KktValues values{mlcp::Memory()};
  mlcp::MassResponse response{mlcp::Memory()};
  Dense d;
  Matrix inverse;  ///< of M over the dynamic velocities, 0 elsewhere

  explicit Response(Random& random) {
    for (int b = random.integer(1, 8); b > 0; --b) {
      const int size = random.integer(1, 9);
      const bool diagonal = random.chance(0.5);
      const int body = add_sparse_body(problem, diagonal ? Eigen::MatrixXd(random.uniform(1, 2) * Eigen::MatrixXd::Identity(size, size))
                                                         : random_mass(random, size, random.chance(0.5)));
      if (random.chance(0.1)) prescribe(problem, body, std::vector<double>(size, 1));
    }
    set_k(problem, Eigen::VectorXd::Ones(problem.n()));
    for (int i = random.integer(1, 12); i > 0; --i) {
      std::vector<Entry> entries;
      for (int j = 0; j < problem.n(); ++j)
        if (random.chance(3.0 / problem.n())) entries.push_back({j, random.uniform()});
      add_row(problem, entries, 0, unilateral, random.chance(0.5) ? random.uniform(0.1, 1) : 0);
    }
    analysis.run(problem, nullptr, true, {});
    values.load(problem, analysis.pattern);
    response.prepare(analysis.parts, analysis.pattern);
    std::int64_t work = 0;
    for (const mlcp::Island& island : islands()) EXPECT_TRUE(response.compute(island, values, work));
    d = dense(problem);
    Matrix M = d.M;
    for (int j = 0; j < d.n(); ++j) {
      if (d.dynamic[j]) continue;
      M.row(j).setZero();
      M.col(j).setZero();
      M(j, j) = 1;
    }
    inverse = M.inverse();
    for (int j = 0; j < d.n(); ++j)
      if (!d.dynamic[j]) inverse(j, j) = 0;
  }
  const mlcp::Array<mlcp::Island>& islands() const { return analysis.symbolic.islands; }
  int row(int o) const { return analysis.pattern.node[analysis.pattern.row_position[o]] - problem.n(); }

  /// response.velocity by velocity of the problem; `missing` where a velocity has no position. Rows of x are left alone.
  Vector velocity(const Vector& missing) const {
    std::vector<double> x(analysis.pattern.size(), -7);
    for (const mlcp::Island& island : islands()) response.give(island, x.data());
    Vector v = missing;
    for (int p = 0; p < analysis.pattern.size(); ++p) {
      if (analysis.pattern.is_row(p))
        EXPECT_EQ(x[p], -7);
      else
        v[analysis.pattern.node[p]] = x[p];
    }
    return v;
  }
  /// Of that island's velocities.
  bool holds(const mlcp::Island& island, int velocity) const {
    const int p = analysis.pattern.position[velocity];
    return p >= island.first && p < island.last;
  }
};

TEST(MassResponse, DiagonalHasTheCompliance) {
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const Response r(random);
    for (int o = 0; o < r.analysis.pattern.rows(); ++o) {
      const Vector j = r.d.J.row(r.row(o));
      const Real a = j.dot(r.inverse * j) + r.d.S(r.row(o), r.row(o));
      ASSERT_NEAR(r.response.diagonal[o], static_cast<double>(a), 1e-13 * (1 + static_cast<double>(a))) << "seed " << seed;
      if (a == 0) continue;
      ASSERT_DOUBLE_EQ(r.response.inverse[o], 1 / r.response.diagonal[o]) << "seed " << seed;
    }
  }
}

TEST(MassResponse, SolvesAndMultipliesOnEveryIsland) {
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    Response r(random);
    std::vector<double> x(r.analysis.pattern.size());
    Vector k = Vector::Zero(r.problem.n());
    for (int p = 0; p < r.analysis.pattern.size(); ++p) {
      x[p] = random.uniform();
      if (!r.analysis.pattern.is_row(p)) k[r.analysis.pattern.node[p]] = x[p];
    }
    for (const mlcp::Island& island : r.islands()) r.response.solve(island, x.data());
    const Vector expected = r.inverse * k, v = r.velocity(expected);
    for (int j = 0; j < r.problem.n(); ++j) ASSERT_NEAR(v[j], static_cast<double>(expected[j]), 1e-12) << "seed " << seed << ", velocity " << j;
    for (int o = 0; o < r.analysis.pattern.rows(); ++o) {
      const Real w = r.d.J.row(r.row(o)) * expected;
      ASSERT_NEAR(r.response.rows().product(o, r.response.velocity.data()), static_cast<double>(w), 1e-12) << "seed " << seed << ", row " << r.row(o);
    }
  }
}

/// velocity += t · direction there, and nowhere else.
TEST(MassResponse, DirectionsOfAnIslandAreItsOwn) {
  int beside = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    Response r(random);
    const int rows = r.analysis.pattern.rows();
    Vector impulse(r.problem.m());
    for (int i = 0; i < impulse.size(); ++i) impulse[i] = random.uniform();
    for (const mlcp::Island& island : r.islands()) {
      r.response.velocity.assign(r.response.velocity.size(), 0.0);
      r.response.direction.assign(r.response.direction.size(), 3.0);
      for (const mlcp::Island& other : r.islands()) r.response.clear_direction(other);
      for (int o = 0; o < rows; ++o) r.response.rows().add(o, static_cast<double>(impulse[r.row(o)]), r.response.direction.data());
      r.response.advance(island, -0.5);
      const Vector expected = -0.5 * (r.inverse * (r.d.J.transpose() * impulse)), v = r.velocity(Vector::Zero(r.problem.n()));
      for (int j = 0; j < r.problem.n(); ++j) {
        const bool own = r.holds(island, j);
        ASSERT_NEAR(v[j], own ? static_cast<double>(expected[j]) : 0, 1e-12) << "seed " << seed << ", velocity " << j;
        beside += !own && expected[j] != 0;
      }
      // what is cleared is that island's alone
      r.response.clear_direction(island);
      for (const mlcp::Island& other : r.islands()) r.response.advance(other, 1);
      const Vector after = r.velocity(Vector::Zero(r.problem.n()));
      for (int j = 0; j < r.problem.n(); ++j) {
        if (r.analysis.pattern.position[j] < 0) continue;
        ASSERT_NEAR(after[j], static_cast<double>(r.holds(island, j) ? expected[j] : -2 * expected[j]), 1e-12) << "seed " << seed << ", velocity " << j;
      }
    }
  }
  EXPECT_GT(beside, 50);
}

TEST(MassResponse, LargePartsAndIndefiniteOnesAreRefused) {
  Random random(2);
  for (const bool large : {true, false}) {
    mlcp::Problem p = empty_problem();
    if (large)
      add_sparse_body(p, random_mass(random, mlcp::MassParts::largest + 1, false));
    else
      add_sparse_body(p, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
    add_row(p, {{0, 1}});
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, true, {});
    mlcp::KktValues values{mlcp::Memory()};
    values.load(p, analysis.pattern);
    mlcp::MassResponse response{mlcp::Memory()};
    response.prepare(analysis.parts, analysis.pattern);
    std::int64_t work = 0;
    EXPECT_FALSE(response.compute(analysis.symbolic.islands[0], values, work));
  }
}

}  // namespace
}  // namespace support
