#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "mlcp.h"

namespace cli {

/// How many rows are independent: the numerical rank of J M⁻¹ Jᵀ + Σ, which is that of [J Σ], for both terms are semidefinite; J
/// without the columns of given velocities.
/// `island` gives every row its island (−1: leave it out), `islands` their number. Dense Gram-Schmidt on rows of unit length, the
/// longest remainder first, until none is longer than 1e-9. Nothing if that would take more than some seconds.
std::optional<std::int32_t> independent_rows(const mlcp_problem* problem, std::span<const std::int32_t> island,
                                             std::int32_t islands);

}  // namespace cli
