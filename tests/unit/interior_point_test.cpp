// Interior points: where there is a solution they end next to one and show its active set; where there is none they say so.
#include "solve/interior_point.h"

#include <gtest/gtest.h>

#include "solver.h"
#include "stage.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

/// The only island of a problem, on its way.
struct Path {
  mlcp::Settings settings = mlcp::default_settings();
  mlcp::Stage stage{mlcp::Memory()};
  mlcp::Watch watch{settings};
  mlcp::Counts counts;
  mlcp::Limits limits{watch, 0, 1, 1000};
  mlcp::InteriorPoint points{stage.basis, limits, counts};

  explicit Path(const mlcp::Problem& p) {
    stage.analysis.run(p, nullptr, false, {}, {});
    stage.load({p, nullptr, settings}, nullptr);
  }
  const mlcp::Island& island() const { return stage.analysis.symbolic.islands[0]; }
  bool reduce(double part) { return points.start(island(), 0) && points.reduce(island(), part); }
};

/// `copies` times the same four legs under one body: the active rows have rank 3.
mlcp::Problem table(int copies, double up = 0) {
  mlcp::Problem p = empty_problem();
  add_body(p, 3, 1);
  set_k(p, Eigen::Vector3d(-8, 1, 0));
  for (int c = 0; c < copies; ++c)
    for (const auto& [x, y] : {std::pair{1., 1.}, {1., -1.}, {-1., 1.}, {-1., -1.}}) add_row(p, {{0, 1}, {1, x}, {2, y}}, up);
  return p;
}

TEST(InteriorPoint, StepsHardlyDependOnHowOftenRowsAreRepeated) {
  for (const int copies : {1, 10, 100}) {
    const mlcp::Problem p = table(copies);
    Path path(p);
    ASSERT_TRUE(path.reduce(1e-10)) << copies;
    EXPECT_LT(path.counts.pivots, 16) << copies;
    EXPECT_EQ(path.counts.factorizations, path.counts.pivots);
    const Solution exact = solve(p, settings());
    for (int o = 0; o < p.m(); ++o) EXPECT_GE(path.stage.basis.gamma(o), 0);
    for (int position = path.island().first; position < path.island().last; ++position)
      if (const int j = path.stage.analysis.pattern.node[position]; j < p.n()) {
        EXPECT_NEAR(path.stage.basis.set.x[position], exact.v[j], 1e-4) << copies;
      }
  }
}

TEST(InteriorPoint, ActiveRowsAreThoseOfTheSolution) {
  for (int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, 12, 3, 1);
    Path path(p);
    if (path.stage.analysis.symbolic.islands.size() != 1) continue;
    ASSERT_TRUE(path.reduce(1e-12)) << "seed " << seed;
    const Solution exact = solve(p, settings());
    for (int o = path.island().first_row; o < path.island().last_row; ++o) {
      const int i = path.stage.analysis.pattern.node[path.stage.basis.position(o)] - p.n();
      const bool between = exact.gamma[i] > p.lo[i] + 1e-3 && exact.gamma[i] < p.hi[i] - 1e-3;
      if (between || std::abs(exact.w[i]) > 1e-3) {
        EXPECT_EQ(path.stage.basis.set.state[o] == mlcp::ActiveSet::active, between) << "seed " << seed << " row " << i;
      }
    }
  }
}

TEST(InteriorPoint, NoSolutionIsNotReached) {
  mlcp::Problem p = table(1, 1);
  add_row(p, {{0, -1}}, 1);  // up and down at once
  Path path(p);
  EXPECT_FALSE(path.reduce(1e-10));
  EXPECT_EQ(path.points.stopped(), MLCP_SOLVED);
}

}  // namespace
}  // namespace support
