// Conjugate gradients on the rows between their bounds, against the dense problem w = A γ + b.
#include "solve/subspace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/based.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

constexpr Bounds wide{-1e6, 1e6};

enum Kind { stiff, compliant, coupled, reduced };

void set_bounds(mlcp::Problem& problem, int row, Bounds bounds) {
  problem.lo[row] = bounds.lo;
  problem.hi[row] = bounds.hi;
}

/// One island whose rows may push both ways.
mlcp::Problem free_problem(Random& random, Kind kind) {
  if (kind == reduced) {
    const int rows = random.integer(2, 12);
    Eigen::MatrixXd B(rows, rows);
    Eigen::VectorXd b(rows);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < rows; ++j) B(i, j) = random.uniform();
      b[i] = random.uniform();
    }
    mlcp::Problem p = reduced_problem(B * B.transpose() + Eigen::MatrixXd::Identity(rows, rows), b);
    for (int i = 0; i < rows; ++i) set_bounds(p, i, wide);
    return p;
  }
  mlcp::Problem p = random_chain(random, random.integer(1, 8), random.integer(2, 6), 1);
  for (int i = 0; i < p.m(); ++i) set_bounds(p, i, wide);
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(p.m(), p.m());
  for (int i = 0; i < p.m(); ++i) sigma(i, i) = random.uniform(0.5, 2);
  for (int i = 0; i + 3 < p.m() && kind == coupled; ++i) sigma(i, i + 3) = sigma(i + 3, i) = random.uniform(-0.2, 0.2);
  if (kind != stiff) set_sigma(p, sigma);
  return p;
}

double largest(const Vector& x) { return x.size() ? static_cast<double>(x.cwiseAbs().maxCoeff()) : 0; }

struct Rows : Based {
  mlcp::Mask enabled;
  Dense d;
  Reduced a;

  explicit Rows(mlcp::Problem p, const std::vector<int>& disabled = {}) : Based(std::move(p)), enabled(mlcp::Memory()) {
    EXPECT_EQ(analysis.symbolic.islands.size(), 1u);
    enabled.state.assign(problem.m(), MLCP_ROW_AT_LOWER);
    for (const int i : disabled) {
      enabled.state[i] = MLCP_ROW_DISABLED;
      basis.rest(ordinal(i), mlcp::ActiveSet::disabled);
    }
    d = dense(problem, &enabled);
    a = reduce(d);
    EXPECT_TRUE(basis.response.compute(island(), basis.values, counts.work));
  }

  void start(const Vector& gamma) {
    for (int i = 0; i < problem.m(); ++i) basis.set.x[basis.position(ordinal(i))] = static_cast<double>(-gamma[i]);
    basis.response.solve(island(), basis.values.b.data());
    for (int i = 0; i < problem.m(); ++i) basis.response.rows().add(ordinal(i), static_cast<double>(gamma[i]), basis.response.velocity.data());
  }
  void minimise(int steps) { mlcp::Subspace(basis, counts).minimise(island(), steps); }

  Vector gamma() const {
    Vector gamma(problem.m());
    for (int i = 0; i < problem.m(); ++i) gamma[i] = basis.gamma(ordinal(i));
    return gamma;
  }
  /// Of the enabled rows alone.
  Vector reduced_gamma() const {
    const Vector all = gamma();
    Vector some(a.b.size());
    for (int i = 0; i < some.size(); ++i) some[i] = all[a.row[i]];
    return some;
  }
  Vector slacks() const { return a.A * reduced_gamma() + a.b; }
  /// Of the terms that slacks are sums of.
  double size() const { return static_cast<double>((a.A.cwiseAbs() * reduced_gamma().cwiseAbs() + a.size).maxCoeff()); }
  Real objective() const {
    const Vector g = reduced_gamma();
    return g.dot(a.A * g) / 2 + a.b.dot(g);
  }

