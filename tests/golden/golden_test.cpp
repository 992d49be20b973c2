// The same bits for the same input: on any number of threads, with any kernels, optimised or not, and as they were when results.txt was written.
// MLCP_WRITE_GOLDEN=1 writes it anew: for a change of the methods that is meant to change bits.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>

#include "scenes/scenes.h"
#include "support/random_problem.h"

namespace golden {
namespace {

using scenes::Problem;

/// FNV-1a
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

struct Settings {
  mlcp_method method = MLCP_METHOD_AUTO;
  int threads = 1;
  bool canonical = false;
  bool warm = false;  ///< from a mask that is not the answer
};

/// Of v, γ, the rows' states and the outcome.
std::uint64_t hash_of(const Problem& problem, const Settings& with) {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = with.method;
  settings.num_threads = with.threads;
  settings.canonical = with.canonical;
  const scenes::Solver solver = handles::make_solver(&settings);
  const std::int32_t m = mlcp_problem_row_count(problem.get());
  const scenes::Mask start = handles::make_mask(m);
  for (std::int32_t i = 0; i < m; i += 3) {
    const mlcp_row_state state = i % 2 ? MLCP_ROW_ACTIVE : MLCP_ROW_AT_LOWER;
    handles::check(mlcp_mask_set(start.get(), i, 1, &state), start);
  }
  mlcp_report report;
  mlcp_report_init(&report, sizeof report);
  handles::check(mlcp_solve(solver.get(), problem.get(), nullptr, with.warm ? start.get() : nullptr, &report), solver);
  Hash hash;
  hash.add(&report.outcome, sizeof report.outcome);
  for (const auto read : {mlcp_solver_velocities, mlcp_solver_impulses}) {
    const double* x = nullptr;
    std::int32_t count = 0;
    handles::check(read(solver.get(), &x, &count), solver);
    hash.add(x, static_cast<std::size_t>(count) * sizeof *x);
  }
  const mlcp_mask* mask = nullptr;
  handles::check(mlcp_solver_mask(solver.get(), &mask), solver);
  hash.add(mlcp_mask_states(mask), static_cast<std::size_t>(mlcp_mask_size(mask)));
  return hash.value();
}

/// 200 islands of three bodies with about six rows.
Problem archipelago() {
  Problem problem = handles::make_problem();
  support::Random random(7);
  const double mass[] = {2, 0, 0, 0, 3, 0, 0, 0, 1};
  for (int b = 0; b < 600; ++b) handles::check(mlcp_problem_bodies_add(problem.get(), 1, 3, mass, 0, nullptr), problem);
  std::vector<double> k(1800);
  for (double& x : k) x = random.uniform();
  handles::check(mlcp_problem_set_momentum(problem.get(), 0, 1800, k.data()), problem);
  for (int i = 0; i < 1200; ++i) {
    const int a = 3 * random.integer(0, 199), b = a + random.integer(0, 2);
    std::vector<std::int32_t> columns{3 * a, 3 * a + 1, 3 * a + 2};
    std::vector<double> values{random.uniform(), random.uniform(), random.uniform()};
    if (b != a)
      for (int j = 0; j < 3; ++j) {
        columns.push_back(3 * b + j);
        values.push_back(random.uniform());
      }
    handles::check(mlcp_problem_row_add(problem.get(), static_cast<std::int32_t>(columns.size()), columns.data(), values.data(),
                                        -random.uniform(0, 0.1), 0, HUGE_VAL, 0, 0, nullptr),
                   problem);
  }
  return problem;
}

struct Named {
  const char* name;
  Problem (*make)();
  bool canonical;  ///< its active rows are independent and strictly complementary, so that all starts and methods can agree
};

constexpr Named problems[] = {
    {"pile", [] { return scenes::pile(300); }, true},
    {"chain", [] { return scenes::chain(200, true, 1e6); }, true},
    {"rope", [] { return scenes::Scene::problem_of_step(scenes::Rope(150)); }, true},
    {"wall", [] { return scenes::wall(5, 5); }, false},
    {"tower", [] { return scenes::tower(10, 1e8); }, false},
    {"archipelago", archipelago, true},
};
constexpr mlcp_method methods[] = {MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_AUTO};

TEST(Golden, AnyNumberOfThreads) {
  for (const Named& named : problems) {
    const Problem problem = named.make();
    for (const mlcp_method method : methods) {
      const std::uint64_t one = hash_of(problem, {method, 1});
      for (const int threads : {2, 4, 7})
        EXPECT_EQ(hash_of(problem, {method, threads}), one) << named.name << ", " << mlcp_method_text(method) << ", " << threads << " threads";
    }
  }
}

TEST(Golden, CanonicalFromAnyStartByAnyMethod) {
  for (const Named& named : problems) {
    if (!named.canonical) continue;
    const Problem problem = named.make();
    const std::uint64_t cold = hash_of(problem, {MLCP_METHOD_SIMPLEX, 1, true});
    for (const mlcp_method method : methods)
      for (const bool warm : {false, true})
        EXPECT_EQ(hash_of(problem, {method, 1, true, warm}), cold) << named.name << ", " << mlcp_method_text(method) << (warm ? ", warm" : ", cold");
  }
}

/// "problem method canonical" -> hash
std::map<std::string, std::uint64_t> results() {
  std::map<std::string, std::uint64_t> all;
  for (const Named& named : problems) {
    const Problem problem = named.make();
    for (const mlcp_method method : methods)
      for (const bool canonical : {false, true})
        all[std::string(named.name) + ' ' + mlcp_method_text(method) + (canonical ? " canonical" : " plain")] =
            hash_of(problem, {method, 1, canonical});
  }
  return all;
}

TEST(Golden, SameBitsAsWhenTheyWereWrittenDown) {
  const std::map<std::string, std::uint64_t> now = results();
  if (std::getenv("MLCP_WRITE_GOLDEN")) {
    std::ofstream file(MLCP_GOLDEN_FILE);
    for (const auto& [name, hash] : now) file << name << ' ' << std::hex << hash << std::dec << '\n';
    return;
  }
  std::ifstream file(MLCP_GOLDEN_FILE);
  std::string problem, method, canonical;
  std::uint64_t hash = 0;
  std::size_t count = 0;
  while (file >> problem >> method >> canonical >> std::hex >> hash >> std::dec) {
    const auto found = now.find(problem + ' ' + method + ' ' + canonical);
    ASSERT_NE(found, now.end()) << problem;
    EXPECT_EQ(found->second, hash) << found->first;
    ++count;
  }
  EXPECT_EQ(count, now.size()) << MLCP_GOLDEN_FILE;
}

}  // namespace
}  // namespace golden
