// What goes wrong around a solve: memory that runs out at any call, a caller that interrupts at any call, a disk that is full, many threads.
#include <cstdlib>
#include <dirent.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>

#include "../support/random.h"
#include "support.h"

using namespace capi;

namespace {

/// Bodies of three velocities in a heap, contacts of every model between neighbours and with the world, a joint, a row that is there twice.
ProblemHandle make_heap(int32_t bodies, const mlcp_allocator* allocator = nullptr, bool friction = true) {
  support::Random random(7);
  ProblemHandle problem = make_problem(allocator);
  mlcp_problem* p = problem.get();
  for (int32_t b = 0; b < bodies; ++b) add_body(p, 3, 1 + b % 3);
  std::vector<double> k(3 * static_cast<size_t>(bodies));
  for (double& x : k) x = random.uniform();
  EXPECT_EQ(mlcp_problem_set_momentum(p, 0, 3 * bodies, k.data()), MLCP_OK);
  const double mu = 0.4, bound = 0.25;
  for (int32_t c = 0; c < 2 * bodies; ++c) {
    mlcp_contacts contact;
    mlcp_contacts_init(&contact, sizeof contact);
    const int32_t a = c % bodies, b = c % 2 ? MLCP_WORLD : (a + 1) % bodies;
    double ja[9], jb[9];
    for (int e = 0; e < 9; ++e) jb[e] = -(ja[e] = random.uniform());
    const mlcp_friction model = friction ? c % 5 : MLCP_FRICTION_NONE;
    const uint64_t key = 100 + static_cast<uint64_t>(c);
    contact.count = 1;
    contact.body_a = &a;
    contact.body_b = &b;
    contact.jacobian_a = ja;
    contact.jacobian_b = jb;
    contact.mu = &mu;
    contact.bound = &bound;
    contact.model = &model;
    contact.key = &key;
    EXPECT_EQ(mlcp_problem_contacts_add(p, &contact, nullptr), MLCP_OK) << mlcp_problem_error(p);
  }
  const int32_t columns[] = {0, 3};
  const double values[] = {1, -1};
  for (int twice = 0; twice < 2; ++twice)
    EXPECT_EQ(mlcp_problem_row_add(p, 2, columns, values, 0, -inf, inf, 0, 9, nullptr), MLCP_OK);
  return problem;
}

struct Way {
  const char* name;
  mlcp_method method;
  bool friction;
  void (*more)(mlcp_settings&);
};

const Way ways[] = {
    {"auto", MLCP_METHOD_AUTO, false, [](mlcp_settings&) {}},
    {"auto with friction", MLCP_METHOD_AUTO, true, [](mlcp_settings&) {}},
    {"simplex", MLCP_METHOD_SIMPLEX, false, [](mlcp_settings& s) { s.trace = 1; }},
    {"simplex with friction, refactorized", MLCP_METHOD_SIMPLEX, true, [](mlcp_settings& s) { s.refactorize = MLCP_REFACTORIZE_ALWAYS; }},
    {"newton, canonical", MLCP_METHOD_NEWTON, false, [](mlcp_settings& s) { s.canonical = 1; }},
    {"newton, least impulses", MLCP_METHOD_NEWTON, false, [](mlcp_settings& s) { s.impulses = MLCP_IMPULSES_LEAST_NORM; }},
    {"newton with friction, pyramids", MLCP_METHOD_NEWTON, true, [](mlcp_settings& s) { s.facets = 6; }},
    {"pgs", MLCP_METHOD_PGS, false, [](mlcp_settings& s) { s.tolerance = 1e-3; }},
    {"two threads", MLCP_METHOD_AUTO, false, [](mlcp_settings& s) { s.num_threads = 2; }},
};

mlcp_settings settings_of(const Way& way) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = way.method;
  way.more(settings);
  return settings;
}


