#pragma once
#include <vector>

#include "assemble/velocity_runs.h"

namespace support {

inline std::vector<std::int32_t> list(const mlcp::VelocityRuns& runs) {
  std::vector<std::int32_t> all;
  for (const auto [first, last] : runs.span())
    for (std::int32_t j = first; j < last; ++j) all.push_back(j);
  return all;
}

}  // namespace support
