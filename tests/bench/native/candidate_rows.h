#pragma once
#include <cstdint>

#include "mlcp.h"

namespace bench {

struct CandidateRows {
  double masked, alone;  // seconds of the same solve
};

/// What rows cost that are there but not enabled: every stride-th row of `problem` enabled by a mask, against a problem that has only
/// those rows. Medians in turns of mlcp_solve; known: the pattern was analyzed before, else the solver is new.
CandidateRows candidate_rows(const mlcp_problem* problem, std::int32_t stride, bool known, const mlcp_settings& settings, int turns);

}  // namespace bench
