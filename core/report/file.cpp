#include "report/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mlcp {

namespace {

constexpr int attempts = 1000;

[[noreturn]] void fail(const char* what, const char* path, int code) {
  throw Error(MLCP_ERROR_IO, "%s \"%.240s\": %.60s", what, path, std::strerror(code));
}

/// A new file with a name of its own beside `path`; removed unless it took the place of the target.
class TemporaryFile {
 public:
  TemporaryFile(const Memory& memory, const char* path) : target_(path), name_(memory) {
    const std::size_t room = std::strlen(path) + 48;
    name_.resize(room);
    for (int i = 0; i < attempts && file_ < 0; ++i) {
      std::snprintf(name_.data(), room, "%s.%ld-%d.tmp", path, static_cast<long>(getpid()), i);
      file_ = open(name_.data(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) break;
    }
    if (file_ < 0) fail("cannot create a file beside", path, errno);
  }
  ~TemporaryFile() {
    if (file_ >= 0) close(file_);
    if (!moved_) unlink(name_.data());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail("cannot write", target_, written < 0 ? errno : ENOSPC);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }
  void take_place() {
    finish();
    if (rename(name_.data(), target_) != 0) fail("cannot replace", target_, errno);
    moved_ = true;
  }
  /// false: the place is taken.
  bool take_free_place() {
    finish();
    if (link(name_.data(), target_) == 0) return true;
    if (errno != EEXIST) fail("cannot create", target_, errno);
    return false;
  }

 private:
  void finish() {
    if (fsync(file_) != 0) fail("cannot flush", target_, errno);
    const int closed = close(file_);
    file_ = -1;
    if (closed != 0) fail("cannot close", target_, errno);
  }

  const char* target_;
  Array<char> name_;
  int file_ = -1;
  bool moved_ = false;
};

/// The rename itself reaches the disk; a folder that cannot be flushed loses at most that.
void flush_folder(const Memory& memory, const char* path) {
  const char* slash = std::strrchr(path, '/');
  Array<char> folder(memory);
  folder.reserve(std::strlen(path) + 2);
  if (!slash) folder.push_back('.');
  for (const char* c = path; slash && c <= slash; ++c) folder.push_back(*c);
  folder.push_back('\0');
  const int file = open(folder.data(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  static_cast<void>(fsync(file));
  close(file);
}

}  // namespace

void write_file(const Memory& memory, const char* path, std::span<const std::uint8_t> bytes) {
  TemporaryFile file(memory, path);
  file.write(bytes);
  file.take_place();
  try {
    flush_folder(memory, path);
  } catch (const std::bad_alloc&) {
    // the file is complete and in place
  }
}

bool write_new_file(const Memory& memory, const char* path, std::span<const std::uint8_t> bytes) {
  if (access(path, F_OK) == 0) return false;
  TemporaryFile file(memory, path);
  file.write(bytes);
  return file.take_free_place();
}

InputFile::InputFile(const char* path) : path_(path), file_(open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (file_ < 0) fail("cannot open", path, errno);
  struct stat status;
  const bool known = fstat(file_, &status) == 0;
  const int code = known ? EINVAL : errno;
  if (!known || !S_ISREG(status.st_mode)) {
    close(file_);
    fail("not a regular file:", path, code);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { close(file_); }

void InputFile::read(std::span<std::uint8_t> out) {
  while (!out.empty()) {
    const ssize_t taken = ::read(file_, out.data(), out.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) fail("cannot read", path_, errno);
    if (taken == 0) throw Error(MLCP_ERROR_IO, "\"%.240s\" became shorter while it was read", path_);
    out = out.subspan(static_cast<std::size_t>(taken));
  }
}

}  // namespace mlcp
