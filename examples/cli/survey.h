#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mlcp.h"

namespace cli {

/// Smallest and largest of some sizes; empty while largest < smallest.
struct Range {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  void take(double size);
};

/// What can be said of a problem by looking, without solving it. But for the numbers of entries, given velocities are left out.
struct Survey {
  std::int32_t velocities = 0, bodies = 0, prescribed_bodies = 0, rows = 0;
  std::int32_t bilateral = 0, unilateral = 0, boxed = 0, fixed = 0;  // fixed: lo = hi
  std::int64_t mass_entries = 0, jacobian_entries = 0, compliance_entries = 0, explicit_zeros = 0;
  Range mass;       // Mⱼⱼ
  Range row;        // |Jᵢ|
  Range scale;      // aᵢ = Σⱼ Jᵢⱼ²/Mⱼⱼ + Σᵢᵢ
  Range momentum, right_hand_side;
  std::int32_t soft_rows = 0;             // Σᵢᵢ ≠ 0
  std::int32_t velocities_alone = 0;      // no row and no other velocity has them
  std::int32_t massless = 0;              // velocities with Mⱼⱼ ≤ 0
  std::vector<std::int32_t> zero_rows;    // neither an entry ≠ 0 of J nor compliance
  std::vector<std::int32_t> parallel_rows;  // the same entries of J as an earlier row, up to a factor
};

Survey survey(const mlcp_problem* problem);

}  // namespace cli