/// A folder of its own, removed with all in it.
class Folder {
 public:
  Folder() {
    path_ = testing::TempDir() + "mlcp_faults_XXXXXX";
    EXPECT_NE(mkdtemp(path_.data()), nullptr);
  }
  ~Folder() {
    for (const std::string& name : files()) std::remove(file(name).c_str());
    rmdir(path_.c_str());
  }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  const char* path() const { return path_.c_str(); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    DIR* folder = opendir(path_.c_str());
    while (const dirent* entry = readdir(folder))
      if (entry->d_name[0] != '.') names.push_back(entry->d_name);
    closedir(folder);
    return names;
  }

 private:
  std::string path_;
};

Bytes contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

class EveryWay : public testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(Faults, EveryWay, testing::ValuesIn(ways), [](const auto& test) {
  std::string name = test.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

/// Each time only call n fails and those after it: a new solver every time, so that every array is seen at its first growth.
TEST_P(EveryWay, MemoryRunsOutAtEachCallOfASolve) {
  const mlcp_settings settings = settings_of(GetParam());
  ProblemHandle problem = make_heap(4, nullptr, GetParam().friction);
  SolverHandle plain = make_solver(&settings);
  ASSERT_EQ(mlcp_solve(plain.get(), problem.get(), nullptr, nullptr, nullptr), MLCP_OK);
  Allocator allocator;
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY; n += 1 + n / 50) {
    ASSERT_LT(n, 100000);
    allocator.fail_at(-1);
    mlcp_solver* raw = nullptr;
    ASSERT_EQ(mlcp_solver_create(&settings, allocator.hooks(), &raw), MLCP_OK);
    SolverHandle solver(raw);
    allocator.fail_at(n);
    status = mlcp_solve(raw, problem.get(), nullptr, nullptr, nullptr);
    if (status == MLCP_OK) break;
    ASSERT_EQ(status, MLCP_ERROR_OUT_OF_MEMORY) << n << ": " << mlcp_solver_error(raw);
    EXPECT_STRNE(mlcp_solver_error(raw), "");
    const double* v = nullptr;
    int32_t count = 0;
    EXPECT_EQ(mlcp_solver_velocities(raw, &v, &count), MLCP_ERROR_STATE) << n << ": results of a solve that failed";
    // what is there of the solver still serves
    allocator.fail_at(0);
    const mlcp_status trimmed = mlcp_solver_trim(raw);
    EXPECT_TRUE(trimmed == MLCP_OK || trimmed == MLCP_ERROR_OUT_OF_MEMORY);
    allocator.fail_at(-1);
    ASSERT_EQ(mlcp_solve(raw, problem.get(), nullptr, nullptr, nullptr), MLCP_OK) << n;
    EXPECT_EQ(impulses(raw), impulses(plain.get())) << n;
  }
  EXPECT_EQ(allocator.blocks(), 0);
}

struct Interruption {
  int left;
  int calls = 0;
};

TEST_P(EveryWay, InterruptedAtEachCallOfTheCallback) {
  mlcp_settings settings = settings_of(GetParam());
  ProblemHandle problem = make_heap(16, nullptr, GetParam().friction);
  SolverHandle plain = make_solver(&settings);
  ASSERT_EQ(mlcp_solve(plain.get(), problem.get(), nullptr, nullptr, nullptr), MLCP_OK);
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  mlcp_outcome outcome = MLCP_INTERRUPTED;
  for (int n = 1; outcome == MLCP_INTERRUPTED && n < 2000; n += 1 + n / 4) {
    Interruption interruption{n};
    settings.progress_context = &interruption;
    settings.progress = [](void* context, const mlcp_progress* progress) -> int32_t {
      auto& i = *static_cast<Interruption*>(context);
      EXPECT_LE(progress->island, progress->islands);
      return ++i.calls >= i.left;
    };
    SolverHandle solver = make_solver(&settings);
    ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report), MLCP_OK);
    outcome = interruption.calls < n ? MLCP_SOLVED : report.outcome;
    ASSERT_TRUE(report.outcome == MLCP_INTERRUPTED || report.outcome == MLCP_SOLVED || interruption.calls < n) << report.outcome;
    for (const double x : impulses(solver.get())) ASSERT_TRUE(std::isfinite(x));
    // the same solver goes on as if nothing had been
    settings.progress = nullptr;
    ASSERT_EQ(mlcp_solver_set_settings(solver.get(), &settings), MLCP_OK);
    MaskHandle nothing = make_mask(mlcp_problem_row_count(problem.get()), MLCP_ROW_AT_LOWER);
    ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nothing.get(), &report), MLCP_OK);
    SolverHandle fresh = make_solver(&settings);
    ASSERT_EQ(mlcp_solve(fresh.get(), problem.get(), nullptr, nothing.get(), nullptr), MLCP_OK);
    EXPECT_EQ(impulses(solver.get()), impulses(fresh.get())) << n;
  }
}

