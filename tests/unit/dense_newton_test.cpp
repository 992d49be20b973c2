// Where it says that it is done, every row is where its impulse and its slack belong: what a wrong flip leaves, the sparse way would mend unseen.
#include "solve/dense_newton.h"

#include <gtest/gtest.h>

#include "support/build.h"
#include "support/dense.h"
#include "support/random_problem.h"

namespace support {
namespace {

constexpr double zero = 1e-9;

struct Tally {
  int done = 0, rows_at_upper = 0;
};

/// Runs every island of the problem from the mask (NULL: from a guess).
void run(const mlcp::Problem& p, const mlcp::Mask* start, bool pivots, Tally& tally) {
  mlcp::Components components{mlcp::Memory()};
  components.update(p, nullptr);
  mlcp::DenseResponse response{mlcp::Memory()};
  response.prepare(p, components);
  const Reduced reduced = reduce(dense(p));
  for (int c = 0; c < components.count(); ++c) {
    if (!response.compute(p, c)) continue;
    mlcp::DenseIsland s = response.island(c);
    mlcp::Counts counts;
    if (!mlcp::DenseNewton(s, zero, pivots, counts).solve(p, start)) continue;
    ++tally.done;
    for (int i = 0; i < s.m; ++i) {
      Real w = reduced.b[s.row[i]], size = reduced.size[s.row[i]] + std::abs(w);
      for (int j = 0; j < s.m; ++j) {
        const Real term = reduced.A(s.row[i], s.row[j]) * s.gamma[j];
        w += term;
        size += std::abs(term);
      }
      EXPECT_GE(s.gamma[i], s.lo[i]);
      EXPECT_LE(s.gamma[i], s.hi[i]);
      if (s.response(i, i) == 0) continue;  // what no impulse can change is for the measurement to judge
      EXPECT_TRUE(s.gamma[i] == s.lo[i] || w <= 2 * zero * size) << "row " << i << " could push less";
      EXPECT_TRUE(s.gamma[i] == s.hi[i] || w >= -2 * zero * size) << "row " << i << " could push more";
      tally.rows_at_upper += s.state[i] == mlcp::ActiveSet::at_upper;
    }
  }
}

/// Every row has finite bounds, near what the problem asks for.
mlcp::Problem boxes(Random& random) {
  mlcp::Problem p = random_problem(random, {.rows_least = 3, .rows_most = 8, .prescribed = 0, .duplicate = 0});
  for (std::int32_t i = 0; i < p.m(); ++i) {
    p.lo[i] = -random.uniform();
    p.hi[i] = p.lo[i] + random.uniform(0.1, 1);
  }
  return p;
}

TEST(DenseNewton, EndsWithEveryRowWhereItBelongs) {
  Tally tally;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const mlcp::Problem p = boxes(random);
    const mlcp::Mask start = random_mask(random, p.m());
    run(p, nullptr, false, tally);
    run(p, &start, false, tally);
  }
  EXPECT_GT(tally.done, 500);
  EXPECT_GT(tally.rows_at_upper, 300);
}

/// More rows than velocities, many of them twice: full steps alone run in circles on most of these.
TEST(DenseNewton, PivotsWhereRowsDependOnEachOther) {
  Tally stepping, pivoting;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Problem p = random_problem(random, {.rows_least = 10, .rows_most = 30, .prescribed = 0, .duplicate = 0.3});
    for (std::int32_t i = 0; i < p.m(); ++i) {
      p.lo[i] = -random.uniform();
      p.hi[i] = p.lo[i] + random.uniform(0.1, 1);
    }
    const mlcp::Mask start = random_mask(random, p.m());
    run(p, &start, false, stepping);
    run(p, &start, true, pivoting);
  }
  EXPECT_GT(pivoting.done, 295);
  EXPECT_LT(stepping.done, pivoting.done - 50);
}

/// A that is not quite positive semidefinite, as measured ones are: the row is taken in for what its pivot is, and its impulse found.
TEST(DenseNewton, FactorsWhatIsNotQuiteSemidefinite) {
  Eigen::MatrixXd A(2, 2);
  A << 1, 1, 1, 1 - 1e-6;
  const mlcp::Problem p = reduced_problem(A, -A * Eigen::Vector2d(1, 1));
  Tally tally;
  mlcp::Mask both{mlcp::Memory()};
  both.state.assign(2, MLCP_ROW_ACTIVE);
  run(p, &both, false, tally);
  EXPECT_EQ(tally.done, 1);
}

}  // namespace
}  // namespace support
