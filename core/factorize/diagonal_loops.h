#pragma once
/// The loops of Kernels for diagonal masses, which most velocities of a scene may have. Compiled as kernel_loops.h is.
#include "factorize/kernel_loops.h"

namespace mlcp {
namespace {

/// Every lane: not 0 for yes.
typedef std::int64_t FourFlags __attribute__((vector_size(32)));

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
  const double limit = __builtin_inf();
  Four most = Four{} + *largest;
  FourFlags beyond{};
  std::int64_t i = 0;
  for (; i + 4 <= count; i += 4) {
    const Four ki = *reinterpret_cast<const Four*>(k + i), term = *reinterpret_cast<const Four*>(d + i) * *reinterpret_cast<const Four*>(x + i);
    const Four rest = term - ki, off = rest < 0 ? -rest : rest, size = (term < 0 ? -term : term) + (ki < 0 ? -ki : ki);
    most = off > most ? off : most;
    beyond |= ~((off <= bound * size) & (size < limit));
  }
  bool within = !any(beyond);
  for (int lane = 0; lane < 4; ++lane) *largest = most[lane] > *largest ? most[lane] : *largest;
  for (; i < count; ++i) {
    const double term = d[i] * x[i], off = size_of(term - k[i]), size = size_of(term) + size_of(k[i]);
    *largest = off > *largest ? off : *largest;
    within &= (off <= bound * size) & (size < limit);
  }
  return within;
}

}  // namespace
}  // namespace mlcp
