// The method by itself: what it gets wrong, full steps after it would mend unseen.
#include "solve/dense_simplex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/random_problem.h"

namespace support {
namespace {

constexpr double zero = 1e-12;
/// What the rounding of its pivots may add.
constexpr double allowed = 1e-9;

struct Tally {
  int islands = 0, solved = 0, pivoted = 0;
};

/// Every row is where its impulse and its slack belong.
void expect_solution(const mlcp::DenseIsland& s) {
  for (int i = 0; i < s.m; ++i) {
    double w = s.b[i], size = s.size[i] + std::abs(w);
    for (int j = 0; j < s.m; ++j) {
      w += s.response(i, j) * s.gamma[j];
      size += std::abs(s.response(i, j) * s.gamma[j]);
    }
    const double slack = allowed * (s.hi[i] - s.lo[i]);
    EXPECT_GE(s.gamma[i], s.lo[i] - slack) << "row " << i;
    EXPECT_LE(s.gamma[i], s.hi[i] + slack) << "row " << i;
    if (s.state[i] != mlcp::ActiveSet::active) {
      EXPECT_EQ(s.gamma[i], s.state[i] == mlcp::ActiveSet::at_lower ? s.lo[i] : s.hi[i]) << "row " << i;
    }
    if (s.response(i, i) == 0) continue;
    EXPECT_TRUE(s.state[i] == mlcp::ActiveSet::at_lower || w <= allowed * size) << "row " << i << " could push less, w = " << w;
    EXPECT_TRUE(s.state[i] == mlcp::ActiveSet::at_upper || w >= -allowed * size) << "row " << i << " could push more, w = " << w;
  }
}

void run(const mlcp::Problem& p, Random& random, Tally& tally) {
  mlcp::Components components{mlcp::Memory()};
  components.update(p, nullptr);
  mlcp::DenseResponse response{mlcp::Memory()};
  response.prepare(p, components);
  for (int c = 0; c < components.count(); ++c) {
    if (components.row_count(c) == 0 || !response.compute(p, c)) continue;
    mlcp::DenseIsland& s = response.island(c);
    for (int i = 0; i < s.m; ++i) {
      const mlcp::ActiveSet::State states[] = {mlcp::ActiveSet::at_lower, mlcp::ActiveSet::active, mlcp::ActiveSet::at_upper};
      s.state[i] = states[random.integer(0, 2)];
      s.gamma[i] = s.state[i] == mlcp::ActiveSet::at_upper ? s.hi[i] : s.lo[i];
    }
    mlcp::Counts counts;
    ++tally.islands;
    if (!mlcp::DenseSimplex(s, zero, counts).solve()) continue;
    ++tally.solved;
    tally.pivoted += counts.pivots > 0;
    expect_solution(s);
  }
}

/// From any states, bounds near what the problem asks for, rows that are the same twice.
TEST(DenseSimplex, EndsWithEveryRowWhereItBelongs) {
  Tally tally;
  for (int seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Problem p = random_problem(random, {.rows_least = 4, .rows_most = 30, .prescribed = 0, .compliance = 0, .compliance_matrix = 0, .duplicate = 0.3});
    for (std::int32_t i = 0; i < p.m(); ++i) {
      p.lo[i] = -random.uniform(0, 1);
      p.hi[i] = p.lo[i] + random.uniform(0.1, 1);
    }
    run(p, random, tally);
  }
  EXPECT_EQ(tally.solved, tally.islands);
  EXPECT_GT(tally.pivoted, 300);
}

/// No slack or scale is read before it is found: neither of rows that begin active, nor of those that leave.
TEST(DenseSimplex, ReadsNothingThatStoodInMemory) {
  mlcp::Problem p = empty_problem();
  constexpr int rows = 8;
  for (int j = 0; j <= rows; ++j) add_body(p, 1, 1);
  for (int i = 0; i < rows; ++i) add_row(p, {{i, 1}, {i + 1, -1}}, i % 3 - 1, {0, i % 2 ? 0.2 : 100});
  mlcp::Components components{mlcp::Memory()};
  components.update(p, nullptr);
  mlcp::DenseResponse response{mlcp::Memory()};
  response.prepare(p, components);
  ASSERT_TRUE(response.compute(p, 0));
  mlcp::DenseIsland& s = response.island(0);
  std::vector<double> gamma[2];
  for (const double junk : {0.0, mlcp::infinity}) {
    std::fill(s.state, s.state + s.m, mlcp::ActiveSet::active);
    std::fill(s.gamma, s.gamma + s.m, 0.0);
    for (double* const array : {s.w, s.scale}) std::fill(array, array + s.m, junk);
    mlcp::Counts counts;
    ASSERT_TRUE(mlcp::DenseSimplex(s, zero, counts).solve());
    EXPECT_GT(counts.pivots, 0);
    expect_solution(s);
    gamma[junk > 0].assign(s.gamma, s.gamma + s.m);
  }
  EXPECT_EQ(gamma[0], gamma[1]);
}

}  // namespace
}  // namespace support
