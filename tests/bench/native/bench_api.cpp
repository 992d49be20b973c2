#include "bench_api.h"

#include <string>
#include <vector>

#include "allocations.h"
#include "assembly.h"
#include "candidate_rows.h"
#include "cli/problem_file.h"
#include "clock.h"
#include "dual.h"
#include "library_run.h"
#include "oracle.h"
#include "recorded.h"
#include "scene_problem.h"
#include "sequence.h"

struct bench_run {
  bench::LibraryRun run;
};

struct bench_dual {
  bench::Dual dual;
};

namespace {

using handles::check;

thread_local std::string last_error;

/// Runs a call and keeps what it throws as text.
template <class Result, class Call>
Result guard(Result failed, Call call) {
  try {
    return call();
  } catch (const std::exception& error) {
    last_error = error.what();
    return failed;
  }
}

/// Settings may be older than some of their fields.
template <class Settings>
Settings settings_of(std::int32_t method, double tolerance = 1e-9, std::int32_t threads = 1) {
  Settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = method;
  settings.tolerance = tolerance;
  settings.num_threads = threads;
  return settings;
}

/// A known pattern is not a warm start.
mlcp_settings without_history(mlcp_settings settings) {
  settings.warm_start = 0;
  return settings;
}

}  // namespace

const char* bench_error() { return last_error.c_str(); }

mlcp_problem* bench_scene(const char* family, std::int32_t size) {
  return guard<mlcp_problem*>(nullptr, [&] { return bench::scene_problem(family, size).release(); });
}

mlcp_problem* bench_read(const char* path) {
  return guard<mlcp_problem*>(nullptr, [&] { return cli::read_problem(path).problem.release(); });
}

int bench_record(const char* scene, std::int32_t size, std::uint32_t seed, double h, std::int32_t first, std::int32_t steps,
                 mlcp_problem** problems) {
  return guard(-1, [&] {
    for (handles::Problem& problem : bench::record({scene, size, seed, h, first, steps})) *problems++ = problem.release();
    return 0;
  });
}

mlcp_problem* bench_plain(const mlcp_problem* problem, std::int32_t facets) {
  return guard<mlcp_problem*>(nullptr, [&] { return bench::plain(problem, facets).release(); });
}

mlcp_problem* bench_join(const mlcp_problem* const* problems, std::int32_t count) {
  return guard<mlcp_problem*>(nullptr, [&] {
    bench::Assembly all;
    for (std::int32_t i = 0; i < count; ++i) all.append(bench::Assembly(problems[i]), static_cast<std::uint64_t>(i));
    return all.build().release();
  });
}

bench_run* bench_run_create(const mlcp_problem* problem, std::int32_t method, double tolerance, std::int32_t threads) {
  return guard<bench_run*>(nullptr, [&] {
    return new bench_run{bench::LibraryRun(problem, without_history(settings_of<mlcp_settings>(method, tolerance, threads)))};
  });
}

void bench_run_destroy(bench_run* run) { delete run; }

int bench_run_time(bench_run* run, std::int32_t how, std::int32_t repeats, double* seconds) {
  return guard(-1, [&] {
    for (std::int32_t k = 0; k < repeats; ++k) seconds[k] = how == 0 ? run->run.cold() : run->run.known();
    return 0;
  });
}

int bench_run_result(const bench_run* run, double* v, double* gamma, std::int32_t* outcome, double* own_error) {
  return guard(-1, [&] {
    const double* values = nullptr;
    std::int32_t count = 0;
    check(mlcp_solver_velocities(run->run.solver(), &values, &count));
    std::copy(values, values + count, v);
    check(mlcp_solver_impulses(run->run.solver(), &values, &count));
    std::copy(values, values + count, gamma);
    *outcome = run->run.report().outcome;
    *own_error = run->run.report().largest_error;
    return 0;
  });
}

int bench_sequence(const mlcp_problem* const* steps, std::int32_t count, std::int32_t method, double tolerance, std::int32_t warm,
                   double* seconds, double* error, std::int32_t* outcome, double* oracle) {
  return guard(-1, [&] {
    const bench::Sequence sequence({steps, static_cast<std::size_t>(count)}, settings_of<mlcp_settings>(method, tolerance));
    for (const bench::Sequence::Step& step : sequence.run(warm != 0, oracle != nullptr)) {
      *seconds++ = step.seconds;
      *error++ = step.error;
      *outcome++ = step.outcome;
      if (oracle) *oracle++ = step.oracle;
    }
    return 0;
  });
}

int bench_candidate_rows(const mlcp_problem* problem, std::int32_t stride, std::int32_t known, std::int32_t turns, double* masked,
                         double* alone) {
  return guard(-1, [&] {
    const mlcp_settings settings = without_history(settings_of<mlcp_settings>(MLCP_METHOD_AUTO));
    const auto times = bench::candidate_rows(problem, stride, known != 0, settings, turns);
    *masked = times.masked;
    *alone = times.alone;
    return 0;
  });
}

std::int64_t bench_allocations(const mlcp_problem* problem, std::int32_t method) {
  return guard<std::int64_t>(
      -1, [&] { return bench::allocations_of_known_step(problem, without_history(settings_of<mlcp_settings>(method))); });
}

int bench_oracle(const bench_run* run, std::int32_t repeats, double* analyze, double* factorize) {
  return guard(-1, [&] {
    const mlcp_mask* mask = nullptr;
    check(mlcp_solver_mask(run->run.solver(), &mask));
    bench::Oracle oracle(run->run.problem(), mask);
    for (std::int32_t k = 0; k < repeats; ++k) {
      const double start = bench::wall_seconds();
      oracle.analyze();
      const double analyzed = bench::wall_seconds();
      oracle.factorize_and_solve();
      analyze[k] = analyzed - start;
      factorize[k] = bench::wall_seconds() - analyzed;
    }
    return 0;
  });
}

bench_dual* bench_dual_create(const mlcp_problem* problem) {
  return guard<bench_dual*>(nullptr, [&] { return new bench_dual{bench::Dual(problem)}; });
}

void bench_dual_destroy(bench_dual* dual) { delete dual; }

int bench_dual_time(bench_dual* dual, std::int32_t repeats, double* analyze, double* form) {
  return guard(-1, [&] {
    for (std::int32_t k = 0; k < repeats; ++k) {
      const double start = bench::wall_seconds();
      dual->dual.analyze();
      const double analyzed = bench::wall_seconds();
      dual->dual.form();
      analyze[k] = analyzed - start;
      form[k] = bench::wall_seconds() - analyzed;
    }
    return 0;
  });
}

void bench_dual_view(const bench_dual* dual, std::int64_t* entries, const std::int32_t** pointers, const std::int32_t** indices,
                     const double** values, const double** b) {
  *entries = dual->dual.A.nonZeros();
  *pointers = dual->dual.A.outerIndexPtr();
  *indices = dual->dual.A.innerIndexPtr();
  *values = dual->dual.A.valuePtr();
  *b = dual->dual.b.data();
}
