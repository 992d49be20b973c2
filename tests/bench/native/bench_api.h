#pragma once
#include <cstdint>

#include "mlcp.h"

/// What tests/bench/compare calls through ctypes. Functions return 0 or a handle, else −1 or NULL with the cause in bench_error().
/// Seconds are wall clock, measured here, around the calls of mlcp.h and nothing else. One thread at a time.
#define BENCH_API extern "C" __attribute__((visibility("default")))

BENCH_API const char* bench_error();

/// Problems; freed by mlcp_problem_destroy. What is read or recorded may have contacts: bench_plain is for what is compared.
BENCH_API mlcp_problem* bench_scene(const char* family, std::int32_t size);
BENCH_API mlcp_problem* bench_read(const char* path);
/// The problems of steps of a scene, see recorded.h; `steps` of them.
BENCH_API int bench_record(const char* scene, std::int32_t size, std::uint32_t seed, double h, std::int32_t first, std::int32_t steps,
                           mlcp_problem** problems);
/// Plain rows in place of contacts, see PlainRows.
BENCH_API mlcp_problem* bench_plain(const mlcp_problem* problem, std::int32_t facets);
/// Problems side by side.
BENCH_API mlcp_problem* bench_join(const mlcp_problem* const* problems, std::int32_t count);

/// The library on one problem. how: 0 cold, 1 known pattern. threads: of the library; ignored by a library without that setting.
struct bench_run;
BENCH_API bench_run* bench_run_create(const mlcp_problem* problem, std::int32_t method, double tolerance, std::int32_t threads);
BENCH_API void bench_run_destroy(bench_run* run);
BENCH_API int bench_run_time(bench_run* run, std::int32_t how, std::int32_t repeats, double* seconds);
BENCH_API int bench_run_result(const bench_run* run, double* v, double* gamma, std::int32_t* outcome, double* own_error);

/// A pass over `count` steps of a scene. The last four: `count` entries each; oracle may be NULL.
BENCH_API int bench_sequence(const mlcp_problem* const* steps, std::int32_t count, std::int32_t method, double tolerance, std::int32_t warm,
                             double* seconds, double* error, std::int32_t* outcome, double* oracle);

/// See candidate_rows.h and allocations.h.
BENCH_API int bench_candidate_rows(const mlcp_problem* problem, std::int32_t stride, std::int32_t known, std::int32_t turns, double* masked,
                                   double* alone);
BENCH_API std::int64_t bench_allocations(const mlcp_problem* problem, std::int32_t method);

/// One factorization and solve of the run's final active set: seconds of analysis and of the rest, `repeats` each.
BENCH_API int bench_oracle(const bench_run* run, std::int32_t repeats, double* analyze, double* factorize);

/// The reduced form. Freed by bench_dual_destroy; what it lends lives as long.
struct bench_dual;
BENCH_API bench_dual* bench_dual_create(const mlcp_problem* problem);
BENCH_API void bench_dual_destroy(bench_dual* dual);
BENCH_API int bench_dual_time(bench_dual* dual, std::int32_t repeats, double* analyze, double* form);
BENCH_API void bench_dual_view(const bench_dual* dual, std::int64_t* entries, const std::int32_t** pointers, const std::int32_t** indices,
                               const double** values, const double** b);
