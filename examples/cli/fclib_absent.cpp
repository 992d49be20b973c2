#include "fclib_file.h"

namespace cli {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path) {
  throw std::runtime_error(path.string() + ": this program was built without FCLIB (MLCP_WITH_FCLIB)");
}

}  // namespace

ProblemFile read_fclib(const std::filesystem::path& path, const Friction&) { refuse(path); }
void write_fclib(const std::filesystem::path& path, const handles::Problem&) { refuse(path); }

}  // namespace cli
