#pragma once
#include <string>

#include "support/build.h"
#include "support/solution.h"

namespace support {

/// What a failing random test leaves: a snapshot beside the program, and in the text its name and the whole problem.
std::string evidence(const std::string& name, std::uint64_t seed, const mlcp::Problem& problem, const mlcp::Settings& settings,
                     const mlcp::Mask* enabled = nullptr, const mlcp::Mask* start = nullptr);

}  // namespace support
