#include "solve/gauss_seidel.h"

#include <gtest/gtest.h>

#include "../../capi/handles.h"
#include "analyze/analysis.h"
#include "scenes/scenes.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

mlcp::Settings sweeps(double tolerance) {
  mlcp::Settings s = mlcp::default_settings();
  s.method = MLCP_METHOD_PGS;
  s.tolerance = tolerance;
  s.max_iterations = 20000;
  return s;
}

TEST(GaussSeidel, ReachesATenthOfAPercentOnMostChains) {
  int solved = 0;
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_chain(random, 6, 3, 1);
    const Solution s = solve(p, sweeps(1e-3));
    const DenseErrors e = errors_of(dense(p), widen(s.v), widen(s.gamma));
    ASSERT_EQ(s.report.outcome, std::max(e.momentum, e.constraints) <= 1e-3L ? MLCP_SOLVED : MLCP_ITERATION_LIMIT) << "seed " << seed;
    ASSERT_EQ(s.report.method, MLCP_METHOD_PGS);
    ASSERT_EQ(s.report.factorizations, 0);
    solved += s.report.outcome == MLCP_SOLVED;
  }
  EXPECT_GE(solved, 25);
}

TEST(GaussSeidel, OneContactTakesOneSweep) {
  mlcp::Problem p = empty_problem();
  Random random(1);
  add_body(p, random_mass(random, 6, false));
  set_k(p, -Eigen::VectorXd::Ones(6));
  add_row(p, {{0, 1}, {3, 0.5}});
  const Solution s = solve(p, sweeps(1e-12));
  EXPECT_EQ(fault(dense(p), s), "");
}

TEST(GaussSeidel, LimitIsAnHonestStatus) {
  Random random(3);
  const mlcp::Problem p = random_chain(random, 60, 3, 1);
  mlcp::Settings how = sweeps(1e-14);
  how.max_iterations = 16;
  const Solution s = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_ITERATION_LIMIT);
  EXPECT_GT(s.report.largest_error, 1e-14);
}

TEST(GaussSeidel, LargeMassPartsGoToNewton) {
  mlcp::Problem p = empty_problem();
  Random random(5);
  add_sparse_body(p, random_mass(random, 80, false));
  set_k(p, -Eigen::VectorXd::Ones(80));
  for (int j = 0; j < 10; ++j) add_row(p, {{j, 1}});
  const Solution s = solve(p, sweeps(1e-9));
  EXPECT_EQ(s.report.method, MLCP_METHOD_NEWTON);
  EXPECT_EQ(fault(dense(p), s), "");
}

TEST(GaussSeidel, ImpulsesOfTheStartMaskSaveSweeps) {
  Random random(8);
  const mlcp::Problem p = random_chain(random, 30, 3, 1);
  mlcp::Settings how = sweeps(1e-4);
  mlcp::Solver solver(how, mlcp::Memory());
  const Solution cold = solve(solver, p);
  mlcp::Mask start = mask_of(cold.state);
  start.impulse.assign(std::span<const double>(cold.gamma));
  const Solution warm = solve(p, how, nullptr, &start);
  EXPECT_EQ(warm.report.pivots, 0);
  EXPECT_GT(cold.report.pivots, 0);
}

/// A sweep over a large island takes long enough: no more of them once the time is over.
TEST(GaussSeidel, AGuessEndsWithTheTime) {
  Random random(3);
  const mlcp::Problem p = random_chain(random, 200, 3, 1);
  mlcp::Settings how = mlcp::default_settings();
  how.method = MLCP_METHOD_NEWTON;
  EXPECT_GT(solve(p, how).report.pivots, 10);
  how.max_seconds = 1e-12;
  const Solution s = solve(p, how);
  EXPECT_EQ(s.report.outcome, MLCP_TIME_LIMIT);
  EXPECT_LE(s.report.pivots, s.report.islands);
}

/// Sweeps and conjugate gradients on the islands of a problem, as a solve begins with them.
struct Guessed {
  const mlcp::Problem& problem;
  mlcp::Settings settings = mlcp::default_settings();
  mlcp::Analysis analysis{mlcp::Memory()};
  mlcp::Basis basis{mlcp::Memory()};
  mlcp::Counts counts;

