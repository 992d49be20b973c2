#include "factorize/normal_equations.h"

#include <gtest/gtest.h>

#include "factorize/dense_response.h"
#include "support/build.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

/// Components and numbers of a problem, all of them taken.
struct Normal {
  mlcp::Components components{mlcp::Memory()};
  mlcp::NormalEquations equations{mlcp::Memory()};
  std::vector<std::uint8_t> taken;
  explicit Normal(const mlcp::Problem& p) {
    components.update(p, nullptr);
    taken.assign(components.count(), 1);
    equations.prepare(p, components, taken);
  }
};

/// Bodies in a line, some of them prescribed, with many contacts on each and compliance on some.
mlcp::Problem crowd(Random& random) {
  mlcp::Problem p = random_chain(random, random.integer(1, 7), random.integer(1, 5), 1);
  for (int rows = random.integer(0, 30); rows > 0; --rows) {
    std::vector<Entry> entries;
    for (int j = 0; j < p.n(); ++j)
      if (random.chance(0.3)) entries.push_back({j, random.uniform()});
    if (!entries.empty()) add_row(p, entries, random.uniform(), unilateral, random.chance(0.3) ? random.uniform(0, 1) : 0);
  }
  if (random.chance(0.3)) prescribe(p, 0, std::vector<double>(p.bodies[0].dimension, 0.5));
  return p;
}

TEST(NormalEquations, ResidualsAreThoseOfTheProblem) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const mlcp::Problem p = crowd(random);
    const Dense d = dense(p);
    Normal normal(p);
    for (int c = 0; c < normal.components.count(); ++c) {
      ASSERT_TRUE(normal.equations.load(p, c));
      mlcp::NormalIsland& s = normal.equations.island(c);
      for (int q = 0; q < s.n; ++q) s.v[q] = random.uniform();
      for (int i = 0; i < s.m; ++i) s.gamma[i] = random.uniform();
      mlcp::NormalEquations::residuals(s);
      for (int q = 0; q < s.n; ++q) {
        Real momentum = d.k[s.velocity(q)];
        for (int e = 0; e < s.n; ++e) momentum -= d.M(s.velocity(q), s.velocity(e)) * s.v[e];
        for (int i = 0; i < s.m; ++i) momentum += d.J(s.row[i], s.velocity(q)) * s.gamma[i];
        ASSERT_NEAR(s.momentum[q], static_cast<double>(momentum), 1e-13);
      }
      for (int i = 0; i < s.m; ++i) {
        Real w = d.S(s.row[i], s.row[i]) * s.gamma[i] - d.r[s.row[i]], terms = std::abs(d.S(s.row[i], s.row[i]) * s.gamma[i]) + std::abs(d.r[s.row[i]]), a = d.S(s.row[i], s.row[i]);
        for (int j = 0; j < d.n(); ++j) {
          if (d.dynamic[j]) continue;
          w += d.J(s.row[i], j) * d.given[j];
          terms += 2 * std::abs(d.J(s.row[i], j) * d.given[j]);
        }
        for (int e = 0; e < s.n; ++e) {
          const Real entry = d.J(s.row[i], s.velocity(e)), diagonal = d.M(s.velocity(e), s.velocity(e));
          w += entry * s.v[e];
          terms += std::abs(entry) * (std::abs(s.v[e]) + std::abs(d.k[s.velocity(e)] / diagonal));
          a += entry * entry / diagonal;
        }
        ASSERT_NEAR(s.w[i], static_cast<double>(w), 1e-13);
        ASSERT_NEAR(mlcp::NormalEquations::terms(s, i), static_cast<double>(terms), 1e-12);
        ASSERT_NEAR(s.a[i], static_cast<double>(a), 1e-13 * (1 + s.a[i]));
      }
    }
  }
}

