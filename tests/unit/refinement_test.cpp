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

/// Of any point, rows in and out at random: by islands in their order, crowded ones with rows before velocities.
TEST(Refinement, MeasuresWhatTheDenseMatrixSays) {
  Shape shape;
  shape.bodies_most = 6;
  shape.rows_most = 14;
  int crowded = 0;
  for (int seed = 0; seed < 150; ++seed) {
    Random random(seed);
    const mlcp::Problem p = seed % 3 ? random_problem(random, shape) : random_chain(random, random.integer(3, 8), random.integer(1, 3), random.integer(4, 8));
    mlcp::Analysis analysis{mlcp::Memory()};
    analysis.run(p, nullptr, false, {});
    crowded += analysis.crowding.any();
    mlcp::KktValues values{mlcp::Memory()};
    values.load(p, analysis.pattern);
    mlcp::Factor factor{mlcp::Memory()};
    factor.prepare(analysis.pattern, analysis.symbolic, values);
    mlcp::Refinement refinement{mlcp::Memory()};
    const int size = analysis.pattern.size();
    refinement.prepare(size);
    const Matrix all = kkt_matrix(dense(p));
    Matrix K(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) K(i, j) = all(analysis.pattern.node[i], analysis.pattern.node[j]);
    std::vector<std::uint8_t> wanted(size);
    std::vector<double> x(size);
    for (int i = 0; i < size; ++i) {
      wanted[i] = random.chance(0.7);
      x[i] = random.chance(0.2) ? 0 : random.uniform();
    }
    std::int64_t work = 0;
    for (const mlcp::Island& island : analysis.symbolic.islands) {
      values.regularise(analysis.pattern, island, 1e-4, 0);
      ASSERT_EQ(factor.factorize(island, wanted.data(), 0, work), mlcp::FactorStatus::ok) << "seed " << seed;
      const double error = refinement.error(island, analysis.pattern, values, factor, values.b.data(), values.size.data(), x.data(), work);
      Real worst = 0;
      for (int i = island.first; i < island.last; ++i) {
        Real residual = values.b[i], terms = values.size[i];
        for (int j = 0; j < size; ++j) {
          residual -= K(i, j) * x[j];
          terms += std::abs(K(i, j) * x[j]);
        }
        if (analysis.pattern.is_row(i) && !factor.in(i)) continue;  // nobody asks
        ASSERT_NEAR(refinement.scale(i), static_cast<double>(terms), 1e-14 * static_cast<double>(terms)) << "seed " << seed << ", position " << i;
        if (factor.in(i)) worst = std::max(worst, terms > 0 ? std::abs(residual) / terms : std::abs(residual));
      }
      ASSERT_NEAR(error, static_cast<double>(worst), 1e-13) << "seed " << seed;
    }
  }
  EXPECT_GT(crowded, 20);
}

/// Bodies that ties hold at rest, with a load on the last one alone: the velocities of the others come out as rounding of the impulses that pass
/// through them, which none of their own terms forgives.
TEST(Refinement, VelocitiesThatAreLostBelowTheImpulsesStop) {
  for (const int bodies : {2, 3, 10, 30})
    for (const double load : {1e-3, 1.0, 1e6}) {
      mlcp::Problem p = empty_problem();
      for (int b = 0; b < bodies; ++b) add_body(p, 3, 0.3 + b);
      Eigen::VectorXd k = Eigen::VectorXd::Zero(3 * bodies);
      const int loaded = 3 * bodies - 2;
      k[loaded] = -9.81 * load;
      set_k(p, k);
      for (int j = 0; j < 3; ++j) add_row(p, {{j, 1}, {(j + 1) % 3, 0.1}}, 0, bilateral);
      for (int b = 1; b < bodies; ++b)
        for (int j = 0; j < 3; ++j) add_row(p, {{3 * b + j, 1}, {3 * (b - 1) + j, -1}, {3 * b + (j + 1) % 3, 0.37}}, 0, bilateral);
      Refined r(p);
      r.all_in();
      r.solve();
      EXPECT_LE(r.measured(), 1e-15) << bodies << ", " << load;
      for (int j = 0; j < p.n(); ++j) EXPECT_TRUE(j == loaded || r.x[r.stage.pattern().position[j]] == 0) << bodies << ", " << load << ", velocity " << j;
      EXPECT_LE(r.steps, 2) << "steps along the rows alone gain nothing more";
    }
}

}  // namespace
}  // namespace support
