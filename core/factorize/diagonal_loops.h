#pragma once
/// The loops of Kernels for diagonal masses, which most velocities of a scene may have. Compiled as kernel_loops.h is.
#include "factorize/kernel_loops.h"

namespace mlcp {
namespace {

/// Every lane: not 0 for yes.
typedef std::int64_t FourFlags __attribute__((vector_size(32)));

inline void take_sizes(const Four& f, Four& to) { to = reinterpret_cast<Four>(reinterpret_cast<FourFlags>(f) & INT64_MAX); }
inline bool any(const FourFlags& f) { return (f[0] | f[1] | f[2] | f[3]) != 0; }

bool diagonal_solve(std::int64_t count, const double* d, const double* k, double* x) {
  FourFlags wrong{};
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const Four di = *reinterpret_cast<const Four*>(d + i), ki = *reinterpret_cast<const Four*>(k + i);
    const FourFlags positive = di > 0;
    wrong |= ~positive;
    *reinterpret_cast<Four*>(x + i) = reinterpret_cast<Four>(reinterpret_cast<FourFlags>(ki / di) & positive);
  }
  bool all = !any(wrong);
  for (; i < count; ++i) {
    const bool positive = d[i] > 0;
    x[i] = positive ? k[i] / d[i] : 0;
    all &= positive;
  }
  return all;
}

bool diagonal_within(std::int64_t count, const double* d, const double* x, const double* k, double bound, double* largest) {
  const Four limit = Four{} + __builtin_inf();
  Four most = Four{} + *largest;
  FourFlags beyond{};
  const auto look = [&](const Four& di, const Four& xi, const Four& ki) {
    const Four term = di * xi;
    Four off, size, more;
    take_sizes(term - ki, off);
    take_sizes(term, size);
    take_sizes(ki, more);
    size += more;
    most = off > most ? off : most;
    beyond |= ~((off <= bound * size) & (size < limit));
  };
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4) look(*reinterpret_cast<const Four*>(d + i), *reinterpret_cast<const Four*>(x + i), *reinterpret_cast<const Four*>(k + i));
  if (i < count) {
    Four di, xi, ki;
    load_part(d + i, count - i, di);
    load_part(x + i, count - i, xi);
    load_part(k + i, count - i, ki);
    look(di, xi, ki);
  }
  for (int lane = 0; lane < 4; ++lane) *largest = most[lane] > *largest ? most[lane] : *largest;
  return !any(beyond);
}

}  // namespace
}  // namespace mlcp
