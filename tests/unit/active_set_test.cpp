#include "solve/active_set.h"

#include <gtest/gtest.h>

#include "support/random_problem.h"
#include "support/stage.h"

namespace support {
namespace {

using Set = mlcp::ActiveSet;

/// State of one row with these bounds, from this mask.
Set::State started(Bounds bounds, int asked = -1, bool enabled = true) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 0, bounds);
  const Stage stage(p);
  Set set{mlcp::Memory()};
  set.prepare(stage.pattern());
  const mlcp::Mask mask = mask_of({static_cast<mlcp_row_state>(asked < 0 ? 0 : asked)});
  const mlcp::Mask on = mask_of({static_cast<mlcp_row_state>(enabled ? MLCP_ROW_AT_LOWER : MLCP_ROW_DISABLED)});
  set.start(p, stage.pattern(), stage.values, &on, asked < 0 ? nullptr : &mask);
  const auto state = static_cast<Set::State>(set.state[0]);
  const int q = stage.pattern().row_position[0];
  EXPECT_EQ(set.x[q], state == Set::at_lower ? -bounds.lo : state == Set::at_upper ? -bounds.hi : 0.0);
  return state;
}

TEST(ActiveSet, ColdStartTakesRowsThatPushBothWays) {
  EXPECT_EQ(started(unilateral), Set::at_lower);
  EXPECT_EQ(started(bilateral), Set::active);
  EXPECT_EQ(started({-1, 1}), Set::active);
  EXPECT_EQ(started({1, 2}), Set::at_lower);
  EXPECT_EQ(started({-mlcp::infinity, 0}), Set::at_upper);
  EXPECT_EQ(started({0, 0}), Set::at_lower);
}

TEST(ActiveSet, MaskDecidesWhereItCan) {
  EXPECT_EQ(started(unilateral, MLCP_ROW_ACTIVE), Set::active);
  EXPECT_EQ(started({-1, 1}, MLCP_ROW_AT_UPPER), Set::at_upper);
  EXPECT_EQ(started({-1, 1}, MLCP_ROW_AT_LOWER), Set::at_lower);
  EXPECT_EQ(started(unilateral, MLCP_ROW_AT_UPPER), Set::at_lower) << "there is no upper bound";
  EXPECT_EQ(started({-mlcp::infinity, 2}, MLCP_ROW_AT_LOWER), Set::at_upper) << "there is no lower bound";
  EXPECT_EQ(started(bilateral, MLCP_ROW_AT_LOWER), Set::active) << "there is no bound";
  EXPECT_EQ(started({3, 3}, MLCP_ROW_ACTIVE), Set::at_lower) << "lo = hi";
  EXPECT_EQ(started(unilateral, MLCP_ROW_DISABLED), Set::at_lower) << "a start does not disable";
}

TEST(ActiveSet, DisabledIsDisabledWhateverTheStartSays) {
  EXPECT_EQ(started(unilateral, MLCP_ROW_ACTIVE, false), Set::disabled);
  EXPECT_EQ(started(bilateral, -1, false), Set::disabled);
}

/// w = K(rows,:) x − b and its scale, against the dense problem.
TEST(ActiveSet, SlacksAndTheirTolerance) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.prescribed = 0.3});
    const Stage stage(p);
    const Dense d = dense(p);
    mlcp::ActiveSet set{mlcp::Memory()};
    set.prepare(stage.pattern());
    mlcp::Array<double>& x = set.x;
    std::vector<double> w(p.m());
    Vector v = d.given, gamma(p.m());
    for (double& entry : x) entry = random.uniform();
    for (int j = 0; j < p.n(); ++j)
      if (d.dynamic[j] && stage.pattern().position[j] >= 0) v[j] = x[stage.pattern().position[j]];
    for (int i = 0; i < p.m(); ++i) gamma[i] = -x[stage.pattern().position[p.n() + i]];
    for (const mlcp::Island& island : stage.islands()) {
      mlcp::slacks(island, stage.pattern(), stage.values, x.data(), w.data());
      mlcp::slack_tolerances(island, stage.pattern(), stage.values, 1e-3, set);
    }
    const Vector wanted = d.J * v + d.S * gamma - d.r;
    for (int i = 0; i < p.m(); ++i) {
      const int o = stage.pattern().row_ordinal[stage.pattern().position[p.n() + i]];
      ASSERT_NEAR(w[o], static_cast<double>(wanted[i]), 1e-13) << "seed " << seed;
      ASSERT_GE(set.tolerance[o], 1e-3 * std::abs(w[o]) * (1 - 1e-12)) << "seed " << seed;
      ASSERT_EQ(set.tolerance[o] == mlcp::infinity, p.lo[i] == p.hi[i]) << "equal bounds never enter, seed " << seed;
    }
  }
}

TEST(ActiveSet, DeferredRowNeverEnters) {
  mlcp::Problem p = empty_problem();
  add_body(p, 1, 1);
  add_row(p, {{0, 1}}, 1);
  const Stage stage(p);
  Set set{mlcp::Memory()};
  set.prepare(stage.pattern());
  set.defer(0);
  EXPECT_EQ(set.tolerance[0], mlcp::infinity);
  mlcp::slack_tolerances(stage.islands()[0], stage.pattern(), stage.values, 1e-3, set);
  EXPECT_EQ(set.tolerance[0], mlcp::infinity);
}

}  // namespace
}  // namespace support
