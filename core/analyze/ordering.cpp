#include "analyze/ordering.h"

namespace mlcp {

void Ordering::collect_free(const Problem& problem, const Selection& selection) {
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view();
  placed_.assign(problem.n() + problem.m(), 0);
  for (std::int32_t i = 0; i < problem.m(); ++i)
    if (selection.row[i])
      for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) placed_[jacobian.indices[t]] = 1;
  free_velocities.clear();
  for (std::int32_t j = 0; j < problem.n(); ++j) {
    const bool diagonal = mass.pointers[j + 1] - mass.pointers[j] == 1 && mass.indices[mass.pointers[j]] == j;
    const bool free = selection.velocity[j] && diagonal && !placed_[j];
    placed_[j] = free;
    if (free) free_velocities.add(j, j + 1);
  }
}

void Ordering::compute(const Problem& problem, const Selection& selection, const Crowding& crowding, const Poll& poll) {
  const std::int32_t n = problem.n();
  collect_free(problem, selection);
  graph_.build(problem, selection, crowding);
  dissection_.cut(graph_, poll);
  degree_.run(graph_, dissection_, poll);

  // velocities of each element, behind them rows of each variable
  const std::int32_t elements = graph_.elements, runs = elements + graph_.variables;
  member_pointers_.assign(runs + 1, 0);
  const auto for_each_member = [&](auto visit) {
    for (std::int32_t i = problem.m() - 1; i >= 0; --i)
      if (graph_.leader[i] >= 0) visit(elements + graph_.leader[i], n + i);
    for (std::int32_t j = n - 1; j >= 0; --j)
      if (graph_.element_of[j] >= 0) visit(graph_.element_of[j], j);
  };
  for_each_member([&](std::int32_t run, std::int32_t) { ++member_pointers_[run + 1]; });
  for (std::int32_t run = 0; run < runs; ++run) member_pointers_[run + 1] += member_pointers_[run];
  members_.resize(member_pointers_[runs]);
  for_each_member([&](std::int32_t run, std::int32_t node) { members_[--member_pointers_[run + 1]] = node; });

  order.clear();
  const auto place = [&](std::int32_t run) {
    // filled from behind: run is now at member_pointers_[run + 1] .. member_pointers_[run + 2]
    const std::int32_t end = run + 2 <= runs ? member_pointers_[run + 2] : static_cast<std::int32_t>(members_.size());
    for (std::int32_t t = member_pointers_[run + 1]; t < end; ++t) {
      if (placed_[members_[t]]) return;
      placed_[members_[t]] = 1;
      order.push_back(members_[t]);
    }
  };
  // rows of one velocity before all others: none comes between velocities that would be one run of columns
  for (std::int32_t x = 0; x < graph_.variables && graph_.node[x] < n; ++x) place(elements + x);
  for (const std::int32_t x : degree_.order) {
    for (std::int32_t t = graph_.variable_pointers[x]; t < graph_.variable_pointers[x + 1]; ++t) place(graph_.variable_elements[t]);
    place(elements + x);
    order.push_back(graph_.node[x]);
  }
  for (std::int32_t e = 0; e < elements; ++e) place(e);
}

void Ordering::carry(const Problem& problem, const Selection& selection, const Crowding& crowding, const KktPattern& last, const EliminationTree& tree, Poll poll) {
  const std::int32_t n = problem.n(), m = problem.m(), size = last.size(), known = std::min(n, last.n);
  const SparseView jacobian = problem.jacobian_view();
  collect_free(problem, selection);
  lineage_.build(tree.parent.span());

  // 2p: before position p; 2p + 1: after it; 2 size: at the end
  key_.assign(m, -1);
  member_pointers_.assign(2 * size + 2, 0);
  for (std::int32_t i = 0; i < m; ++i) {
    if (!selection.row[i]) continue;
    const bool crowded = crowding.crowded[n + i] != 0;
    std::int32_t at = -1;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
      const std::int32_t j = jacobian.indices[t], p = j < known && selection.velocity[j] ? last.position[j] : -1;
      if (p < 0) continue;
      at = at < 0 ? p : crowded ? std::min(at, p) : lineage_.meet(at, p);
      poll.spend(1);
    }
    key_[i] = at < 0 ? 2 * size : 2 * at + !crowded;
    ++member_pointers_[key_[i] + 1];
  }
  for (std::int32_t k = 0; k <= 2 * size; ++k) member_pointers_[k + 1] += member_pointers_[k];
  members_.resize(member_pointers_[2 * size + 1]);
  for (std::int32_t i = m - 1; i >= 0; --i)
    if (key_[i] >= 0) members_[--member_pointers_[key_[i] + 1]] = i;

  order.clear();
  const auto place = [&](std::int32_t node) {
    if (placed_[node] || !selection.has(node)) return;
    placed_[node] = 1;
    order.push_back(node);
  };
  // filled from behind: the rows of key k are now at member_pointers_[k + 1] .. member_pointers_[k + 2]
  const auto place_rows = [&](std::int32_t k) {
    const std::int32_t end = k < 2 * size ? member_pointers_[k + 2] : static_cast<std::int32_t>(members_.size());
    for (std::int32_t t = member_pointers_[k + 1]; t < end; ++t) {
      const std::int32_t i = members_[t];
      for (std::int32_t e = jacobian.pointers[i]; e < jacobian.pointers[i + 1] && !crowding.crowded[n + i]; ++e) place(jacobian.indices[e]);
      place(n + i);
    }
  };
  for (std::int32_t p = 0; p < size; ++p) {
    place_rows(2 * p);
    if (last.node[p] < known) place(last.node[p]);
    place_rows(2 * p + 1);
  }
  place_rows(2 * size);
  for (std::int32_t j = 0; j < n; ++j) place(j);
}

void Ordering::clear() {
  order.clear();
  free_velocities.clear();
}

bool Ordering::accept(const Problem& problem, const Selection& selection, const Crowding& crowding, std::span<const std::int32_t> imposed) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView jacobian = problem.jacobian_view();
  collect_free(problem, selection);
  std::size_t needed = 0;
  for (std::int32_t node = 0; node < n + m; ++node) needed += selection.has(node) && !placed_[node];
  if (imposed.size() != needed) return false;
  for (const std::int32_t node : imposed) {
    if (node < 0 || node >= n + m || !selection.has(node) || placed_[node]) return false;
    if (node >= n && !crowding.crowded[node])
      for (std::int32_t t = jacobian.pointers[node - n]; t < jacobian.pointers[node - n + 1]; ++t)
        if (const std::int32_t j = jacobian.indices[t]; selection.velocity[j] && !placed_[j]) return false;
    placed_[node] = 1;
  }
  order.assign(imposed);
  return true;
}

}  // namespace mlcp
