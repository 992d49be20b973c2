// Where it says that it is done, every row is where its impulse and its slack belong; where there is no solution it says that it is not.
#include "solve/dense_interior_point.h"

#include <gtest/gtest.h>

#include "support/build.h"
#include "support/dense.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

/// The only island of a problem, on its way.
struct Way {
  const mlcp::Problem& problem;
  mlcp::Components components{mlcp::Memory()};
  mlcp::NormalEquations equations{mlcp::Memory()};
  mlcp::Settings settings = mlcp::default_settings();
  mlcp::Watch watch{settings};
  mlcp::Counts counts;

  explicit Way(const mlcp::Problem& p) : problem(p) {
    components.update(p, nullptr);
    const std::uint8_t taken[] = {1};
    equations.prepare(p, components, taken);
  }
  mlcp::NormalIsland& island() { return equations.island(0); }
  bool solve(const mlcp::Mask* start = nullptr) {
    return equations.load(problem, 0) && mlcp::DenseInteriorPoint(island(), 1e-13, watch, counts).solve(problem, start);
  }
  /// As the caller has them.
  Vector velocities() {
    Vector v = Vector::Zero(problem.n());
    for (int p = 0; p < island().n; ++p) v[island().velocity(p)] = island().v[p];
    return v;
  }
  Vector impulses() {
    Vector gamma = Vector::Zero(problem.m());
    for (int i = 0; i < island().m; ++i) gamma[island().row[i]] = island().gamma[i];
    return gamma;
  }
};

/// What is at least wrong with what it leaves.
Real error(Way& way) {
  const DenseErrors e = errors_of(dense(way.problem), way.velocities(), way.impulses());
  return std::max(e.momentum, e.constraints);
}

/// A heap: bodies in a line, and many rows that each push one or two of them, some of them twice, some with two bounds or none.
mlcp::Problem heap(Random& random, int rows, bool feasible = true) {
  const int bodies = random.integer(2, 5), dimension = 3;
  mlcp::Problem p = random_chain(random, bodies, dimension, 0);
  Eigen::VectorXd goal(p.n());
  for (double& v : goal) v = random.uniform();
  for (int i = 0; i < p.m(); ++i) p.r[i] = -10;
  std::vector<Entry> last;
  for (int i = 0; i < rows; ++i) {
    std::vector<Entry> entries;
    const int b = i < bodies - 1 ? i : random.integer(0, bodies - 1), other = i < bodies - 1 ? i + 1 : random.integer(0, bodies - 1);
    for (int j = 0; j < dimension; ++j) {
      entries.push_back({b * dimension + j, random.uniform()});
      if (other != b) entries.push_back({other * dimension + j, random.uniform()});
    }
    if (i > 0 && random.chance(0.2)) entries = last;
    last = entries;
    double r = feasible ? 0 : random.uniform();
    for (const Entry& e : entries) r += feasible ? e.value * goal[e.column] : 0;
    const int kind = random.integer(0, 9);
    if (kind == 0)
      add_row(p, entries, r, {-1, 2}, random.chance(0.5) ? 0.1 : 0);
    else if (kind == 1)
      add_row(p, entries, r, {-mlcp::infinity, 0.5});
    else if (kind == 2)
      add_row(p, entries, r, {0.25, 0.25});
    else
      add_row(p, entries, kind == 3 ? r : r - random.uniform(0, 0.2), unilateral);
  }
  return p;
}

TEST(DenseInteriorPoint, EndsWithEveryRowWhereItBelongs) {
  int done = 0, resting = 0, active = 0, beyond = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const mlcp::Problem p = heap(random, random.integer(20, 90));
    Way way(p);
    ASSERT_EQ(way.components.count(), 1);
    if (!way.solve()) continue;
    ++done;
    EXPECT_LT(error(way), 1e-10);
    const mlcp::NormalIsland& s = way.island();
    for (int i = 0; i < s.m; ++i) {
      EXPECT_GE(s.gamma[i], s.lo[i]);
      EXPECT_LE(s.gamma[i], s.hi[i]);
      (s.state[i] == mlcp::ActiveSet::active ? active : resting) += 1;
      beyond += s.state[i] == mlcp::ActiveSet::at_upper;
    }
  }
  EXPECT_GT(done, 295);
  EXPECT_GT(active, 1000);
  EXPECT_GT(resting, 1000);
  EXPECT_GT(beyond, 300);
}

