#pragma once
#include <cstdint>

namespace mlcp {

/// L D Lᵀ of a dense symmetric block in place, columns of d: L below the diagonal, D on it; what is above is of no effect. No roots, so that units of
/// powers of two change no bit. For masses of bodies, too small to be worth a call to the kernels.     false: a pivot is not positive.
bool small_factor(std::int32_t d, double* block);
/// x := (L D Lᵀ)⁻¹ x
void small_solve(std::int32_t d, const double* block, double* x);

}  // namespace mlcp