  /// Velocities are M⁻¹(k + Jᵀγ).
  void expect_velocities(const char* when) {
    std::vector<double> x(analysis.pattern.size(), 0.0);
    basis.response.give(island(), x.data());
    const Vector g = gamma(), v = velocities(d, g);
    const double size = 1 + largest(v) + largest(g);
    for (int j = 0; j < problem.n(); ++j)
      ASSERT_NEAR(x[analysis.pattern.position[j]], static_cast<double>(v[j]), 1e-12 * size) << when;
  }
};

Vector random_vector(Random& random, int size) {
  Vector x(size);
  for (int i = 0; i < size; ++i) x[i] = random.uniform();
  return x;
}

class SubspaceOf : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Subspace, SubspaceOf, testing::Values(stiff, compliant, coupled, reduced));

TEST_P(SubspaceOf, FreeRowsComeToRest) {
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    Rows s(free_problem(random, GetParam()));
    s.start(random_vector(random, s.problem.m()));
    for (int again = 0; again < 4; ++again) s.minimise(300);
    const Vector expected = solve_spd(s.a.A, -s.a.b);
    ASSERT_LE(largest(s.slacks()), 1e-12 * s.size()) << "seed " << seed;
    ASSERT_LE(largest(s.gamma() - expected), 1e-8 * (1 + largest(expected))) << "seed " << seed;
    s.expect_velocities("in the end");
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

/// One call ends where what is left is 1e-12 of what there was, in rᵀD⁻¹r, and not much later.
TEST_P(SubspaceOf, EnoughIsEnough) {
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    Rows s(free_problem(random, GetParam()));
    s.start(10 * random_vector(random, s.problem.m()));
    const auto left = [&] {
      const Vector w = s.slacks();
      Real sum = 0;
      for (int i = 0; i < w.size(); ++i) sum += w[i] * w[i] / s.a.A(i, i);
      return sum;
    };
    const Real before = left();
    s.minimise(1000);
    ASSERT_LE(left(), 1.01e-12L * before) << "seed " << seed;
    const std::int64_t work = s.counts.work;
    s.minimise(0);
    ASSERT_EQ(s.counts.work, work) << "no step, no cost";
  }
}

TEST_P(SubspaceOf, ObjectiveFallsWithEveryStep) {
  for (int seed = 0; seed < 15; ++seed) {
    Random random(seed);
    Rows s(free_problem(random, GetParam()));
    const Vector start = random_vector(random, s.problem.m());
    s.start(start);
    Real before = s.objective();
    const Real end = s.a.b.dot(Vector(solve_spd(s.a.A, -s.a.b))) / 2;  // of the minimum
    for (int steps = 1; steps <= s.problem.m(); ++steps) {
      s.start(start);
      s.minimise(steps);
      const Real now = s.objective(), rounding = 1e-9L * (std::abs(before) + std::abs(end));
      ASSERT_GE(now, end - rounding) << "seed " << seed;
      if (before > end + rounding) {
        ASSERT_LT(now, before) << "seed " << seed << ", step " << steps;
      }
      before = now;
      s.expect_velocities("after some steps");
      ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
    }
  }
}

