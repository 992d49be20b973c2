#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "assemble/problem.h"

namespace mlcp {

/// Numbers of either precision, `stride` bytes apart in the caller's memory; where there are none, one value for all.
struct Numbers {
  const void* data = nullptr;
  std::ptrdiff_t stride = 0;
  bool single = false;
  double otherwise = 0;

  double operator[](std::int64_t i) const {
    if (!data) return otherwise;
    const char* at = static_cast<const char*>(data) + i * stride;
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

inline Numbers numbers(const double* data, double otherwise, std::ptrdiff_t stride = 0) {
  return {data, stride ? stride : std::ptrdiff_t(sizeof(double)), false, otherwise};
}
inline Numbers numbers(const float* data, double otherwise, std::ptrdiff_t stride = 0) {
  return {data, stride ? stride : std::ptrdiff_t(sizeof(float)), true, otherwise};
}

/// Integers `stride` bytes apart.
template <class T>
struct Integers {
  const T* data = nullptr;
  std::ptrdiff_t stride = 0;
  T otherwise = 0;

  T operator[](std::int64_t i) const {
    if (!data) return otherwise;
    T x;
    std::memcpy(&x, reinterpret_cast<const char*>(data) + i * stride, sizeof x);
    return x;
  }
};

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
