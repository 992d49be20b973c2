#include "friction/lemke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random.h"

namespace mlcp {
namespace {

struct Lcp {
  int n;
  std::vector<double> M, q;

  explicit Lcp(int size) : n(size), M(std::size_t(size) * size), q(size) {}
  /// The largest of −z, −w, z w.
  double error(const std::vector<double>& z) const {
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      double w = q[i];
      for (int j = 0; j < n; ++j) w += M[i * n + j] * z[j];
      worst = std::max({worst, -z[i], -w, std::abs(std::min(z[i], w))});
    }
    return worst;
  }
};

bool solve(const Lcp& p, std::vector<double>& z) {
  Lemke lemke{Memory()};
  z.assign(p.n, 0);
  return lemke.solve(p.n, p.M, p.q, z);
}

TEST(Lemke, positive_semidefinite_matrices_at_random) {
  support::Random random(1);
  for (int round = 0; round < 60; ++round) {
    const int n = 1 + round % 20, rank = std::max(1, n / 2);
    std::vector<double> b(std::size_t(n) * rank), z, feasible(n);
    for (double& x : b) x = random.uniform(-1, 1);
    Lcp p(n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int r = 0; r < rank; ++r) p.M[i * n + j] += b[i * rank + r] * b[j * rank + r];
    for (double& x : feasible) x = random.uniform(0, 1);
    for (int i = 0; i < n; ++i) {  // w = M z + q ≥ 0 for z = feasible
      p.q[i] = random.uniform(0, 1);
      for (int j = 0; j < n; ++j) p.q[i] -= p.M[i * n + j] * feasible[j];
    }
    ASSERT_TRUE(solve(p, z)) << "round " << round;
    EXPECT_LE(p.error(z), 1e-9) << "round " << round;
  }
}

TEST(Lemke, a_matrix_that_is_not_symmetric) {
  Lcp p(2);  // Kostreva (1979): cycles under least-index rules of other methods
  p.M = {1, 2, 0, 1};
  p.q = {-1, -1};
  std::vector<double> z;
  ASSERT_TRUE(solve(p, z));
  EXPECT_LE(p.error(z), 1e-14);
}

TEST(Lemke, no_solution_ends_on_a_ray) {
  Lcp p(1);
  p.q = {-1};
  std::vector<double> z;
  EXPECT_FALSE(solve(p, z));
}

TEST(Lemke, nothing_to_do) {
  Lcp p(3);
  p.q = {1, 0, 2};
  std::vector<double> z;
  ASSERT_TRUE(solve(p, z));
  EXPECT_EQ(z, std::vector<double>(3, 0));
}

}  // namespace
}  // namespace mlcp
