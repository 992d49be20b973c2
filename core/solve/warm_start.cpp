#include "solve/warm_start.h"

#include <algorithm>

namespace mlcp {

const Mask* WarmStart::find(const Problem& problem, const Mask& previous) {
  const auto keyed = [](const Array<std::uint64_t>& keys) { return std::any_of(keys.begin(), keys.end(), [](std::uint64_t k) { return k != 0; }); };
  forget();
  if (!keyed(problem.key) || !keyed(previous.key)) return nullptr;
  mask_carry(mask_, problem, previous, MLCP_ROW_AT_LOWER, carry_);
  return &mask_;
}

}  // namespace mlcp