TEST(DenseInteriorPoint, StepsHardlyDependOnHowOftenRowsAreRepeated) {
  for (const int copies : {2, 20, 200}) {
    mlcp::Problem p = empty_problem();
    add_body(p, 3, 1);
    set_k(p, Eigen::Vector3d(-8, 1, 0));
    for (int c = 0; c < copies; ++c)
      for (const auto& [x, y] : {std::pair{1., 1.}, {1., -1.}, {-1., 1.}, {-1., -1.}}) add_row(p, {{0, 1}, {1, x}, {2, y}});
    Way way(p);
    ASSERT_TRUE(way.solve()) << copies;
    EXPECT_LT(way.counts.pivots, 16) << copies;
    EXPECT_LT(error(way), 1e-13) << copies;
    for (int i = 0; i < p.m(); ++i) {  // equal rows have equal shares
      EXPECT_NEAR(way.island().gamma[i], way.island().gamma[i % 4], 1e-9);
    }
  }
}

/// How many of 50 heaps need no step from the solution that they had before their momenta changed by that part.
int without_steps(double change) {
  int count = 0;
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Problem p = heap(random, 60);
    Way way(p);
    EXPECT_TRUE(way.solve());
    mlcp::Mask start{mlcp::Memory()};
    start.state.resize(p.m());
    start.impulse.resize(p.m());
    for (int i = 0; i < way.island().m; ++i) {
      start.state[way.island().row[i]] = mlcp::row_state(way.island().state[i]);
      start.impulse[way.island().row[i]] = way.island().gamma[i];
    }
    for (double& k : p.momentum) k *= 1 + change * random.uniform();
    Way again(p);
    EXPECT_TRUE(again.solve(&start));
    EXPECT_LT(error(again), 1e-10);
    count += again.counts.pivots == 0;
  }
  return count;
}

TEST(DenseInteriorPoint, FromTheSolutionOfAProblemNearbyItTakesNoSteps) {
  EXPECT_EQ(without_steps(0), 50);
  EXPECT_GT(without_steps(1e-9), 45);
}

/// Rows change sides there, some to rest and some not.
TEST(DenseInteriorPoint, FewRowsThatChangeSidesTakeNoStepsEither) {
  EXPECT_GT(without_steps(0.3), 35);
}

TEST(DenseInteriorPoint, StopsWhenItIsToldTo) {
  Random random(1);
  const mlcp::Problem p = heap(random, 60);
  Way way(p);
  way.settings.max_seconds = 1e-9;
  EXPECT_FALSE(way.solve());
  EXPECT_EQ(way.counts.pivots, 0);
  EXPECT_EQ(way.watch.stopped(), MLCP_TIME_LIMIT);
}

TEST(DenseInteriorPoint, SaysWhereThereIsNoSolution) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Problem p = heap(random, 40, false);
    add_row(p, {{0, 1}}, 1);
    add_row(p, {{0, -1}}, 1);  // against the one before
    Way way(p);
    EXPECT_FALSE(way.solve());
  }
}

/// Rows that say the same with other rounding, as those of a box that lies on a box do: none of them has to be found out as the one that gives way.
TEST(DenseInteriorPoint, RowsMayContradictEachOtherByARounding) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Problem p = heap(random, 40);
    const int rows = p.m();
    for (int i = 0; i < rows; ++i)
      if (p.lo[i] == 0) {
        std::vector<Entry> entries;
        for (int t = p.jacobian.pointers[i]; t < p.jacobian.pointers[i + 1]; ++t) entries.push_back({p.jacobian.indices[t], p.jacobian.values[t]});
        add_row(p, entries, p.r[i] + 1e-12 * random.uniform());
      }
    Way way(p);
    ASSERT_TRUE(way.solve());
    EXPECT_LT(error(way), 1e-10);
  }
}

}  // namespace
}  // namespace support
