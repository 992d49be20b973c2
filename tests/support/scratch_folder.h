#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

namespace support {

/// A folder of this process alone, so that two runs of the tests on one machine do not meet; it goes with the process.
inline const std::filesystem::path& scratch_folder() {
  struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("mlcp_tests_" + std::to_string(getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

}  // namespace support
