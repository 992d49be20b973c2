#pragma once
#include <filesystem>
#include <string>

namespace cli {

/// The whole file, unpacked if it is compressed by gzip. Throws std::runtime_error naming the file.
std::string read_text(const std::filesystem::path& path);

void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace cli
