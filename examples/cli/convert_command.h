#pragma once
#include <string>

namespace cli {

/// Folder or snapshot to a snapshot if `to` ends in .mlcp, else to a folder. Throws std::exception for bad input.
void run_convert(const std::string& from, const std::string& to);

}  // namespace cli