  explicit Guessed(const mlcp::Problem& p, const mlcp::Mask* enabled = nullptr, const mlcp::Mask* start = nullptr) : problem(p) {
    analysis.run(problem, nullptr, false, {});
    basis.prepare(problem, analysis, settings);
    basis.set.start(problem, analysis.pattern, basis.values, enabled, start);
    mlcp::Watch watch(settings);
    const auto islands = static_cast<std::int32_t>(analysis.symbolic.islands.size());
    for (std::int32_t s = 0; s < islands; ++s) {
      const mlcp::Island& island = analysis.symbolic.islands[s];
      mlcp::Limits limits(watch, s, islands, 1 << 20);
      mlcp::GaussSeidel sweeps(basis, limits, counts);
      EXPECT_TRUE(sweeps.prepare(island));
      sweeps.guess(island, start != nullptr);
    }
  }
  mlcp::ActiveSet::State state(int row) const {
    return static_cast<mlcp::ActiveSet::State>(basis.set.state[analysis.pattern.row_ordinal[analysis.pattern.position[problem.n() + row]]]);
  }
  double gamma(int row) const { return -basis.set.x[analysis.pattern.position[problem.n() + row]]; }
  /// Rows that are active in one and not in the other.
  int wrong(const Solution& answer) const {
    int wrong = 0;
    for (int i = 0; i < problem.m(); ++i) wrong += (state(i) == mlcp::ActiveSet::active) != (answer.state[i] == MLCP_ROW_ACTIVE);
    return wrong;
  }
};

mlcp::Settings newton() {
  mlcp::Settings s = mlcp::default_settings();
  s.method = MLCP_METHOD_NEWTON;
  return s;
}

/// States, and impulses where they are asked for.
mlcp::Mask start_from(const Solution& s, bool impulses) {
  mlcp::Mask start = mask_of(s.state);
  if (impulses) start.impulse.assign(std::span<const double>(s.gamma));
  return start;
}

/// A factorization is dear there: cycles end when they move one row in 100.
TEST(GaussSeidel, AGuessOfALargePileIsWrongAboutOneRowIn100) {
  for (const unsigned seed : {1, 2}) {
    const scenes::Problem scene = scenes::pile(2000, seed);
    const mlcp::Problem& p = scene->problem;
    const Solution s = solve(p, newton());
    ASSERT_LE(s.report.largest_error, 1e-12);
    const Guessed guess(p);
    EXPECT_LE(100 * guess.wrong(s), p.m()) << "seed " << seed;
    EXPECT_LE(guess.counts.pivots, 8 + 4 + 8 * 8) << "sweeps before cycles and of eight cycles";
    EXPECT_EQ(s.report.factorizations, s.report.islands) << "what is left are toggles";
  }
}

/// A factorization is cheap there: sweeps alone, and a little more is left to do.
TEST(GaussSeidel, AGuessOfASmallPileIsWrongAboutOneRowIn20) {
  for (const unsigned seed : {1, 2}) {
    const scenes::Problem scene = scenes::pile(600, seed);
    const mlcp::Problem& p = scene->problem;
    EXPECT_LE(20 * Guessed(p).wrong(solve(p, newton())), p.m()) << "seed " << seed;
  }
}

TEST(GaussSeidel, AGuessLeavesImpulsesWhereTheStatesAre) {
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    mlcp::Problem p = random_chain(random, random.integer(3, 12), 3, 1);
    for (int i = 1; i < p.m(); i += 4) p.hi[i] = 0.1;
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.2);
    const Guessed guess(p, &enabled);
    for (int i = 0; i < p.m(); ++i) {
      const double gamma = guess.gamma(i);
      switch (guess.state(i)) {
        case mlcp::ActiveSet::at_lower: ASSERT_EQ(gamma, p.lo[i]) << "seed " << seed; break;
        case mlcp::ActiveSet::at_upper: ASSERT_EQ(gamma, p.hi[i]) << "seed " << seed; break;
        case mlcp::ActiveSet::active: ASSERT_TRUE(gamma > p.lo[i] && gamma < p.hi[i]) << "seed " << seed; break;
        default: ASSERT_EQ(gamma, 0) << "seed " << seed;
      }
      ASSERT_EQ(guess.state(i) == mlcp::ActiveSet::disabled, enabled.state[i] == MLCP_ROW_DISABLED) << "seed " << seed;
    }
    // velocities are those of the impulses
    const Dense d = dense(p, &enabled);
    Vector gamma(p.m());
    for (int i = 0; i < p.m(); ++i) gamma[i] = guess.gamma(i);
    const Vector v = velocities(d, gamma);
    for (int j = 0; j < p.n(); ++j)
      ASSERT_NEAR(guess.basis.set.x[guess.analysis.pattern.position[j]], static_cast<double>(v[j]), 1e-10) << "seed " << seed;
  }
}

