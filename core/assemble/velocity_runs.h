#pragma once
#include "memory/array.h"

namespace mlcp {

/// Ascending velocities as runs, which loops take as vectors.
class VelocityRuns {
 public:
  struct Run {
    std::int32_t first, last;  ///< first .. last − 1
  };
  explicit VelocityRuns(const Memory& m) : runs_(m) {}

  void clear() { runs_.clear(); }
  /// before: first is behind all that is there.
  void add(std::int32_t first, std::int32_t last) {
    if (!runs_.empty() && runs_.back().last == first)
      runs_.back().last = last;
    else
      runs_.push_back({first, last});
  }
  bool empty() const { return runs_.empty(); }
  std::span<const Run> span() const { return runs_.span(); }

 private:
  Array<Run> runs_;
};

}  // namespace mlcp
