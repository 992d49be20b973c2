#include <algorithm>
#include <cstddef>

#include "../support/random.h"
#include "support.h"

using namespace capi;

namespace {

/// A ball (one velocity, mass 2) that falls at 3 m/s on a table, key 5; a second one that is pulled apart by a joint.
ProblemHandle make_ball(const mlcp_allocator* allocator = nullptr) {
  ProblemHandle problem = make_problem(allocator);
  mlcp_problem* p = problem.get();
  add_body(p, 1, 2);
  add_body(p, 1, 4);
  const double k[] = {-6, 8};
  EXPECT_EQ(mlcp_problem_set_momentum(p, 0, 2, k), MLCP_OK);
  add_row(p, {0}, {1}, 5);
  const int32_t column = 1;
  const double one = 1;
  EXPECT_EQ(mlcp_problem_row_add(p, 1, &column, &one, 0.5, -inf, inf, 0, 6, nullptr), MLCP_OK);
  return problem;
}

struct SolverApi : testing::Test {
  ProblemHandle problem = make_ball();
  mlcp_problem* p = problem.get();
  SolverHandle solver = make_solver();
  mlcp_solver* s = solver.get();
  mlcp_report report = new_report();
};

}  // namespace

TEST_F(SolverApi, BallAndJoint) {
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK) << mlcp_solver_error(s);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_LE(report.largest_error, 1e-12);
  EXPECT_EQ(report.islands, 2);
  const std::vector<double> v = velocities(s), gamma = impulses(s);
  EXPECT_NEAR(v[0], 0, 1e-15);
  EXPECT_NEAR(v[1], 0.5, 1e-15);
  EXPECT_NEAR(gamma[0], 6, 1e-14);
  EXPECT_NEAR(gamma[1], 4 * 0.5 - 8, 1e-14);
  const double* w = nullptr;
  int32_t count = 0;
  ASSERT_EQ(mlcp_solver_slacks(s, &w, &count), MLCP_OK);
  EXPECT_EQ(count, 2);
  EXPECT_NEAR(w[0], 0, 1e-15);
  const mlcp_mask* mask = nullptr;
  ASSERT_EQ(mlcp_solver_mask(s, &mask), MLCP_OK);
  EXPECT_EQ(mlcp_mask_count(mask, MLCP_ROW_ACTIVE), 2);
}

TEST_F(SolverApi, ReportMayBeNull) { EXPECT_EQ(mlcp_solve(s, p, nullptr, nullptr, nullptr), MLCP_OK); }

