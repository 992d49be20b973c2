#pragma once
#include "report/snapshot.h"

namespace mlcp {

/// Where solves that fail leave snapshots: files failure-0000.mlcp, failure-0001.mlcp … in a folder, as many as a limit allows. What is
/// there already counts and is never replaced, also when several processes share the folder.
class FailureFolder {
 public:
  /// The folder and the limit that the environment names: MLCP_FAILURES, MLCP_FAILURES_LIMIT; none without them.
  /// fails: bad_alloc.
  explicit FailureFolder(const Memory& memory);

  /// NULL: none.      fails: Error (ARGUMENT), bad_alloc; nothing changed.
  void set(const char* folder, std::int32_t limit);
  bool full() const { return next_ >= limit_; }
  /// A disk or an allocator that fails leaves no file and is no failure of the solve.      before: not full.
  void keep(const SnapshotSource& source) noexcept;
  /// Of the file that the last call of keep left; "" if none, or since forget.
  const char* file() const { return kept_ ? path_.data() : ""; }
  void forget() { kept_ = false; }

 private:
  Memory memory_;
  Array<char> folder_, path_;
  std::int32_t limit_ = 0, next_ = 0;  ///< numbers below next_ are taken
  bool kept_ = false;
};

}  // namespace mlcp
