#include "factorize/refinement.h"

#include <gtest/gtest.h>

#include "assemble/values.h"
#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

struct Refined {
  Stage stage;
  mlcp::Refinement refinement{mlcp::Memory()};
  std::vector<double> x;
  std::int64_t steps = 0;
  double error = 0;

  explicit Refined(const mlcp::Problem& problem) : stage(problem), x(stage.pattern().size(), 0.0) {
    refinement.prepare(stage.pattern().size());
  }
  void all_in() { ASSERT_EQ(stage.factorize(std::vector<std::uint8_t>(x.size(), 1), 1e-9), mlcp::FactorStatus::ok); }
  void solve() {
    error = 0;
    for (const mlcp::Island& island : stage.islands())
      error = std::max(error, refinement.solve(island, stage.pattern(), stage.values, stage.factor, stage.values.b.data(),
                                               stage.values.size.data(), x.data(), steps, stage.work));
  }
  /// maxᵢ |b − K x|ᵢ / (|K||x| + size)ᵢ over what is in
  double measured() const {
    const Matrix K = stage.loaded();
    Real worst = 0;
    for (int p = 0; p < K.rows(); ++p) {
      if (!stage.factor.in(p)) continue;
      Real residual = stage.values.b[p], size = stage.values.size[p];
      for (int q = 0; q < K.cols(); ++q) {
        residual -= K(p, q) * x[q];
        size += std::abs(K(p, q) * x[q]);
      }
      worst = std::max(worst, size > 0 ? std::abs(residual) / size : std::abs(residual));
    }
    return static_cast<double>(worst);
  }
};

TEST(Refinement, FreshFactorReachesRounding) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Refined r(random_chain(random, random.integer(1, 20), 3, 1));
    r.all_in();
    r.solve();
    ASSERT_LE(r.error, 1e-15) << "seed " << seed;
    ASSERT_NEAR(r.error, r.measured(), 1e-16) << "seed " << seed;
  }
}

TEST(Refinement, StaleFactorIsMadeGood) {
  for (int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    mlcp::Problem p = random_chain(random, 10, 3, 1);
    Refined r(p);
    r.all_in();
    for (double& mass : p.mass.values) mass *= 1 + 1e-6;
    r.stage.values.load(p, r.stage.pattern());
    r.solve();
    ASSERT_LE(r.measured(), 1e-14) << "seed " << seed;
    ASSERT_GT(r.steps, 0);
  }
}

TEST(Refinement, WhatIsOutKeepsItsValue) {
  Random random(1);
  const mlcp::Problem p = random_chain(random, 5, 2, 1);
  Refined r(p);
  std::vector<std::uint8_t> wanted(r.x.size(), 1);
  const int out = r.stage.pattern().row_position[3];
  wanted[out] = 0;
  ASSERT_EQ(r.stage.factorize(wanted), mlcp::FactorStatus::ok);
  r.x[out] = -0.75;  // γ = 0.75 at a bound
  r.solve();
  EXPECT_EQ(r.x[out], -0.75);
  EXPECT_LE(r.measured(), 1e-15) << "the others balance it";
}

TEST(Refinement, ZeroRightHandSideGivesZero) {
  mlcp::Problem p = empty_problem();
  add_body(p, 2, 3);
  add_row(p, {{0, 1}, {1, 1}});
  Refined r(p);
  r.all_in();
  r.solve();
  EXPECT_EQ(r.error, 0);
  EXPECT_EQ(r.x, std::vector<double>(3, 0.0));
}

TEST(Refinement, MassRatioOfATrillion) {
  mlcp::Problem p = empty_problem();
  const int links = 30;
  for (int b = 0; b < links; ++b) add_body(p, 1, b + 1 == links ? 1e12 : 1);
  Eigen::VectorXd k = Eigen::VectorXd::Constant(links, -9.81);
  k[links - 1] *= 1e12;
  set_k(p, k);
  for (int b = 0; b < links; ++b) {
    if (b == 0) add_row(p, {{0, 1}}, 0, bilateral);
    else add_row(p, {{b, 1}, {b - 1, -1}}, 0.01 * b, bilateral);
  }
  Refined r(p);
  r.all_in();
  r.solve();
  EXPECT_LE(r.measured(), 1e-15);
}

}  // namespace
}  // namespace support
