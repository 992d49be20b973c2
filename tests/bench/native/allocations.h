#pragma once
#include <cstdint>

#include "mlcp.h"

namespace bench {

/// Calls of the allocator hooks, of problem and solver together, while a step on a known pattern is written and solved.
std::int64_t allocations_of_known_step(const mlcp_problem* problem, const mlcp_settings& settings);

}  // namespace bench
