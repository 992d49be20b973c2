#include "analyze/separator.h"

#if defined(MLCP_WITH_METIS)
#include <metis.h>

#include <mutex>
#endif

namespace mlcp {

#if defined(MLCP_WITH_METIS)

static_assert(sizeof(idx_t) == sizeof(std::int32_t), "METIS with 32-bit indices, as distributions have it");

/// Adjacency of the members among themselves, every neighbour once.
void Separator::expand(const QuotientGraph& g, std::span<const std::int32_t> members) {
  const auto count = static_cast<std::int32_t>(members.size());
  if (static_cast<std::int32_t>(local_.size()) != g.variables) local_.assign(g.variables, -1);
  seen_.assign(count, -1);
  for (std::int32_t i = 0; i < count; ++i) local_[members[i]] = i;
  pointers_.assign(1, 0);
  neighbours_.clear();
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t x = members[i];
    const auto visit = [&](std::int32_t y) {
      const std::int32_t k = local_[y];
      if (k < 0 || k == i || seen_[k] == i) return;
      seen_[k] = i;
      neighbours_.push_back(k);
    };
    for (std::int32_t t = g.variable_pointers[x]; t < g.variable_pointers[x + 1]; ++t)
      for (std::int32_t e = g.variable_elements[t], s = g.element_pointers[e]; s < g.element_pointers[e + 1]; ++s) visit(g.element_variables[s]);
    for (std::int32_t t = g.neighbour_pointers[x]; t < g.neighbour_pointers[x + 1]; ++t) visit(g.neighbours[t]);
    pointers_.push_back(static_cast<std::int32_t>(neighbours_.size()));
  }
  for (const std::int32_t x : members) local_[x] = -1;
}

bool Separator::available() { return true; }

bool Separator::find(const QuotientGraph& g, std::span<const std::int32_t> members) {
  expand(g, members);
  part.resize(members.size());
  idx_t count = static_cast<idx_t>(members.size()), separator = 0, options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  static std::mutex one_at_a_time;  // rand() has one state
  const std::lock_guard lock(one_at_a_time);
  const int status = METIS_ComputeVertexSeparator(&count, pointers_.data(), neighbours_.data(), nullptr, options, &separator, part.data());
  return status == METIS_OK && separator > 0 && separator < count;
}

#else

bool Separator::available() { return false; }

bool Separator::find(const QuotientGraph&, std::span<const std::int32_t>) { return false; }

#endif

}  // namespace mlcp
