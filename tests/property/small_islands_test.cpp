// Problems of small islands alone, which auto solves without a sparse factor: the same answers as the simplex.
#include <gtest/gtest.h>

#include "dense_stage.h"
#include "scenes/handles.h"
#include "scenes/scenes.h"
#include "support/build.h"
#include "support/random_problem.h"
#include "support/solution.h"

namespace support {
namespace {

TEST(SmallIslands, HaveTheVelocitiesOfTheSimplex) {
  int without_factor = 0, solved = 0;
  for (int seed = 0; seed < rounds(3000); ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_most = 5, .rows_most = 10, .integers = seed % 3 == 0, .feasible = 0.95});
    const mlcp::Mask enabled = enabled_mask(random, p.m(), 0.1);
    const Dense d = dense(p, &enabled);
    const Solution expected = solve(p, settings(), &enabled);
    mlcp::Solver solver(automatic(), mlcp::Memory());
    const Solution s = solve(solver, p, &enabled);
    ASSERT_EQ(s.report.outcome, expected.report.outcome) << "seed " << seed;
    if (s.report.outcome != MLCP_SOLVED) continue;
    ASSERT_EQ(fault(d, s), "") << "seed " << seed;
    ASSERT_LT(difference(s.v, expected.v), 1e-9) << "seed " << seed;
    ASSERT_EQ(s.report.islands, expected.report.islands) << "seed " << seed;
    ++solved;
    without_factor += solver.ordering().empty();
  }
  EXPECT_GT(without_factor, solved * 2 / 3);
}

TEST(SmallIslands, StartsAndThreadsLeadToTheSamePlace) {
  for (int seed = 0; seed < rounds(500); ++seed) {
    Random random(seed);
    const mlcp::Problem p = random_problem(random, {.bodies_least = 6, .bodies_most = 12, .rows_most = 16, .boxed_most = 6, .feasible = 1});
    const Solution cold = solve(p, automatic());
    if (cold.report.outcome != MLCP_SOLVED) continue;
    const mlcp::Mask anywhere = random_mask(random, p.m());
    const Solution warm = solve(p, automatic(), nullptr, &anywhere);
    ASSERT_EQ(warm.report.outcome, MLCP_SOLVED) << "seed " << seed;
    ASSERT_LT(difference(warm.v, cold.v), 1e-9) << "seed " << seed;
    mlcp::Settings parallel = automatic();
    parallel.num_threads = 3;
    const Solution many = solve(p, parallel);
    ASSERT_EQ(many.v, cold.v) << "seed " << seed;
    ASSERT_EQ(many.gamma, cold.gamma) << "seed " << seed;
  }
}

/// Which islands are for the dense way is a matter of rows, of velocities and of how many rows there are for them.
TEST(SmallIslands, AreThoseWhoseRowsAreFew) {
  const auto without_factor = [](const mlcp::Problem& p) {
    mlcp::Solver solver(automatic(), mlcp::Memory());
    const Solution s = solve(solver, p), expected = solve(p, settings());
    EXPECT_EQ(s.report.outcome, expected.report.outcome);
    EXPECT_TRUE(s.report.outcome != MLCP_SOLVED || difference(s.v, expected.v) < 1e-9);
    return solver.ordering().empty();
  };
  Random random(3);
  EXPECT_TRUE(without_factor(random_chain(random, 66, 6, 2)));    // 396 velocities, 196 rows
  EXPECT_FALSE(without_factor(random_chain(random, 68, 6, 2)));   // 408 velocities, 202 rows
  EXPECT_FALSE(without_factor(random_chain(random, 50, 3, 3)));   // 150 velocities, 197 rows
  const auto apart = [](int rows, double b) { return reduced_problem(Eigen::MatrixXd::Identity(rows, rows) + Eigen::MatrixXd::Constant(rows, rows, 1e-3), Eigen::VectorXd::Constant(rows, b)); };
  EXPECT_TRUE(without_factor(apart(300, 1)));
  EXPECT_FALSE(without_factor(apart(300, -1)));  // all of them are active
  EXPECT_TRUE(without_factor(apart(96, -1)));
}