TEST_P(SubspaceOf, RowsAtTheirBoundsStayAndTheRestSettlesAroundThem) {
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    mlcp::Problem p = free_problem(random, GetParam());
    const int m = p.m();
    Vector start = random_vector(random, m);
    std::vector<int> disabled;
    std::vector<bool> free(m, true);
    for (int i = 0; i < m; ++i) {
      const int choice = random.integer(0, 5);
      if (choice > 2) continue;
      free[i] = false;
      if (choice == 0) {
        disabled.push_back(i);
        start[i] = 0;
      } else {
        set_bounds(p, i, {0.5, 2});
        start[i] = choice == 1 ? 0.5 : 2;
      }
    }
    Rows s(std::move(p), disabled);
    s.start(start);
    for (int again = 0; again < 4; ++again) s.minimise(300);
    const Vector gamma = s.gamma(), w = s.slacks();
    for (int i = 0; i < m; ++i) ASSERT_TRUE(free[i] || gamma[i] == start[i]) << "seed " << seed << ", row " << i;
    for (int i = 0; i < w.size(); ++i)
      ASSERT_TRUE(!free[s.a.row[i]] || std::abs(w[i]) <= 1e-12L * s.size()) << "seed " << seed << ", row " << s.a.row[i] << ": " << w[i];
    s.expect_velocities("around rows at rest");
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

TEST_P(SubspaceOf, ImpulsesEndWithinTheirBounds) {
  int put_back = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    mlcp::Problem p = free_problem(random, GetParam());
    const Vector start = random_vector(random, p.m());
    for (int i = 0; i < p.m(); ++i) {
      const auto at = static_cast<double>(start[i]);
      set_bounds(p, i, {at - random.uniform(0.01, 0.5), at + random.uniform(0.01, 0.5)});
    }
    Rows s(std::move(p));
    s.start(start);
    s.minimise(random.integer(1, 20));
    const Vector gamma = s.gamma();
    for (int i = 0; i < gamma.size(); ++i) {
      ASSERT_TRUE(gamma[i] >= s.problem.lo[i] && gamma[i] <= s.problem.hi[i]) << "seed " << seed << ", row " << i;
      put_back += gamma[i] == s.problem.lo[i] || gamma[i] == s.problem.hi[i];
    }
    s.expect_velocities("after impulses were put back");
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
  EXPECT_GT(put_back, 60);
}

/// D⁻¹A has two eigenvalues, however the rows are scaled: two steps, exactly.
TEST(Subspace, TwoEigenvaluesTakeTwoSteps) {
  constexpr int rows = 8;
  Random random(3);
  Eigen::MatrixXd A(rows, rows);
  Eigen::VectorXd b(rows), scale(rows);
  for (int i = 0; i < rows; ++i) {
    scale[i] = std::exp2(random.integer(-12, 12));
    b[i] = scale[i] * random.uniform();
  }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) A(i, j) = scale[i] * scale[j] * (i == j ? 1 : 0.5);
  mlcp::Problem p = reduced_problem(A, b);
  for (int i = 0; i < rows; ++i) set_bounds(p, i, {-1e30, 1e30});
  Rows s(std::move(p));
  s.start(Vector::Zero(rows));
  const auto off = [&] { return static_cast<double>(s.slacks().cwiseQuotient(scale.cast<Real>()).cwiseAbs().maxCoeff()); };
  s.minimise(1);
  EXPECT_GT(off(), 1e-3);
  s.start(Vector::Zero(rows));
  s.minimise(2);
  EXPECT_LE(off(), 1e-14);
}

/// Two rows say the same and contradict each other: there is no curvature along what tells them apart.
TEST(Subspace, NoCurvatureEndsIt) {
  mlcp::Problem p = reduced_problem(Eigen::Matrix2d::Ones(), Eigen::Vector2d(-1, 1));
  for (const int i : {0, 1}) set_bounds(p, i, wide);
  Rows s(std::move(p));
  s.start(Vector::Zero(2));
  s.minimise(10);
  EXPECT_EQ(s.gamma(), Vector(Vector::Zero(2)));
}

TEST(Subspace, NothingFreeNothingMoves) {
  Random random(1);
  mlcp::Problem p = random_chain(random, 4, 3, 1);
  Vector start(p.m());
  for (int i = 0; i < p.m(); ++i) {
    set_bounds(p, i, {-0.25, 0.75});
    start[i] = i % 2 ? -0.25 : 0.75;
  }
  Rows s(std::move(p));
  s.start(start);
  s.minimise(10);
  EXPECT_EQ(s.gamma(), start);
  s.expect_velocities("as they were");
}

}  // namespace
}  // namespace support