TEST_F(SolverApi, NoResultsBeforeASolve) {
  const double* array = nullptr;
  const mlcp_mask* mask = nullptr;
  const uint8_t* redundant = nullptr;
  const int32_t* rows = nullptr;
  const mlcp_pivot* pivots = nullptr;
  int32_t count = 0;
  int64_t steps = 0;
  float single = 0;
  double reaction = 0;
  EXPECT_EQ(mlcp_solver_velocities(s, &array, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_impulses(s, &array, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_slacks(s, &array, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_mask(s, &mask), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_redundant(s, &redundant, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_read_velocities_f32(s, 1, &single, 0), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_read_impulses_f32(s, 1, &single, 0), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_reaction(s, p, 0, 1, &reaction), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_row_islands(s, &rows, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_island_outcomes(s, &rows, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_certificate(s, -1, &rows, &array, &count), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_trace(s, &pivots, &steps), MLCP_ERROR_STATE);
}

TEST_F(SolverApi, NullArguments) {
  const double* v = nullptr;
  int32_t count = 0;
  EXPECT_EQ(mlcp_solve(nullptr, p, nullptr, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solve(s, nullptr, nullptr, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_NE(std::string(mlcp_solver_error(s)).find("problem"), std::string::npos);
  EXPECT_EQ(mlcp_analyze(s, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_create(nullptr, nullptr, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_set_settings(s, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_get_settings(s, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_trim(nullptr), MLCP_ERROR_NULL);
  EXPECT_STREQ(mlcp_solver_error(nullptr), "");
  mlcp_solver_destroy(nullptr);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, nullptr), MLCP_OK);
  EXPECT_EQ(mlcp_solver_velocities(s, nullptr, &count), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_velocities(s, &v, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_velocities(nullptr, &v, &count), MLCP_ERROR_NULL);
}

TEST_F(SolverApi, MasksOfAnotherSize) {
  MaskHandle mask = make_mask(3);
  EXPECT_EQ(mlcp_solve(s, p, mask.get(), nullptr, nullptr), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_solve(s, p, nullptr, mask.get(), nullptr), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_analyze(s, p, mask.get()), MLCP_ERROR_RANGE);
}

TEST_F(SolverApi, BadSettingsAreNamed) {
  const auto refused = [&](auto change, const char* field) {
    mlcp_settings settings;
    mlcp_settings_init(&settings, sizeof settings);
    change(settings);
    EXPECT_EQ(mlcp_solver_set_settings(s, &settings), MLCP_ERROR_ARGUMENT) << field;
    EXPECT_NE(std::string(mlcp_solver_error(s)).find(field), std::string::npos) << mlcp_solver_error(s);
    mlcp_solver* made = nullptr;
    EXPECT_EQ(mlcp_solver_create(&settings, nullptr, &made), MLCP_ERROR_ARGUMENT);
    EXPECT_EQ(made, nullptr);
  };
  refused([](mlcp_settings& x) { x.method = 7; }, "method");
  refused([](mlcp_settings& x) { x.pivot_rule = -1; }, "pivot_rule");
  refused([](mlcp_settings& x) { x.refactorize = 2; }, "refactorize");
  refused([](mlcp_settings& x) { x.tolerance = 0; }, "tolerance");
  refused([](mlcp_settings& x) { x.facets = 2; }, "facets");
  refused([](mlcp_settings& x) { x.facets = INT32_MAX / 2; }, "facets");
  refused([](mlcp_settings& x) { x.tolerance = not_a_number; }, "tolerance");
  refused([](mlcp_settings& x) { x.tolerance = inf; }, "tolerance");
  refused([](mlcp_settings& x) { x.max_iterations = -1; }, "max_iterations");
  refused([](mlcp_settings& x) { x.max_work = -1; }, "max_work");
  refused([](mlcp_settings& x) { x.max_seconds = -1; }, "max_seconds");
  refused([](mlcp_settings& x) { x.max_seconds = not_a_number; }, "max_seconds");
}

TEST_F(SolverApi, DisabledRowCostsNothing) {
  MaskHandle enabled = make_mask(2);
  const mlcp_row_state off = MLCP_ROW_DISABLED;
  ASSERT_EQ(mlcp_mask_set(enabled.get(), 0, 1, &off), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, p, enabled.get(), nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_EQ(velocities(s)[0], -3);
  EXPECT_EQ(impulses(s)[0], 0);
  const int32_t* island = nullptr;
  int32_t count = 0;
  ASSERT_EQ(mlcp_solver_row_islands(s, &island, &count), MLCP_OK);
  EXPECT_EQ(island[0], -1);
  EXPECT_GE(island[1], 0);
  const mlcp_mask* mask = nullptr;
  ASSERT_EQ(mlcp_solver_mask(s, &mask), MLCP_OK);
  EXPECT_EQ(mlcp_mask_states(mask)[0], MLCP_ROW_DISABLED);
}

TEST_F(SolverApi, MassThatIsNotPositiveDefiniteIsNamed) {
  const int32_t pointers[] = {0, 1, 2, 3}, rows[] = {0, 1, 2};
  const double mass[] = {1, 0, 1};
  int32_t body = -1;
  ASSERT_EQ(mlcp_problem_body_add_sparse(p, 3, pointers, rows, mass, MLCP_FULL, &body), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);  // nothing touches it
  EXPECT_EQ(report.outcome, MLCP_NOT_POSITIVE_DEFINITE);
  EXPECT_EQ(report.worst_body, body);
  EXPECT_EQ(report.worst_velocity, 2 + 1);
  add_row(p, {2, 3, 4}, {1, 1, 1});
  for (const mlcp_method method : {MLCP_METHOD_AUTO, MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON}) {
    mlcp_settings settings;
    mlcp_settings_init(&settings, sizeof settings);
    settings.method = method;
    const SolverHandle by_method = make_solver(&settings);
    const double away = 1, against = -1;  // the row leaves it free one way
    ASSERT_EQ(mlcp_problem_set_momentum(p, 3, 1, &away), MLCP_OK);
    ASSERT_EQ(mlcp_solve(by_method.get(), p, nullptr, nullptr, &report), MLCP_OK);
    EXPECT_EQ(report.outcome, MLCP_NOT_POSITIVE_DEFINITE) << mlcp_method_text(method);
    EXPECT_EQ(report.worst_body, body);
    EXPECT_EQ(report.worst_velocity, 2 + 1);
    ASSERT_EQ(mlcp_problem_set_momentum(p, 3, 1, &against), MLCP_OK);
    ASSERT_EQ(mlcp_solve(by_method.get(), p, nullptr, nullptr, &report), MLCP_OK);
    EXPECT_EQ(report.outcome, MLCP_SOLVED) << mlcp_method_text(method);
    EXPECT_LE(report.largest_error, 1e-15);
    EXPECT_EQ(report.worst_body, -1);
  }
}

TEST_F(SolverApi, FreeVelocityThatOverflowsIsNotCalledSolved) {
  ProblemHandle light = make_problem();
  add_body(light.get(), 1, 1e-310);
  const double k = 2;
  ASSERT_EQ(mlcp_problem_set_momentum(light.get(), 0, 1, &k), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, light.get(), nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.largest_error, inf);
  EXPECT_EQ(report.outcome, MLCP_ITERATION_LIMIT);
}

TEST_F(SolverApi, NoRedundantRowsAreLookedForAfterAnInterruption) {
  add_row(p, {0}, {1}, 7);  // as the row with key 5
  MaskHandle start = make_mask(3);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, start.get(), &report), MLCP_OK);
  EXPECT_EQ(report.redundant_rows, 1);
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.progress = [](void*, const mlcp_progress*) { return 1; };
  ASSERT_EQ(mlcp_solver_set_settings(s, &settings), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, start.get(), &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_INTERRUPTED);
  EXPECT_EQ(report.redundant_rows, 0);
}

TEST_F(SolverApi, LentMaskIsAStart) {
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  const std::vector<double> cold = impulses(s);
  const mlcp_mask* mask = nullptr;
  ASSERT_EQ(mlcp_solver_mask(s, &mask), MLCP_OK);
  mlcp_report warm = new_report();
  ASSERT_EQ(mlcp_solve(s, p, nullptr, mask, &warm), MLCP_OK);
  EXPECT_EQ(warm.outcome, MLCP_SOLVED);
  EXPECT_LE(warm.pivots, report.pivots);
  EXPECT_EQ(warm.analyzed, 0);
  for (size_t i = 0; i < cold.size(); ++i) EXPECT_NEAR(impulses(s)[i], cold[i], 1e-13);
}

TEST_F(SolverApi, SinglePrecisionWithStride) {
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, nullptr), MLCP_OK);
  float out[4] = {9, 9, 9, 9};
  ASSERT_EQ(mlcp_solver_read_velocities_f32(s, 2, out, 8), MLCP_OK);
  EXPECT_EQ(out[1], 9);
  EXPECT_EQ(out[2], 0.5f);
  ASSERT_EQ(mlcp_solver_read_impulses_f32(s, 2, out, 0), MLCP_OK);
  EXPECT_FLOAT_EQ(out[0], 6);
  EXPECT_FLOAT_EQ(out[1], -6);
  EXPECT_EQ(mlcp_solver_read_impulses_f32(s, 1, out, 0), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_solver_read_impulses_f32(s, 2, nullptr, 0), MLCP_ERROR_NULL);
}

TEST_F(SolverApi, ReactionOnAPrescribedTable) {
  const int32_t table = add_body(p, 1, 10);
  const double up = 0.25;
  ASSERT_EQ(mlcp_problem_body_set_prescribed(p, table, &up, 1), MLCP_OK);
  const int32_t row = add_row(p, {0, 2}, {1, -1});
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_EQ(velocities(s)[2], 0.25);
  EXPECT_NEAR(velocities(s)[0], 0.25, 1e-15);
  double reaction = 0;
  ASSERT_EQ(mlcp_solver_reaction(s, p, table, 1, &reaction), MLCP_OK);
  EXPECT_NEAR(reaction, 10 * 0.25 + impulses(s)[row], 1e-14);
  EXPECT_EQ(mlcp_solver_reaction(s, p, 0, 1, &reaction), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_reaction(s, p, 9, 1, &reaction), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_solver_reaction(s, p, table, 2, &reaction), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_solver_reaction(s, p, table, 1, nullptr), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_solver_reaction(s, nullptr, table, 1, &reaction), MLCP_ERROR_NULL);
  add_row(p, {0}, {1});
  EXPECT_EQ(mlcp_solver_reaction(s, p, table, 1, &reaction), MLCP_ERROR_RANGE);
}

TEST_F(SolverApi, CertificateNamesTheRows) {
  const int32_t column = 1;
  const double one = 1;
  ASSERT_EQ(mlcp_problem_row_add(p, 1, &column, &one, 0.75, -inf, inf, 0, 0, nullptr), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_INFEASIBLE);
  EXPECT_EQ(report.islands_failed, 1);
  const int32_t* rows = nullptr;
  const double* y = nullptr;
  int32_t count = 0;
  ASSERT_EQ(mlcp_solver_certificate(s, -1, &rows, &y, &count), MLCP_OK);
  ASSERT_EQ(count, 2);
  EXPECT_EQ(rows[0] + rows[1], 1 + 2);
  EXPECT_NEAR(y[0] + y[1], 0, 1e-12 * std::fabs(y[0]));
  EXPECT_GT(y[0] * (rows[0] == 1 ? 0.5 : 0.75) + y[1] * (rows[1] == 1 ? 0.5 : 0.75), 0);
  EXPECT_EQ(mlcp_solver_certificate(s, 99, &rows, &y, &count), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_solver_certificate(s, -2, &rows, &y, &count), MLCP_ERROR_RANGE);
  EXPECT_NEAR(velocities(s)[0], 0, 1e-15);
}

TEST_F(SolverApi, NoCertificateWhenSolved) {
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, nullptr), MLCP_OK);
  const int32_t* rows = nullptr;
  const double* y = nullptr;
  int32_t count = 0;
  EXPECT_EQ(mlcp_solver_certificate(s, -1, &rows, &y, &count), MLCP_ERROR_STATE);
}

TEST_F(SolverApi, ReducedProblem) {
  // w = A z + b, 0 ≤ z ⊥ w ≥ 0
  ProblemHandle reduced = make_problem();
  const double r[] = {1, -1};
  for (double r_i : r) ASSERT_EQ(mlcp_problem_row_add(reduced.get(), 0, nullptr, nullptr, r_i, 0, inf, 0, 0, nullptr), MLCP_OK);
  const int32_t pointers[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
  const double a[] = {2, 1, 1, 2};
  ASSERT_EQ(mlcp_problem_set_compliance_matrix(reduced.get(), 2, pointers, rows, a, MLCP_FULL), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, reduced.get(), nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_TRUE(velocities(s).empty());
  EXPECT_NEAR(impulses(s)[0], 0.5, 1e-15);
  EXPECT_EQ(impulses(s)[1], 0);
}

TEST_F(SolverApi, EmptyProblem) {
  ProblemHandle empty = make_problem();
  ASSERT_EQ(mlcp_solve(s, empty.get(), nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(report.outcome, MLCP_SOLVED);
  EXPECT_EQ(report.worst_row, -1);
  EXPECT_EQ(report.worst_velocity, -1);
  EXPECT_TRUE(velocities(s).empty());
}

TEST_F(SolverApi, TraceOnDemand) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.trace = 1;
  ASSERT_EQ(mlcp_solver_set_settings(s, &settings), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  const mlcp_pivot* pivots = nullptr;
  int64_t count = 0;
  ASSERT_EQ(mlcp_solver_trace(s, &pivots, &count), MLCP_OK);
  EXPECT_EQ(count, report.pivots);
}

TEST_F(SolverApi, OlderReportIsFilledAsFarAsItGoes) {
  mlcp_report old;
  std::memset(&old, 0x5a, sizeof old);
  mlcp_report_init(&old, offsetof(mlcp_report, pivots));
  const int64_t untouched = old.pivots;
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &old), MLCP_OK);
  EXPECT_EQ(old.outcome, MLCP_SOLVED);
  EXPECT_EQ(old.active_rows, 2);
  EXPECT_EQ(old.pivots, untouched);
  EXPECT_EQ(old.struct_size, offsetof(mlcp_report, pivots));
  old.struct_size = 0;
  EXPECT_EQ(mlcp_solve(s, p, nullptr, nullptr, &old), MLCP_ERROR_ARGUMENT);
}

TEST_F(SolverApi, SnapshotReplaysToTheSameBits) {
  fill_pile(p, 40);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  const Bytes bytes = snapshot(p, s);
  mlcp_problem* copy = nullptr;
  mlcp_solver* twin = nullptr;
  ASSERT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, &copy, &twin, nullptr, nullptr, nullptr, 0), MLCP_OK);
  ProblemHandle problem_owner(copy);
  SolverHandle solver_owner(twin);
  mlcp_report replay = new_report();
  ASSERT_EQ(mlcp_solve(twin, copy, nullptr, nullptr, &replay), MLCP_OK);
  EXPECT_EQ(velocities(twin), velocities(s));
  EXPECT_EQ(impulses(twin), impulses(s));
  EXPECT_EQ(replay.pivots, report.pivots);
  EXPECT_EQ(snapshot(copy, twin), bytes);
}

TEST_F(SolverApi, ProgressStops) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  int calls = 0;
  settings.progress_context = &calls;
  settings.progress = [](void* context, const mlcp_progress* progress) -> int32_t {
    EXPECT_EQ(progress->struct_size, sizeof *progress);
    return ++*static_cast<int*>(context) > 0;
  };
  ASSERT_EQ(mlcp_solver_set_settings(s, &settings), MLCP_OK);
  fill_pile(p, 200);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(report.outcome, MLCP_INTERRUPTED);
}

/// Bodies and rods between them at random: the factor fills up, so that analysis and factorization take long.
void fill_tangle(mlcp_problem* p, int32_t count) {
  ASSERT_EQ(mlcp_problem_clear(p), MLCP_OK);
  for (int32_t i = 0; i < count; ++i) add_body(p, 1, 1 + i % 3);
  std::vector<double> k(count, -1.0);
  ASSERT_EQ(mlcp_problem_set_momentum(p, 0, count, k.data()), MLCP_OK);
  support::Random random(1);
  for (int32_t i = 0; i < count; ++i) {
    const int32_t a = random.integer(0, count - 1), b = (a + random.integer(1, count - 1)) % count;
    add_row(p, {std::min(a, b), std::max(a, b)}, {1, -1}, 0);
  }
}

/// Stops a solve when its progress is told for the `left`-th time.
struct Patience {
  int left;
  bool inside = false;  ///< some report came before the first step had ended, from inside analysis or factorization

  void give(mlcp_solver* solver, int calls) {
    left = calls;
    mlcp_settings settings;
    mlcp_settings_init(&settings, sizeof settings);
    settings.method = MLCP_METHOD_NEWTON;
    settings.progress_context = this;
    settings.progress = [](void* context, const mlcp_progress* now) -> int32_t {
      Patience& patience = *static_cast<Patience*>(context);
      patience.inside |= now->work == 0;
      return --patience.left <= 0;
    };
    ASSERT_EQ(mlcp_solver_set_settings(solver, &settings), MLCP_OK);
  }
};

TEST_F(SolverApi, ASolveStopsInsideAnalysisAndFactorizationToo) {
  fill_tangle(p, 3500);
  Patience patience;
  patience.give(s, 1 << 30);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  ASSERT_EQ(report.outcome, MLCP_SOLVED);
  const int most = (1 << 30) - patience.left;
  EXPECT_GT(most, 8) << "factorizations were to be long enough to be stopped in";
  EXPECT_TRUE(patience.inside);
  const std::vector<double> undisturbed = impulses(s);
  for (const int calls : {1, 2, most / 4, most / 2}) {
    SolverHandle stopped = make_solver();
    patience.give(stopped.get(), calls);
    ASSERT_EQ(mlcp_solve(stopped.get(), p, nullptr, nullptr, &report), MLCP_OK);
    ASSERT_EQ(report.outcome, MLCP_INTERRUPTED) << calls;
    for (const double v : velocities(stopped.get())) ASSERT_TRUE(std::isfinite(v));
    patience.give(stopped.get(), 1 << 30);
    ASSERT_EQ(mlcp_solve(stopped.get(), p, nullptr, nullptr, &report), MLCP_OK);
    ASSERT_EQ(report.outcome, MLCP_SOLVED) << calls;
    EXPECT_EQ(impulses(stopped.get()), undisturbed) << calls;
  }
}

TEST_F(SolverApi, FactorHasThePatternOfEveryEnabledRow) {
  mlcp_factor_view factor;
  mlcp_factor_view_init(&factor, sizeof factor);
  EXPECT_EQ(mlcp_solver_factor(s, &factor), MLCP_ERROR_STATE);
  EXPECT_EQ(mlcp_solver_factor(s, nullptr), MLCP_ERROR_NULL);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  EXPECT_EQ(mlcp_solver_factor(s, &factor), MLCP_ERROR_STATE) << "small islands need none";
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = MLCP_METHOD_SIMPLEX;
  ASSERT_EQ(mlcp_solver_set_settings(s, &settings), MLCP_OK);
  ASSERT_EQ(mlcp_solve(s, p, nullptr, nullptr, &report), MLCP_OK);
  ASSERT_EQ(mlcp_solver_factor(s, &factor), MLCP_OK);
  // two islands, a velocity and its row each: one entry below the diagonal, then a root
  ASSERT_EQ(factor.size, 4);
  EXPECT_EQ(factor.entries, report.factor_entries);
  const std::vector<int32_t> nodes(factor.nodes, factor.nodes + factor.size), rows(factor.rows, factor.rows + factor.entries);
  const std::vector<int64_t> pointers(factor.pointers, factor.pointers + factor.size + 1);
  EXPECT_EQ(pointers, (std::vector<int64_t>{0, 1, 1, 2, 2}));
  EXPECT_EQ(rows, (std::vector<int32_t>{1, 3}));
  EXPECT_EQ(nodes[1], nodes[0] + 2);
  EXPECT_EQ(nodes[3], nodes[2] + 2);
  factor.struct_size = 0;
  EXPECT_EQ(mlcp_solver_factor(s, &factor), MLCP_ERROR_ARGUMENT);
  ASSERT_EQ(mlcp_solver_trim(s), MLCP_OK);
  mlcp_factor_view_init(&factor, sizeof factor);
  EXPECT_EQ(mlcp_solver_factor(s, &factor), MLCP_ERROR_STATE);
}
