// A scene that changes at every step, for a million steps (a hundredth of them without MLCP_TEST_LONG): contacts come and go, masses change,
// bodies fall asleep, rows are disabled. Memory and errors at the end are what they were at the beginning.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "../support/random.h"
#include "support.h"

using namespace capi;

namespace {

constexpr int bodies = 10, dimension = 3, most_contacts = 24;
constexpr double h = 0.01;

/// Pages of this process that are in memory, in bytes.
long long resident() {
  long long pages = 0, in_memory = 0;
  std::ifstream("/proc/self/statm") >> pages >> in_memory;
  return in_memory * sysconf(_SC_PAGESIZE);
}

/// Sanitizers keep what is released for a while, and take their time.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

struct Place {
  int32_t a, b;
  double normal[dimension];
};

class ChangingScene {
 public:
  explicit ChangingScene(const mlcp_allocator* allocator) : problem_(make_problem(allocator)), v_(bodies * dimension, 0.0) {
    for (int b = 0; b < bodies; ++b) add_body(problem_.get(), dimension, 1 + 0.1 * b);
    for (int c = 0; c < most_contacts; ++c) {  // a contact that comes back is the same one
      Place place{c % bodies, c % 3 ? (c + 1) % bodies : MLCP_WORLD, {}};
      for (double& x : place.normal) x = random_.uniform();
      places_.push_back(place);
    }
  }

  const mlcp_problem* problem() const { return problem_.get(); }
  const mlcp_mask* enabled() const { return disabled_ ? enabled_.get() : nullptr; }

  void step() {
    mlcp_problem* p = problem_.get();
    if (random_.chance(0.05)) {
      const int32_t b = random_.integer(0, bodies - 1);
      EXPECT_EQ(mlcp_problem_body_set_mass(p, b, diagonal_mass(dimension, random_.magnitude(-1, 1)).data(), dimension * dimension), MLCP_OK);
    }
    if (random_.chance(0.02)) {
      const double still[dimension] = {};
      EXPECT_EQ(mlcp_problem_body_set_prescribed(p, random_.integer(0, 2), still, dimension), MLCP_OK);
    } else if (random_.chance(0.2)) {
      EXPECT_EQ(mlcp_problem_body_set_dynamic(p, random_.integer(0, 2)), MLCP_OK);
    }
    std::vector<double> force(v_.size());
    for (size_t j = 0; j < force.size(); ++j) force[j] = 20 * random_.uniform() - v_[j];
    EXPECT_EQ(mlcp_timestep_momentum(p, h, static_cast<int32_t>(v_.size()), v_.data(), force.data()), MLCP_OK);
    EXPECT_EQ(mlcp_problem_rows_clear(p), MLCP_OK);
    for (int c = 0; c < most_contacts; ++c)
      if (random_.chance(0.7)) add_contact(c);
    const int32_t m = mlcp_problem_row_count(p);
    disabled_ = random_.chance(0.3);
    if (!disabled_) return;
    EXPECT_EQ(mlcp_mask_resize(enabled_.get(), m, MLCP_ROW_ACTIVE), MLCP_OK);
    for (int32_t i = 0; i < m; ++i) {
      const mlcp_row_state state = random_.chance(0.1) ? MLCP_ROW_DISABLED : MLCP_ROW_ACTIVE;
      EXPECT_EQ(mlcp_mask_set(enabled_.get(), i, 1, &state), MLCP_OK);
    }
  }
  void take(const mlcp_solver* solver) {
    const double* v = nullptr;
    int32_t count = 0;
    EXPECT_EQ(mlcp_solver_velocities(solver, &v, &count), MLCP_OK);
    v_.assign(v, v + count);
    for (double& x : v_) x = std::clamp(x, -5.0, 5.0);
  }

 private:
  /// Homogeneous, so that standing still satisfies every one of them together.
  void add_contact(int c) {
    const Place& place = places_[static_cast<size_t>(c)];
    mlcp_rows rows;
    mlcp_rows_init(&rows, sizeof rows);
    double other[dimension];
    for (int j = 0; j < dimension; ++j) other[j] = -place.normal[j];
    const uint64_t key = 1 + static_cast<uint64_t>(c);
    rows.count = 1;
    rows.body_a = &place.a;
    rows.body_b = &place.b;
    rows.jacobian_a = place.normal;
    rows.jacobian_b = other;
    rows.key = &key;
    EXPECT_EQ(mlcp_problem_rows_add(problem_.get(), &rows, nullptr), MLCP_OK) << mlcp_problem_error(problem_.get());
  }

  support::Random random_{11};
  ProblemHandle problem_;
  MaskHandle enabled_ = make_mask(0);
  bool disabled_ = false;
  std::vector<double> v_;
  std::vector<Place> places_;
};

}  // namespace

TEST(Soak, MemoryAndErrorsOfAMillionWarmStepsStayFlat) {
  const int steps = std::getenv("MLCP_TEST_LONG") && !sanitized ? 1000000 : 10000, fifth = steps / 5;
  Allocator allocator;
  ChangingScene scene(allocator.hooks());
  mlcp_solver* raw = nullptr;
  ASSERT_EQ(mlcp_solver_create(nullptr, allocator.hooks(), &raw), MLCP_OK);
  SolverHandle solver(raw);
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  size_t early_bytes = 0;
  int64_t early_blocks = 0, warm = 0;
  long long early_pages = 0;
  double worst[5] = {};
  for (int step = 0; step < steps; ++step) {
    scene.step();
    ASSERT_EQ(mlcp_solve(raw, scene.problem(), scene.enabled(), nullptr, &report), MLCP_OK) << step;
    ASSERT_EQ(report.outcome, MLCP_SOLVED) << step << ", error " << report.largest_error;
    scene.take(raw);
    warm += report.warm;
    double& most = worst[std::min(4, step / fifth)];
    most = std::max(most, report.largest_error);
    if (step == fifth) {
      early_bytes = allocator.bytes();
      early_blocks = allocator.blocks();
      early_pages = resident();
    }
  }
  EXPECT_GT(warm, steps / 2);
  for (const double error : worst) EXPECT_LE(error, 1e-12);
  EXPECT_LE(worst[4], 100 * std::max(worst[0], 1e-16)) << "the error drifts";
  EXPECT_LE(allocator.bytes(), early_bytes + early_bytes / 4) << "room is found for the largest step once";
  EXPECT_LE(allocator.blocks(), early_blocks + early_blocks / 4);
  if (!sanitized) {
    EXPECT_LE(resident(), early_pages + (8 << 20));
  }
  // what has been through all that answers as a new one does
  MaskHandle nothing = make_mask(mlcp_problem_row_count(scene.problem()), MLCP_ROW_AT_LOWER);
  SolverHandle fresh = make_solver();
  std::vector<double> v[2];
  for (int i = 0; i < 2; ++i) {
    mlcp_solver* s = i ? fresh.get() : raw;
    ASSERT_EQ(mlcp_solve(s, scene.problem(), scene.enabled(), nothing.get(), nullptr), MLCP_OK);
    const double* at = nullptr;
    int32_t count = 0;
    ASSERT_EQ(mlcp_solver_velocities(s, &at, &count), MLCP_OK);
    v[i].assign(at, at + count);
  }
  for (size_t j = 0; j < v[0].size(); ++j) EXPECT_NEAR(v[0][j], v[1][j], 1e-12 * std::max(1.0, std::fabs(v[1][j])));
}
