#pragma once
#include <cstdint>
#include <span>

#include "memory/array.h"
#include "memory/error.h"

namespace mlcp {

/// Replaces the file as a whole or not at all: a new file beside it, flushed to the disk, renamed.
/// fails: Error (IO), bad_alloc; the old file is as it was and no other is left.
void write_file(const Memory& memory, const char* path, std::span<const std::uint8_t> bytes);

/// The same where there is no file of that name yet.  false: there is one, which stays.
bool write_new_file(const Memory& memory, const char* path, std::span<const std::uint8_t> bytes);

/// A file that is open for reading. Only regular files: their size justifies the memory.
class InputFile {
 public:
  explicit InputFile(const char* path);  ///< `path` must stay. fails: Error (IO)
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// Fills `out` from where the last read ended. fails: Error (IO).
  void read(std::span<std::uint8_t> out);

 private:
  const char* path_;
  int file_;
  std::uint64_t size_ = 0;
};

}  // namespace mlcp
