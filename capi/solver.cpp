#include "assemble/validate.h"
#include "report/reaction.h"
#include "snapshot_source.h"
#include "structs.h"

using namespace mlcp;

namespace {

void check_masks(const Problem& problem, const mlcp_mask* enabled, const mlcp_mask* start) {
  if (enabled) check_length("rows of enabled", mlcp_mask_size(enabled), problem.m());
  if (start) check_length("rows of start", mlcp_mask_size(start), problem.m());
}

const Result& result_of(const mlcp_solver& handle) {
  const Result& result = handle.solver.result();
  if (!result.valid) throw Error(MLCP_ERROR_STATE, "there are no results before a solve");
  return result;
}

/// Looks at one array that a solve has left.
template <class T, class Get>
mlcp_status lend_array(const mlcp_solver* solver, const T** data, int32_t* count, Get get) {
  return look(solver, [&](const mlcp_solver& s) {
    require(data, "array");
    require(count, "count");
    result_of(s);
    const Array<T>& array = get(s.solver);
    *data = array.data();
    *count = static_cast<int32_t>(array.size());
  });
}

template <class T>
mlcp_status lend(const mlcp_solver* solver, const T** data, int32_t* count, Array<T> Result::*member) {
  return lend_array(solver, data, count, [&](const ContactSolver& s) -> const Array<T>& { return s.result().*member; });
}

void narrow(const Array<double>& from, const char* name, int32_t count, float* to, ptrdiff_t stride_bytes) {
  check_length("count", count, static_cast<int64_t>(from.size()));
  check_array(name, to, count);
  if (stride_bytes == 0) stride_bytes = sizeof(float);
  char* at = reinterpret_cast<char*>(to);
  for (int32_t i = 0; i < count; ++i) {
    const float value = static_cast<float>(from[i]);
    std::memcpy(at + i * stride_bytes, &value, sizeof value);
  }
}

}  // namespace

void mlcp_settings_init(mlcp_settings* settings, size_t struct_size) { init_struct(default_settings(), settings, struct_size); }

mlcp_status mlcp_solver_create(const mlcp_settings* settings, const mlcp_allocator* allocator, mlcp_solver** solver) {
  if (!solver) return MLCP_ERROR_NULL;
  *solver = nullptr;
  return guard(nullptr, [&] {
    const Settings wanted = settings ? import_struct("settings", settings, default_settings()) : default_settings();
    check_settings(wanted);
    const Memory memory = memory_of(allocator);
    *solver = make_handle<mlcp_solver>(memory, wanted, memory);
  });
}

void mlcp_solver_destroy(mlcp_solver* solver) {
  if (solver) free_handle(solver, solver->blocks.source());
}

mlcp_status mlcp_solver_set_settings(mlcp_solver* solver, const mlcp_settings* settings) {
  return edit(solver, [&](mlcp_solver& s) {
    const Settings wanted = import_struct("settings", settings, default_settings());
    check_settings(wanted);
    s.solver.set_settings(wanted);
  });
}

mlcp_status mlcp_solver_get_settings(const mlcp_solver* solver, mlcp_settings* settings) {
  return look(solver, [&](const mlcp_solver& s) {
    require(settings, "settings");
    check_struct_size<mlcp_settings>("settings", settings->struct_size);
    export_struct(s.solver.settings(), settings);
  });
}

const char* mlcp_solver_error(const mlcp_solver* solver) { return solver ? solver->error.text : ""; }

mlcp_status mlcp_solver_keep_failures(mlcp_solver* solver, const char* folder, int32_t limit) {
  return edit(solver, [&](mlcp_solver& s) { s.failures.set(folder, limit); });
}

const char* mlcp_solver_failure_file(const mlcp_solver* solver) { return solver ? solver->failures.file() : ""; }

mlcp_status mlcp_solver_trim(mlcp_solver* solver) {
  return edit(solver, [](mlcp_solver& s) {
    s.solver.trim();
    s.lent.mask.trim();
  });
}

void mlcp_report_init(mlcp_report* report, size_t struct_size) { init_struct(mlcp_report{}, report, struct_size); }

mlcp_status mlcp_analyze(mlcp_solver* solver, const mlcp_problem* problem, const mlcp_mask* enabled) {
  return edit(solver, [&](mlcp_solver& s) {
    require(problem, "problem");
    check_masks(problem->problem, enabled, nullptr);
    s.solver.analyze(problem->problem, mask_of(enabled));
  });
}

mlcp_status mlcp_solve(mlcp_solver* solver, const mlcp_problem* problem, const mlcp_mask* enabled, const mlcp_mask* start,
                       mlcp_report* report) {
  return edit(solver, [&](mlcp_solver& s) {
    require(problem, "problem");
    check_masks(problem->problem, enabled, start);
    if (report) check_struct_size<mlcp_report>("report", report->struct_size);
    mlcp_report full{};
    full.struct_size = sizeof full;
    // start may be the mask that this solver lends, so that changes only afterwards
    s.lent.mask.reserve(problem->problem.m());
    if (!problem->problem.contacts.empty() || !problem->problem.couplings.empty()) s.lent.mask.slip.reserve(problem->problem.m());
    s.failures.forget();
    try {
      s.solver.solve(problem->problem, mask_of(enabled), mask_of(start), full);
      if (full.outcome != MLCP_SOLVED && !s.failures.full())
        s.failures.keep(source_of(problem->problem, solver, s.solver.settings(), enabled, start));
    } catch (...) {
      s.solver.forget_result();
      throw;
    }
    const Mask& mask = s.solver.result().mask;
    s.lent.mask.state.assign(mask.state.span());
    s.lent.mask.key.assign(mask.key.span());
    s.lent.mask.impulse.assign(mask.impulse.span());
    s.lent.mask.slip.assign(mask.slip.span());
    if (report) export_struct(full, report);
  });
}

