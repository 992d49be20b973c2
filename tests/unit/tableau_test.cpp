#include "factorize/tableau.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

mlcp::Problem some_problem(Random& random) {
  return random_problem(random, {.bodies_least = 2, .rows_least = 2, .prescribed = 0, .compliance = 0.5, .disabled = 0});
}

/// K of one island, and its tableau.
struct Swept {
  Matrix K;
  mlcp::Tableau Q{mlcp::Memory()};
  Swept(const Stage& stage, const mlcp::Island& island)
      : K(stage.loaded().block(island.first, island.first, island.last - island.first, island.last - island.first)) {
    Q.load(island, stage.pattern(), stage.values);
  }
  double entry(int p, int q) const { return static_cast<double>(Q(p, q)); }
};

/// The definition, by dense inverses.
Matrix swept(const Matrix& K, const std::vector<int>& in, const std::vector<int>& out) {
  const Matrix inverse = Matrix(K(in, in)).inverse();
  Matrix Q = Matrix::Zero(K.rows(), K.cols());
  Q(in, in) = -inverse;
  Q(out, in) = K(out, in) * inverse;
  Q(in, out) = Q(out, in).transpose();
  Q(out, out) = K(out, out) - K(out, in) * inverse * K(in, out);
  return Q;
}

TEST(Tableau, IsInverseAndSchurComplementOfWhatIsIn) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Stage stage(some_problem(random));
    for (const mlcp::Island& island : stage.islands()) {
      Swept now(stage, island);
      std::vector<int> in, out;
      for (int p = 0; p < now.Q.size(); ++p) (stage.pattern().is_row(island.first + p) ? out : in).push_back(p);
      for (const int p : in) now.Q.sweep(p);
      const Matrix expected = swept(now.K, in, out);
      for (int p = 0; p < now.Q.size(); ++p)
        for (int q = 0; q < now.Q.size(); ++q)
          ASSERT_NEAR(now.entry(p, q), static_cast<double>(expected(p, q)), 1e-12 * (1 + static_cast<double>(expected.norm()))) << "seed " << seed;
    }
  }
}

TEST(Tableau, SweepingTwiceGivesBackK) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Stage stage(some_problem(random));
    for (const mlcp::Island& island : stage.islands()) {
      Swept now(stage, island);
      std::vector<int> swept;
      for (int p = 0; p < now.Q.size(); ++p) {
        if (stage.pattern().is_row(island.first + p)) continue;
        now.Q.sweep(p);
        EXPECT_TRUE(now.Q.in(p));
        swept.push_back(p);
      }
      for (const int p : swept) now.Q.sweep(p);
      for (int p = 0; p < now.Q.size(); ++p) {
        EXPECT_FALSE(now.Q.in(p));
        // every digit of a double: the rest is rounding of 113 bits
        for (int q = 0; q < now.Q.size(); ++q)
          ASSERT_NEAR(now.entry(p, q), static_cast<double>(now.K(p, q)), 1e-25 * static_cast<double>(now.K.norm())) << "seed " << seed;
      }
    }
  }
}

TEST(Tableau, MultipliesByTheWholeMatrix) {
  Random random(1);
  const Stage stage(some_problem(random));
  Swept now(stage, stage.islands()[0]);
  std::vector<mlcp::Extended> x(now.Q.size()), y(now.Q.size());
  for (int p = 0; p < now.Q.size(); ++p) x[p] = p - 1;
  now.Q.multiply(x.data(), y.data());
  for (int p = 0; p < now.Q.size(); ++p) {
    double sum = 0;
    for (int q = 0; q < now.Q.size(); ++q) sum += static_cast<double>(now.K(p, q)) * (q - 1);
    EXPECT_NEAR(static_cast<double>(y[p]), sum, 1e-12 * (1 + std::abs(sum)));
  }
}

}  // namespace
}  // namespace support