/// Of this thread: what others do on the same processor is no overshoot.
double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(Faults, TimeLimitIsKeptToTenMillisecondsAndOneFactorization) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer takes its own time";
#endif
  if (!std::getenv("MLCP_TEST_LONG")) GTEST_SKIP() << "looks at the clock: only with MLCP_TEST_LONG, on a quiet machine";
  double worst = 0;
  for (const bool friction : {false, true}) {
    ProblemHandle problem = make_heap(1500, nullptr, friction);
    mlcp_settings settings;
    mlcp_settings_init(&settings, sizeof settings);
    mlcp_report report;
    mlcp_report_init(&report, sizeof report);
    settings.max_iterations = 3;  // enough to see what a factorization takes
    settings.max_shifts = 2;
    SolverHandle plain = make_solver(&settings);
    ASSERT_EQ(mlcp_solve(plain.get(), problem.get(), nullptr, nullptr, &report), MLCP_OK);
    ASSERT_GT(report.factorizations, 0);
    // they are counted by island
    const double factorization = report.seconds_factorize / static_cast<double>(report.factorizations) * report.islands;
    settings.max_iterations = 0;
    settings.max_shifts = 0;
    for (const double limit : {1e-4, 1e-3, 5e-3, 2e-2}) {
      settings.max_seconds = limit;
      SolverHandle solver = make_solver(&settings);
      const double begin = processor_seconds();
      ASSERT_EQ(mlcp_solve(solver.get(), problem.get(), nullptr, nullptr, &report), MLCP_OK);
      const double overshoot = processor_seconds() - begin - limit;
      worst = std::max(worst, overshoot - factorization);
      EXPECT_TRUE(report.outcome == MLCP_TIME_LIMIT || report.outcome == MLCP_SOLVED || report.outcome == MLCP_INFEASIBLE) << report.outcome;
      EXPECT_LE(overshoot, 0.010 + factorization) << "limit " << limit << ", friction " << friction << ", one factorization " << factorization;
    }
  }
  RecordProperty("milliseconds_over_one_factorization", std::to_string(1e3 * worst));
}

