#pragma once
#include <string>

namespace cli {

/// Prints what a problem is made of to standard output, as text or JSON. Solves it to find islands and redundant rows. Throws
/// std::exception for bad input.
void run_info(const std::string& path, const std::string& output);

}  // namespace cli