mlcp_status mlcp_solver_velocities(const mlcp_solver* solver, const double** v, int32_t* count) {
  return lend(solver, v, count, &Result::v);
}

mlcp_status mlcp_solver_impulses(const mlcp_solver* solver, const double** gamma, int32_t* count) {
  return lend(solver, gamma, count, &Result::gamma);
}

mlcp_status mlcp_solver_slacks(const mlcp_solver* solver, const double** w, int32_t* count) {
  return lend(solver, w, count, &Result::w);
}

mlcp_status mlcp_solver_mask(const mlcp_solver* solver, const mlcp_mask** mask) {
  return look(solver, [&](const mlcp_solver& s) {
    require(mask, "mask");
    result_of(s);
    *mask = &s.lent;
  });
}

mlcp_status mlcp_solver_redundant(const mlcp_solver* solver, const uint8_t** redundant, int32_t* count) {
  return lend(solver, redundant, count, &Result::redundant);
}

mlcp_status mlcp_solver_read_velocities_f32(const mlcp_solver* solver, int32_t count, float* v, ptrdiff_t stride_bytes) {
  return look(solver, [&](const mlcp_solver& s) { narrow(result_of(s).v, "v", count, v, stride_bytes); });
}

mlcp_status mlcp_solver_read_impulses_f32(const mlcp_solver* solver, int32_t count, float* gamma, ptrdiff_t stride_bytes) {
  return look(solver, [&](const mlcp_solver& s) { narrow(result_of(s).gamma, "gamma", count, gamma, stride_bytes); });
}

mlcp_status mlcp_solver_reaction(const mlcp_solver* solver, const mlcp_problem* problem, int32_t body, int32_t count,
                                 double* out) {
  return look(solver, [&](const mlcp_solver& s) {
    require(problem, "problem");
    check_count("count", count);
    check_array("reaction", out, count);
    reaction(problem->problem, result_of(s), body, {out, static_cast<size_t>(count)});
  });
}

mlcp_status mlcp_solver_row_islands(const mlcp_solver* solver, const int32_t** island, int32_t* count) {
  return lend(solver, island, count, &Result::row_island);
}

mlcp_status mlcp_solver_island_outcomes(const mlcp_solver* solver, const mlcp_outcome** outcome, int32_t* count) {
  return lend(solver, outcome, count, &Result::island_outcome);
}

mlcp_status mlcp_solver_contact_states(const mlcp_solver* solver, const mlcp_contact_state** state, int32_t* count) {
  return lend_array(solver, state, count, [](const ContactSolver& s) -> const auto& { return s.contact_states(); });
}

mlcp_status mlcp_solver_contact_facets(const mlcp_solver* solver, const int32_t** facets, int32_t* count) {
  return lend_array(solver, facets, count, [](const ContactSolver& s) -> const auto& { return s.contact_facets(); });
}

mlcp_status mlcp_solver_certificate(const mlcp_solver* solver, int32_t island, const int32_t** rows, const double** y,
                                    int32_t* count) {
  return look(solver, [&](const mlcp_solver& s) {
    require(rows, "rows");
    require(y, "y");
    require(count, "count");
    const Result& result = result_of(s);
    if (island < -1 || (island >= 0 && static_cast<size_t>(island) >= result.island_outcome.size()))
      throw Error(MLCP_ERROR_RANGE, "island = %d is out of range", island);
    for (const CertificateRange& certificate : result.certificates) {
      if (island >= 0 && certificate.island != island) continue;
      *rows = result.certificate_row.data() + certificate.first;
      *y = result.certificate_y.data() + certificate.first;
      *count = certificate.count;
      return;
    }
    throw Error(MLCP_ERROR_STATE, "there is no certificate");
  });
}

void mlcp_factor_view_init(mlcp_factor_view* view, size_t struct_size) { init_struct(mlcp_factor_view{}, view, struct_size); }

mlcp_status mlcp_solver_factor(const mlcp_solver* solver, mlcp_factor_view* factor) {
  return look(solver, [&](const mlcp_solver& s) {
    require(factor, "factor");
    check_struct_size<mlcp_factor_view>("factor", factor->struct_size);
    const Analysis& analysis = s.solver.analysis();
    const Symbolic& symbolic = analysis.symbolic;
    if (symbolic.pointers.empty()) throw Error(MLCP_ERROR_STATE, "nothing has been analyzed");
    export_struct({factor->struct_size, symbolic.size(), symbolic.entries(), analysis.pattern.node.data(), symbolic.pointers.data(),
                   symbolic.rows.data()},
                  factor);
  });
}

mlcp_status mlcp_solver_trace(const mlcp_solver* solver, const mlcp_pivot** pivots, int64_t* count) {
  return look(solver, [&](const mlcp_solver& s) {
    require(pivots, "pivots");
    require(count, "count");
    const Result& result = result_of(s);
    *pivots = result.trace.data();
    *count = static_cast<int64_t>(result.trace.size());
  });
}