/// Bodies in a line with many rows on each: crowded, which is for interior points on the velocities.
mlcp::Problem crowded_chain(Random& random, int bodies, int rows) {
  mlcp::Problem p = random_chain(random, bodies, 3, 0);
  for (int i = 0; i < rows; ++i) {
    const int b = i % bodies, other = (b + 1) % bodies;
    std::vector<Entry> entries;
    for (int j = 0; j < 3; ++j) entries.push_back({3 * b + j, random.uniform()});
    for (int j = 0; j < 3; ++j) entries.push_back({3 * other + j, random.uniform()});
    add_row(p, entries, -random.uniform(0, 1));
  }
  return p;
}

TEST(SmallIslands, ThatAreCrowdedNeedNoOrderEither) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    mlcp::Problem p = crowded_chain(random, 40, 220);  // 120 velocities, 260 rows
    const Dense d = dense(p);
    mlcp::Solver solver(automatic(), mlcp::Memory());
    const Solution s = solve(solver, p), expected = solve(p, settings());
    ASSERT_EQ(fault(d, s), "");
    EXPECT_TRUE(solver.ordering().empty());
    EXPECT_LT(difference(s.v, expected.v), 1e-9);
    EXPECT_GT(s.report.pivots, 5);
    mlcp::Settings parallel = automatic();
    parallel.num_threads = 3;
    EXPECT_EQ(solve(p, parallel).v, s.v);

    const Solution again = solve(solver, p);
    EXPECT_FALSE(again.report.analyzed);
    EXPECT_EQ(again.v, s.v);
    EXPECT_EQ(again.gamma, s.gamma);

    mlcp::Mask start{mlcp::Memory()};
    start.state.assign(s.state);
    start.impulse.assign(s.gamma);
    const Solution warm = solve(solver, p, nullptr, &start);
    ASSERT_EQ(fault(d, warm), "");
    EXPECT_EQ(warm.report.pivots, 0) << "it starts where it ends";

    add_body(p, 2, 1);  // an island of its own, for active sets
    add_row(p, {{p.n() - 1, 1}, {p.n() - 2, 1}}, 0.5);
    const Solution both = solve(solver, p);
    ASSERT_EQ(fault(dense(p), both), "");
    EXPECT_TRUE(solver.ordering().empty());
    EXPECT_EQ(std::vector(both.v.begin(), both.v.end() - 2), s.v);
    EXPECT_EQ(both.report.islands, 2);
  }
}

/// What the normal equations are not for: too many velocities, a matrix of compliance.
TEST(SmallIslands, ThatAreCrowdedAndLargeAreForTheSparseWay) {
  Random random(11);
  const auto without_factor = [](const mlcp::Problem& p) {
    mlcp::Solver solver(automatic(), mlcp::Memory());
    EXPECT_EQ(fault(dense(p), solve(solver, p)), "");
    return solver.ordering().empty();
  };
  EXPECT_TRUE(without_factor(crowded_chain(random, 66, 330)));   // 198 velocities
  EXPECT_FALSE(without_factor(crowded_chain(random, 68, 330)));  // 204
  EXPECT_TRUE(without_factor(crowded_chain(random, 40, 139)));   // 120 velocities, 179 rows: for active sets
  EXPECT_FALSE(without_factor(crowded_chain(random, 62, 150)));  // 186 velocities, 212 rows: too many for these, but no crowd
  mlcp::Problem coupled = crowded_chain(random, 40, 220);
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Identity(coupled.m(), coupled.m());
  sigma(3, 7) = sigma(7, 3) = 0.5;
  set_sigma(coupled, sigma);
  EXPECT_FALSE(without_factor(coupled));
}

/// Joints that contradict each other by less than a tenth of the tolerance may do so, as in crowded islands that are solved the sparse way.
TEST(SmallIslands, ThatAreCrowdedMayBeNotQuiteConsistent) {
  Random random(2);
  mlcp::Problem p = crowded_chain(random, 40, 220);
  for (const double by : {0.0, 3e-11}) add_row(p, {{0, 1}, {4, 2}}, 0.1 * (1 + by), bilateral);
  mlcp::Solver solver(automatic(), mlcp::Memory());
  const Solution s = solve(solver, p);
  EXPECT_EQ(fault(dense(p), s, 1e-10), "");
  EXPECT_GT(s.report.largest_error, 1e-13) << "there is no better answer";
  EXPECT_TRUE(solver.ordering().empty());
}

