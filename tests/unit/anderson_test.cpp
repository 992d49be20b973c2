#include "friction/anderson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mlcp {
namespace {

/// Steps until |G(x) − x| ≤ 1e-12, G(x) = A x + b by components of a rotation-like map with spectral radius `radius`.
int steps_to_converge(Anderson& anderson, double radius) {
  double x[2] = {1, -2};
  for (int step = 0; step < 100; ++step) {
    const double g[2] = {radius * x[1] + 1, -radius * x[0] + 2}, f[2] = {g[0] - x[0], g[1] - x[1]};
    if (std::hypot(f[0], f[1]) <= 1e-12) return step;
    anderson.step(0, x, f);
  }
  return 100;
}

TEST(Anderson, a_linear_map_is_solved_in_as_many_steps_as_variables) {
  const std::int32_t bounds[] = {0, 2};
  for (const double radius : {0.9, 1.0, 3.0}) {  // the plain iteration crawls, turns for ever, explodes
    Anderson anderson{Memory()};
    anderson.start(bounds);
    EXPECT_LE(steps_to_converge(anderson, radius), 8) << radius;
  }
}

TEST(Anderson, groups_do_not_mix) {
  const std::int32_t both[] = {0, 1, 3}, alone[] = {0, 1};
  Anderson two{Memory()}, one{Memory()};
  two.start(both);
  one.start(alone);
  double x[3] = {4, 5, 6}, y[1] = {4};
  for (int step = 0; step < 5; ++step) {
    const double f[3] = {std::cos(x[0]) - x[0], 1e6 * x[1], -x[2]}, g[1] = {std::cos(y[0]) - y[0]};
    two.step(0, x, f);
    two.step(1, x + 1, f + 1);
    one.step(0, y, g);
    EXPECT_EQ(x[0], y[0]);
  }
}

TEST(Anderson, goes_back_to_the_best_point_when_the_residual_explodes) {
  const std::int32_t bounds[] = {0, 1};
  Anderson anderson{Memory()};
  anderson.start(bounds);
  double x = 0;
  const double small = 1e-3, large = 1;
  anderson.step(0, &x, &small);
  EXPECT_EQ(x, 1e-3);
  x = 0.7;
  anderson.step(0, &x, &large);
  EXPECT_EQ(x, 0.5e-3);  // best point 0 and half its residual
}

TEST(Anderson, no_variables) {
  Anderson anderson{Memory()};
  anderson.start({});
  const std::int32_t bounds[] = {0};
  anderson.start(bounds);
}

}  // namespace
}  // namespace mlcp