/// Sweeps of rows that are hardly coupled: one that a sweep leaves out stays wrong for ever.
TEST(GaussSeidel, ASweepVisitsEveryRow) {
  for (int rows = 1; rows <= 18; ++rows) {
    Random random(rows);
    Eigen::MatrixXd A = 4 * Eigen::MatrixXd::Identity(rows, rows);
    Eigen::VectorXd b(rows);
    for (int i = 0; i < rows; ++i) {
      b[i] = random.uniform(-1, 0.2);
      if (i > 0) A(i, i - 1) = A(i - 1, i) = random.uniform();
    }
    const mlcp::Problem p = reduced_problem(A, b);
    mlcp::Settings how = sweeps(1e-13);
    how.max_iterations = 64;
    EXPECT_EQ(fault(dense(p), solve(p, how)), "") << rows;
  }
}

/// Sweeps count as pivots: none are made, and a row that stays costs nothing.
TEST(GaussSeidel, StatesOfTheStartMaskAreNotThrownAway) {
  const scenes::Problem scene = scenes::pile(2000);
  mlcp::Problem p(scene->problem, mlcp::Memory());
  const Solution cold = solve(p, newton());
  const mlcp::Mask start = start_from(cold, false);
  const Solution same = solve(p, newton(), nullptr, &start);
  EXPECT_EQ(same.report.pivots, same.report.islands);
  EXPECT_EQ(same.report.toggles, 0);
  const mlcp::Mask impulses = start_from(cold, true);
  EXPECT_LE(solve(p, newton(), nullptr, &impulses).report.pivots, 4 + 8 + same.report.islands) << "four sweeps and a cycle show that nothing is left to do";
  Random random(5);
  for (double& k : p.momentum) k *= 1 + 0.3 * random.uniform();
  const Solution nearby = solve(p, newton(), nullptr, &start);
  EXPECT_LE(nearby.report.largest_error, 1e-12);
  EXPECT_LT(nearby.report.pivots, 8);
}

TEST(GaussSeidel, ImpulsesOfTheStartMaskSaveChanges) {
  for (const unsigned seed : {1, 2}) {
    const scenes::Problem scene = scenes::pile(2000, seed);
    mlcp::Problem p(scene->problem, mlcp::Memory());
    const Solution before = solve(p, newton());
    const mlcp::Mask states = start_from(before, false), impulses = start_from(before, true);
    Random random(5);
    for (double& k : p.momentum) k *= 1 + 0.3 * random.uniform();
    const Solution cold = solve(p, newton()), stated = solve(p, newton(), nullptr, &states), warm = solve(p, newton(), nullptr, &impulses);
    for (const Solution* s : {&cold, &stated, &warm}) EXPECT_LE(s->report.largest_error, 1e-12) << "seed " << seed;
    EXPECT_LE(difference(warm.v, cold.v), 1e-10) << "seed " << seed;
    EXPECT_LE(10 * warm.report.toggles, stated.report.toggles) << "seed " << seed;
    EXPECT_EQ(warm.report.factorizations, warm.report.islands) << "seed " << seed;
    EXPECT_LT(warm.report.pivots, cold.report.pivots) << "seed " << seed;
  }
}

/// Where a factorization is cheap, full steps from the last active set are cheaper than sweeps.
TEST(GaussSeidel, SmallPilesGoOnWithoutSweeps) {
  const scenes::Problem scene = scenes::pile(600);
  const mlcp::Problem& p = scene->problem;
  const Solution cold = solve(p, newton());
  const mlcp::Mask impulses = start_from(cold, true);
  EXPECT_EQ(solve(p, newton(), nullptr, &impulses).report.pivots, cold.report.islands);
}

/// Cycles would go on: loads that can be shared in many ways move for ever.
TEST(GaussSeidel, AGuessOfDependentRowsEndsEarly) {
  const scenes::Problem scene = scenes::wall(10, 10);
  const Guessed guess(scene->problem);
  EXPECT_EQ(guess.analysis.symbolic.islands.size(), 1u);
  EXPECT_LE(guess.counts.pivots, 8 + 4);
}

/// Where rows are coupled by Σ alone, and by little of it.
TEST(GaussSeidel, SparseReducedProblemsAreGuessed) {
  constexpr int rows = 300;
  Random random(2);
  Eigen::MatrixXd A = 2.2 * Eigen::MatrixXd::Identity(rows, rows);
  Eigen::VectorXd b(rows);
  for (int i = 0; i < rows; ++i) {
    b[i] = random.uniform();
    if (i > 0) A(i, i - 1) = A(i - 1, i) = -1;
  }
  const mlcp::Problem p = reduced_problem(A, b);
  const Solution s = solve(p, newton());
  EXPECT_EQ(fault(dense(p), s), "");
  EXPECT_GE(s.report.pivots, 12) << "sweeps";
  EXPECT_LE(s.report.toggles, 10);
}

}  // namespace
}  // namespace support
