#pragma once
#include <cstdint>
#include <limits>

#include "memory/array.h"

namespace mlcp {

/// A set over 0 … size − 1 that empties in O(1).
class Marker {
 public:
  explicit Marker(const Memory& memory) : round_of_(memory) {}

  /// fails: bad_alloc, when it has never been that large.
  void start(std::size_t size) {
    if (round_of_.size() < size) round_of_.resize(size, 0);
    if (round_ == std::numeric_limits<std::int32_t>::max()) {
      round_of_.assign(round_of_.size(), 0);
      round_ = 0;
    }
    ++round_;
  }
  /// Room for later start(size).
  void reserve(std::size_t size) {
    if (round_of_.size() < size) round_of_.resize(size, 0);
  }
  /// false: i was in already.
  bool insert(std::int32_t i) {
    if (round_of_[i] == round_) return false;
    round_of_[i] = round_;
    return true;
  }
  bool contains(std::int32_t i) const { return round_of_[i] == round_; }
  void trim() {
    round_of_.clear();
    round_of_.trim();
  }

 private:
  Array<std::int32_t> round_of_;
  std::int32_t round_ = 0;
};

}  // namespace mlcp
