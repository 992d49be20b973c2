#pragma once
#include "../scenes/handles.h"

namespace cli {

inline mlcp_matrix_view view_of(const mlcp_problem* problem, mlcp_status (*get)(const mlcp_problem*, mlcp_matrix_view*)) {
  mlcp_matrix_view view;
  mlcp_matrix_view_init(&view, sizeof view);
  handles::check(get(problem, &view));
  return view;
}

/// Visits all entries (i, j, value) of a matrix of `outer` compressed rows (or columns).
template <typename Visit>
void each_entry(const mlcp_matrix_view& view, std::int32_t outer, Visit visit) {
  for (std::int32_t i = 0; i < outer; ++i) {
    for (std::int32_t e = view.pointers[i]; e < view.pointers[i + 1]; ++e) visit(i, view.indices[e], view.values[e]);
  }
}

}  // namespace cli