void expect_small(int seed) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  const handles::Problem pile = scenes::pile(30, static_cast<unsigned>(seed));
  const scenes::Solver solver = handles::make_solver(&settings);
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  ASSERT_EQ(mlcp_solve(solver.get(), pile.get(), nullptr, nullptr, &report), MLCP_OK);
  ASSERT_EQ(report.outcome, MLCP_SOLVED) << "seed " << seed;
  ASSERT_LE(report.largest_error, 1e-13) << "seed " << seed;
  mlcp_factor_view factor;
  mlcp_factor_view_init(&factor, sizeof factor);
  EXPECT_EQ(mlcp_solver_factor(solver.get(), &factor), MLCP_ERROR_STATE) << "seed " << seed;
}

/// Every pile has spheres that nothing pushes sideways: velocities and impulses that are 0 but for rounding, whose relative error is what rounding left.
/// One in a few hundred used to send all islands to a sparse factor.
TEST(SmallIslands, PilesStaySmallWhateverIsAtRestInThem) {
  for (int seed = 1; seed <= rounds(800); ++seed) ASSERT_NO_FATAL_FAILURE(expect_small(seed));
}

/// A contact at rest whose right-hand side is rounding, in which A γ + b is hardly less than what counts as zero, and J v − r hardly more.
TEST(SmallIslands, ARowThatIsOffByAlmostNothingIsTakenIn) {
  for (const int seed : {1393, 1787, 6410}) expect_small(seed);
}

/// Boxes stand on four corners each, so that a few 1e-13 of some rows' slack stays whichever of them carry the load. Steps with the last active set too.
TEST(SmallIslands, TowersStaySmallThoughTheirRowsAreNotQuiteExact) {
  const auto tower = scenes::make_scene("tower", 10);
  for (int step = 0; step < 60; ++step) {
    tower->prepare(scenes::default_step);
    const mlcp_report& report = tower->finish();
    ASSERT_EQ(report.outcome, MLCP_SOLVED) << "step " << step;
    ASSERT_LE(report.largest_error, 4e-13) << "step " << step;
    mlcp_factor_view factor;
    mlcp_factor_view_init(&factor, sizeof factor);
    EXPECT_EQ(mlcp_solver_factor(tower->solver(), &factor), MLCP_ERROR_STATE) << "step " << step;
  }
}

/// Where a tenth of a rounding is asked for, they are not left.
TEST(SmallIslands, TowersAreAsExactAsTheyAreAskedFor) {
  const auto tower = scenes::make_scene("tower", 10);
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.tolerance = 1e-11;
  tower->use(settings);
  for (int step = 0; step < 60; ++step) {
    tower->prepare(scenes::default_step);
    ASSERT_LE(tower->finish().largest_error, 1.2e-13) << "step " << step;
  }
}

/// Rows that depend on each other, three times as many as velocities: the last active set is changed where it has to be, not found once more.
TEST(SmallIslands, AStartOfCrowdedRowsIsGoneOnFrom) {
  std::int64_t cold = 0, warm = 0;
  int feasible = 0;
  for (int seed = 0; seed < 40; ++seed) {
    Random random(seed);
    mlcp::Problem p = crowded_chain(random, 20, 150);  // 60 velocities, 170 rows
    mlcp::Solver solver(automatic(), mlcp::Memory());
    const Solution first = solve(solver, p);
    if (first.report.outcome != MLCP_SOLVED) continue;
    ++feasible;
    cold += first.report.pivots;
    for (std::int32_t i = 0; i < p.m(); ++i) p.r[i] += 1e-4 * random.uniform();
    mlcp::Mask start{mlcp::Memory()};
    start.state.assign(first.state);
    start.impulse.assign(first.gamma);
    const Solution again = solve(solver, p, nullptr, &start);
    EXPECT_EQ(fault(dense(p), again), "") << "seed " << seed;
    EXPECT_LE(again.report.factorizations, 4) << "seed " << seed;
    warm += again.report.pivots;
  }
  EXPECT_GT(feasible, 30);
  EXPECT_LE(3 * warm, cold);
}

TEST(SmallIslands, ASecondSolveOfThePatternFindsNothingAnew) {
  Random random(5);
  mlcp::Problem p = random_chain(random, 6, 3, 1);
  mlcp::Solver solver(automatic(), mlcp::Memory());
  EXPECT_TRUE(solve(solver, p).report.analyzed);
  p.momentum[2] += 0.5;
  const Solution again = solve(solver, p);
  EXPECT_FALSE(again.report.analyzed);
  EXPECT_EQ(again.v, solve(p, automatic()).v);
}

}  // namespace
}  // namespace support
