#include "report/failure_folder.h"

#include <cstdlib>

#include "report/file.h"

namespace mlcp {

namespace {

constexpr const char* folder_variable = "MLCP_FAILURES";
constexpr const char* limit_variable = "MLCP_FAILURES_LIMIT";
constexpr std::int32_t usual_limit = 10, most_files = 10000;  ///< four digits
constexpr std::size_t name_size = sizeof "/failure-0000.mlcp";

/// Not in programs with more rights than their caller.
const char* environment(const char* name) {
#if defined(__linux__)
  return secure_getenv(name);
#else
  return std::getenv(name);
#endif
}

/// The usual one where there is none that is legal: nobody could be told.
std::int32_t limit_of(const char* text) {
  if (!text) return usual_limit;
  char* end = nullptr;
  const long limit = std::strtol(text, &end, 10);
  return end != text && *end == '\0' && limit >= 0 && limit <= most_files ? static_cast<std::int32_t>(limit) : usual_limit;
}

}  // namespace

FailureFolder::FailureFolder(const Memory& memory) : memory_(memory), folder_(memory), path_(memory) {
  const char* folder = environment(folder_variable);
  if (folder && *folder) set(folder, limit_of(environment(limit_variable)));
}

void FailureFolder::set(const char* folder, std::int32_t limit) {
  if (limit < 0 || limit > most_files) throw Error(MLCP_ERROR_ARGUMENT, "limit = %d is not in 0 .. %d", limit, most_files);
  const std::size_t length = folder ? std::strlen(folder) : 0;
  if (folder && length == 0) throw Error(MLCP_ERROR_ARGUMENT, "folder is empty");
  path_.reserve(length + name_size);
  folder_.assign(std::span<const char>(folder, folder ? length + 1 : 0));
  limit_ = folder ? limit : 0;
  next_ = 0;
  kept_ = false;
}

void FailureFolder::keep(const SnapshotSource& source) noexcept {
  kept_ = false;
  try {
    Array<std::uint8_t> bytes(memory_);
    snapshot_write(source, bytes);
    path_.resize(folder_.size() + name_size);
    while (!full() && !kept_) {
      std::snprintf(path_.data(), path_.size(), "%s/failure-%04d.mlcp", folder_.data(), next_);
      kept_ = write_new_file(memory_, path_.data(), bytes.span());
      ++next_;
    }
  } catch (const Error&) {
  } catch (const std::bad_alloc&) {
  }
}

}  // namespace mlcp