TEST(NormalEquations, SolveTheSaddlePointSystem) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const mlcp::Problem p = crowd(random);
    const Dense d = dense(p);
    Normal normal(p);
    for (int c = 0; c < normal.components.count(); ++c) {
      ASSERT_TRUE(normal.equations.load(p, c));
      mlcp::NormalIsland& s = normal.equations.island(c);
      std::vector<double> momentum(s.n), f(s.m);
      for (int q = 0; q < s.padded_velocities(); ++q) s.momentum[q] = q < s.n ? momentum[q] = random.uniform() : 0;
      for (int i = 0; i < s.padded_rows(); ++i) {
        s.weight[i] = i < s.m && random.chance(0.7) ? random.uniform(0.1, 2) : 0;
        s.dgamma[i] = i < s.m ? f[i] = random.uniform() : 0;
      }
      ASSERT_TRUE(mlcp::NormalEquations::factor(s));
      mlcp::NormalEquations::solve(s);
      for (int q = 0; q < s.n; ++q) {
        Real sum = -momentum[q];
        for (int e = 0; e < s.n; ++e) sum += d.M(s.velocity(q), s.velocity(e)) * s.step[e];
        for (int i = 0; i < s.m; ++i) sum -= d.J(s.row[i], s.velocity(q)) * s.dgamma[i];
        ASSERT_NEAR(static_cast<double>(sum), 0, 1e-11);
      }
      for (int i = 0; i < s.m; ++i) {
        if (s.weight[i] == 0) {
          ASSERT_EQ(s.dgamma[i], 0);
          continue;
        }
        Real sum = s.dgamma[i] / s.weight[i] - f[i];
        for (int e = 0; e < s.n; ++e) sum += d.J(s.row[i], s.velocity(e)) * s.step[e];
        ASSERT_NEAR(static_cast<double>(sum), 0, 1e-11);
      }
    }
  }
}

TEST(NormalEquations, RefuseWhatTheyDoNotKnow) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 1);
  add_row(p, {{0, 1}});
  add_row(p, {{0, 1}, {1, 1}});
  ASSERT_TRUE(Normal(p).equations.load(p, 0));
  set_sigma(p, (Eigen::Matrix2d() << 1, 0.5, 0.5, 1).finished());
  EXPECT_FALSE(Normal(p).equations.load(p, 0)) << "rows that Σ couples";

  mlcp::Problem indefinite = empty_problem();
  add_sparse_body(indefinite, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());  // dense ones are checked when they are added
  add_row(indefinite, {{0, 1}});
  Normal no(indefinite);
  ASSERT_TRUE(no.equations.load(indefinite, 0));
  mlcp::NormalIsland& s = no.equations.island(0);
  std::fill(s.weight, s.weight + s.padded_rows(), 0.0);
  EXPECT_FALSE(mlcp::NormalEquations::factor(s));
  s.weight[0] = 10;
  EXPECT_TRUE(mlcp::NormalEquations::factor(s)) << "M + 10 J'J is positive definite";
}

TEST(NormalEquations, LeaveOutWhatOthersTake) {
  mlcp::Problem p = empty_problem();
  for (int b = 0; b < 3; ++b) {
    add_body(p, 1, 1 + b);
    add_row(p, {{b, 1}}, b);
  }
  mlcp::Components components{mlcp::Memory()};
  components.update(p, nullptr);
  ASSERT_EQ(components.count(), 3);
  mlcp::NormalEquations equations{mlcp::Memory()};
  const std::vector<std::uint8_t> taken = {1, 0, 1};
  equations.prepare(p, components, taken);
  mlcp::DenseResponse others{mlcp::Memory()};
  others.prepare(p, components, taken);
  for (const int c : {0, 2}) {
    ASSERT_TRUE(equations.load(p, c));
    EXPECT_EQ(equations.island(c).r[0], c);
    EXPECT_EQ(equations.island(c).a[0], 1.0 / (1 + c));
  }
  ASSERT_TRUE(others.compute(p, 1));
  EXPECT_EQ(others.island(1).response(0, 0), 0.5);
}

}  // namespace
}  // namespace support