TEST(Faults, MemoryRunsOutAtEachCallOfASnapshotWithEverythingInIt) {
  Allocator allocator;
  ProblemHandle problem = make_heap(3, allocator.hooks());
  mlcp_solver* raw = nullptr;
  ASSERT_EQ(mlcp_solver_create(nullptr, allocator.hooks(), &raw), MLCP_OK);
  SolverHandle solver(raw);
  const mlcp_mask* start = nullptr;
  ASSERT_EQ(mlcp_solve(raw, problem.get(), nullptr, nullptr, nullptr), MLCP_OK);
  ASSERT_EQ(mlcp_solver_mask(raw, &start), MLCP_OK);
  MaskHandle enabled = make_mask(mlcp_problem_row_count(problem.get()));
  Folder folder;
  const std::string path = folder.file("a.mlcp");
  const int64_t blocks = allocator.blocks();
  mlcp_status status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY; ++n) {
    allocator.fail_at(n);
    status = mlcp_snapshot_save(path.c_str(), problem.get(), raw, enabled.get(), start, nullptr, 0);
    EXPECT_EQ(allocator.blocks(), blocks);
    EXPECT_EQ(folder.files().size(), status == MLCP_OK ? 1u : 0u);
  }
  ASSERT_EQ(status, MLCP_OK);
  status = MLCP_ERROR_OUT_OF_MEMORY;
  for (int64_t n = 0; status == MLCP_ERROR_OUT_OF_MEMORY; ++n) {
    allocator.fail_at(n);
    mlcp_problem* p = nullptr;
    mlcp_solver* s = nullptr;
    mlcp_mask *e = nullptr, *b = nullptr;
    status = mlcp_snapshot_load(path.c_str(), allocator.hooks(), &p, &s, &e, &b, nullptr, 0);
    EXPECT_EQ(status == MLCP_OK, p && s && e && b);
    EXPECT_TRUE(status == MLCP_OK || (!p && !s && !e && !b));
    mlcp_problem_destroy(p);
    mlcp_solver_destroy(s);
    mlcp_mask_destroy(e);
    mlcp_mask_destroy(b);
    EXPECT_EQ(allocator.blocks(), blocks);
  }
  EXPECT_EQ(status, MLCP_OK);
}

/// Files may grow to `bytes` and no further, as on a disk that fills; the signal that goes with it is ignored for as long.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &now), 0);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(Faults, FullDiskLeavesTheOldSnapshot) {
  Folder folder;
  const std::string path = folder.file("a.mlcp");
  ProblemHandle small = make_rich_problem(), large = make_heap(60);
  ASSERT_EQ(mlcp_snapshot_save(path.c_str(), small.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
  const Bytes before = contents(path);
  const size_t size = snapshot(large.get()).size();
  for (const size_t room : {size_t(0), size_t(1), size / 2, size - 1}) {
    char message[512] = "";
    mlcp_status status = MLCP_OK;
    {
      const FullDisk disk(room);
      status = mlcp_snapshot_save(path.c_str(), large.get(), nullptr, nullptr, nullptr, message, sizeof message);
    }
    EXPECT_EQ(status, MLCP_ERROR_IO) << room;
    EXPECT_NE(std::string(message).find(path), std::string::npos) << message;
    EXPECT_EQ(contents(path), before) << room;
    EXPECT_EQ(folder.files().size(), 1u) << "no file is left beside it";
  }
  const FullDisk disk(size);
  EXPECT_EQ(mlcp_snapshot_save(path.c_str(), large.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
}

/// For the thread sanitizer: one problem and one mask, several solvers, some of them with threads of their own; all get the same bits.
TEST(Faults, SolversOnManyThreadsShareOneProblem) {
  ProblemHandle problem = make_heap(24);
  MaskHandle enabled = make_mask(mlcp_problem_row_count(problem.get()));
  SolverHandle plain = make_solver();
  ASSERT_EQ(mlcp_solve(plain.get(), problem.get(), enabled.get(), nullptr, nullptr), MLCP_OK);
  const std::vector<double> expected = impulses(plain.get());
  const Bytes before = snapshot(problem.get());
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < found.size(); ++t)
    threads.emplace_back([&, t] {
      mlcp_settings settings;
      mlcp_settings_init(&settings, sizeof settings);
      settings.num_threads = 1 + static_cast<int32_t>(t % 2);
      for (int round = 0; round < 3; ++round) {
        SolverHandle solver = make_solver(&settings);
        EXPECT_EQ(mlcp_solve(solver.get(), problem.get(), enabled.get(), nullptr, nullptr), MLCP_OK);
        found[t] = impulses(solver.get());
        EXPECT_EQ(snapshot(problem.get()), before);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& gamma : found) EXPECT_EQ(gamma, expected);
}
