#pragma once
#include <cstdint>
#include <vector>

#include "mlcp.h"

namespace cli {

/// Which velocities of a problem are to be found and which are given.
struct Velocities {
  std::int32_t prescribed_bodies = 0;
  std::int32_t dynamic = 0;             // how many are to be found
  std::vector<std::int32_t> new_index;  // among those; −1: given
  std::vector<double> given;            // 0 where new_index ≥ 0
};

Velocities velocities_of(const mlcp_problem* problem);

}  // namespace cli
