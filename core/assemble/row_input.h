#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "assemble/problem.h"

namespace mlcp {

/// Numbers of either precision in the caller's memory, groups of `group` of them `stride` bytes apart, packed within a group; where there
/// are none, one value for all.
struct Numbers {
  const void* data = nullptr;
  std::ptrdiff_t stride = 0;
  bool single = false;
  double otherwise = 0;
  std::int32_t group = 1;

  std::ptrdiff_t size() const { return single ? sizeof(float) : sizeof(double); }
  double operator[](std::int64_t i) const {
    if (!data) return otherwise;
    const char* at = static_cast<const char*>(data) + (group == 1 ? i * stride : i / group * stride + i % group * size());
    if (single) {
      float x;
      std::memcpy(&x, at, sizeof x);
      return x;
    }
    double x;
    std::memcpy(&x, at, sizeof x);
    return x;
  }
};

/// stride 0: packed.
template <class T>
Numbers numbers(const T* data, double otherwise, std::ptrdiff_t stride = 0, std::int32_t group = 1) {
  return {data, stride ? stride : group * std::ptrdiff_t(sizeof(T)), sizeof(T) == sizeof(float), otherwise, group};
}

/// Integers `stride` bytes apart, each for `group` indices.
template <class T>
struct Integers {
  const T* data = nullptr;
  std::ptrdiff_t stride = 0;
  T otherwise = 0;
  std::int32_t group = 1;

  T operator[](std::int64_t i) const {
    if (!data) return otherwise;
    T x;
    std::memcpy(&x, reinterpret_cast<const char*>(data) + (group == 1 ? i : i / group) * stride, sizeof x);
    return x;
  }
};
/// stride 0: packed.
template <class T>
Integers<T> integers(const T* data, T otherwise, std::ptrdiff_t stride = 0, std::int32_t group = 1) {
  return {data, stride ? stride : std::ptrdiff_t(sizeof(T)), otherwise, group};
}

/// What every row brings besides its entries of J.
struct RowFields {
  Numbers r, lo, hi, compliance;
  Integers<std::uint64_t> key;
};

/// r, bounds and compliance of row i of the call.
void check_fields(const RowFields& fields, std::int64_t i, bool has_entries);

/// Room for that many more rows and entries of J. fails: Error (RANGE), bad_alloc; nothing changed.
void reserve_rows(Problem& problem, std::int64_t rows, std::int64_t entries);

/// Appends everything but the entries of J. before: checked and reserved.
void append_fields(Problem& problem, const RowFields& fields, std::int32_t count);

}  // namespace mlcp
