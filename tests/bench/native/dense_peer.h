#pragma once
#include <cstdint>

/// What every peer that is a C++ library exports, each as a shared library of its own: the reduced problem
///
///     w = A γ + b,   lo ≤ γ ≤ hi,   wᵢ > 0 ⇒ γᵢ = lo,   wᵢ < 0 ⇒ γᵢ = hi
///
/// A: m × m dense, symmetric. seconds: the peer's own solve alone, wall clock; copies into its layout are left out. Returns 0 if it
/// says that it succeeded. Rows with lo = −∞ and hi = ∞ come first, `bilateral` of them.
extern "C" __attribute__((visibility("default"))) std::int32_t bench_dense_solve(
    std::int32_t m, std::int32_t bilateral, const double* A, const double* b, const double* lo, const double* hi, double* gamma,
    double* seconds);
