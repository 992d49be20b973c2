#include "snapshot_source.h"

using namespace mlcp;

namespace {

/// Destroys what a load has made when a later part of it fails.
template <class Handle, void (*destroy)(Handle*)>
struct Owner {
  Handle* handle = nullptr;
  ~Owner() { destroy(handle); }
  void give(Handle** to) {
    if (to) *to = handle;
    if (to) handle = nullptr;
  }
};

void check_bytes(const void* bytes, size_t size) {
  if (size > 0) require(bytes, "bytes");
}

mlcp_mask* make_mask(const Memory& memory, Mask& from) {
  mlcp_mask* handle = make_handle<mlcp_mask>(memory, memory);
  handle->mask.swap(from);
  return handle;
}

struct Outputs {
  mlcp_problem** problem;
  mlcp_solver** solver;
  mlcp_mask **enabled, **start;

  void clear() const {
    if (problem) *problem = nullptr;
    if (solver) *solver = nullptr;
    if (enabled) *enabled = nullptr;
    if (start) *start = nullptr;
  }
};

void make_objects(const Memory& memory, Snapshot& snapshot, const Outputs& out) {
  Owner<mlcp_problem, mlcp_problem_destroy> problem;
  Owner<mlcp_solver, mlcp_solver_destroy> solver;
  Owner<mlcp_mask, mlcp_mask_destroy> enabled, start;
  if (out.solver) {
    solver.handle = make_handle<mlcp_solver>(memory, snapshot.settings, memory);
    if (!snapshot.ordering.empty()) solver.handle->solver.impose_ordering(snapshot.ordering.span());
  }
  if (out.enabled && snapshot.has_enabled) enabled.handle = make_mask(memory, snapshot.enabled);
  if (out.start && snapshot.has_start) start.handle = make_mask(memory, snapshot.start);
  if (out.problem) {
    problem.handle = make_handle<mlcp_problem>(memory, memory);
    problem.handle->problem = std::move(snapshot.problem);
  }
  problem.give(out.problem);
  solver.give(out.solver);
  enabled.give(out.enabled);
  start.give(out.start);
}

}  // namespace

mlcp_status mlcp_snapshot_save(const char* path, const mlcp_problem* problem, const mlcp_solver* solver, const mlcp_mask* enabled,
                               const mlcp_mask* start, char* message, size_t message_size) {
  return tell(message, message_size, [&] {
    require(path, "path");
    require(problem, "problem");
    const Settings defaults = default_settings();
    const Problem& p = problem->problem;
    snapshot_save(p.memory, path, source_of(p, solver, defaults, enabled, start));
  });
}

mlcp_status mlcp_snapshot_write(const mlcp_problem* problem, const mlcp_solver* solver, const mlcp_mask* enabled,
                                const mlcp_mask* start, size_t capacity, void* buffer, size_t* size, char* message,
                                size_t message_size) {
  return tell(message, message_size, [&] {
    require(problem, "problem");
    require(size, "size");
    const Settings defaults = default_settings();
    const Problem& p = problem->problem;
    Array<uint8_t> bytes(p.memory);
    snapshot_write(source_of(p, solver, defaults, enabled, start), bytes);
    *size = bytes.size();
    if (!buffer) return;
    if (capacity < bytes.size()) throw Error(MLCP_ERROR_RANGE, "capacity = %zu, but %zu are needed", capacity, bytes.size());
    std::memcpy(buffer, bytes.data(), bytes.size());
  });
}

mlcp_status mlcp_snapshot_load(const char* path, const mlcp_allocator* allocator, mlcp_problem** problem, mlcp_solver** solver,
                               mlcp_mask** enabled, mlcp_mask** start, char* message, size_t message_size) {
  const Outputs out{problem, solver, enabled, start};
  out.clear();
  return tell(message, message_size, [&] {
    require(path, "path");
    const Memory memory = memory_of(allocator);
    Snapshot snapshot(memory);
    snapshot_load(memory, path, snapshot);
    make_objects(memory, snapshot, out);
  });
}

mlcp_status mlcp_snapshot_read(const void* bytes, size_t size, const mlcp_allocator* allocator, mlcp_problem** problem,
                               mlcp_solver** solver, mlcp_mask** enabled, mlcp_mask** start, char* message,
                               size_t message_size) {
  const Outputs out{problem, solver, enabled, start};
  out.clear();
  return tell(message, message_size, [&] {
    check_bytes(bytes, size);
    const Memory memory = memory_of(allocator);
    Snapshot snapshot(memory);
    snapshot_read(memory, {static_cast<const uint8_t*>(bytes), size}, snapshot);
    make_objects(memory, snapshot, out);
  });
}
