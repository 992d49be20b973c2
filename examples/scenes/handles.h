#pragma once
#include <memory>
#include <stdexcept>
#include <string>

#include "mlcp.h"

/// Owners of the handles of the C ABI. A call that fails throws std::runtime_error with the library's own text.
namespace handles {

struct Destroy {
  void operator()(mlcp_problem* problem) const { mlcp_problem_destroy(problem); }
  void operator()(mlcp_mask* mask) const { mlcp_mask_destroy(mask); }
  void operator()(mlcp_solver* solver) const { mlcp_solver_destroy(solver); }
};

using Problem = std::unique_ptr<mlcp_problem, Destroy>;
using Mask = std::unique_ptr<mlcp_mask, Destroy>;
using Solver = std::unique_ptr<mlcp_solver, Destroy>;

inline void check(mlcp_status status, const char* text = "") {
  if (status != MLCP_OK) throw std::runtime_error(*text ? text : mlcp_status_text(status));
}
inline void check(mlcp_status status, const Problem& problem) { check(status, mlcp_problem_error(problem.get())); }
inline void check(mlcp_status status, const Mask& mask) { check(status, mlcp_mask_error(mask.get())); }
inline void check(mlcp_status status, const Solver& solver) { check(status, mlcp_solver_error(solver.get())); }

inline Problem make_problem() {
  mlcp_problem* problem = nullptr;
  check(mlcp_problem_create(nullptr, &problem));
  return Problem(problem);
}

inline Problem clone(const Problem& problem) {
  mlcp_problem* copy = nullptr;
  check(mlcp_problem_clone(problem.get(), &copy));
  return Problem(copy);
}

inline Mask make_mask(std::int32_t rows = 0, mlcp_row_state state = MLCP_ROW_AT_LOWER) {
  mlcp_mask* mask = nullptr;
  check(mlcp_mask_create(nullptr, rows, state, &mask));
  return Mask(mask);
}

inline Solver make_solver(const mlcp_settings* settings = nullptr) {
  mlcp_solver* solver = nullptr;
  check(mlcp_solver_create(settings, nullptr, &solver));
  return Solver(solver);
}

}  // namespace handles
