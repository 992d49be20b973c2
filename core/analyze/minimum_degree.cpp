#include "analyze/minimum_degree.h"

namespace mlcp {

/// Ids: variables 0 .. V−1, the graph's elements V .. V+E−1; an eliminated variable becomes an element under its own id.
void MinimumDegree::load(const QuotientGraph& g, const Dissection& d) {
  variables_ = g.variables;
  const std::int32_t total = g.variables + g.elements;
  kind_.assign(total, variable);
  start_.resize(total);
  length_.resize(total);
  element_count_.assign(total, 0);
  weight_.assign(g.weight.span());
  weight_.resize(total);
  left_ = 0;
  for (const std::int32_t weight : g.weight) left_ += weight;
  degree_.assign(total, 0);
  stamp_.assign(total, 0);
  pending_.assign(variables_, 0);
  head_.assign(left_ + 1, -1);
  next_.assign(variables_, -1);
  previous_.assign(variables_, -1);
  member_.assign(variables_, -1);
  tail_.resize(variables_);
  bucket_.assign(variables_, -1);
  hash_.assign(variables_, 0);
  const std::size_t entries = 2 * g.variable_elements.size() + g.neighbours.size();
  iw_.resize(entries + entries / 4 + variables_ + 64);
  free_ = 0;
  mark_ = 1;
  lowest_ = 0;
  order.clear();
  for (std::int32_t i = 0; i < variables_; ++i) {
    tail_[i] = i;
    start_[i] = static_cast<std::int32_t>(free_);
    for (std::int32_t t = g.variable_pointers[i]; t < g.variable_pointers[i + 1]; ++t) {
      const std::int32_t e = g.variable_elements[t];
      iw_[free_++] = variables_ + e;
      degree_[i] += g.element_pointers[e + 1] - g.element_pointers[e] - 1;
    }
    element_count_[i] = static_cast<std::int32_t>(free_) - start_[i];
    for (std::int32_t t = g.neighbour_pointers[i]; t < g.neighbour_pointers[i + 1]; ++t) {
      iw_[free_++] = g.neighbours[t];
      degree_[i] += g.weight[g.neighbours[t]];
    }
    length_[i] = static_cast<std::int32_t>(free_) - start_[i];
    degree_[i] = std::min(degree_[i], left_ - g.weight[i]);
  }
  for (std::int32_t e = 0; e < g.elements; ++e) {
    const std::int32_t id = variables_ + e;
    kind_[id] = element;
    start_[id] = static_cast<std::int32_t>(free_);
    length_[id] = degree_[id] = g.element_pointers[e + 1] - g.element_pointers[e];
    for (std::int32_t s = g.element_pointers[e]; s < g.element_pointers[e + 1]; ++s) iw_[free_++] = g.element_variables[s];
  }
  for (const std::int32_t row : g.own_rows) pending_[row] += g.waits[row];
  tree_.assign(d.below.span());
  tree_pointers_.assign(d.below.size() + 1, 0);
  for (const std::int32_t t : d.home) ++tree_pointers_[t + 1];
  for (std::size_t t = 0; t < d.below.size(); ++t) tree_pointers_[t + 1] += tree_pointers_[t];
  tree_variables_.resize(variables_);
  gone_.assign(tree_pointers_.span().first(d.below.size()));
  for (std::int32_t i = 0; i < variables_; ++i) {
    tree_variables_[gone_[d.home[i]]++] = i;
    if (d.below[d.home[i]]) ++pending_[i];
  }
  for (std::int32_t i = variables_ - 1; i >= 0; --i)
    if (!pending_[i]) enlist(i);
}

void MinimumDegree::enlist(std::int32_t i) {
  const std::int32_t d = degree_[i];
  next_[i] = head_[d];
  previous_[i] = -1;
  if (head_[d] >= 0) previous_[head_[d]] = i;
  head_[d] = i;
  lowest_ = std::min(lowest_, d);
}

void MinimumDegree::delist(std::int32_t i) {
  if (pending_[i]) return;
  if (next_[i] >= 0) previous_[next_[i]] = previous_[i];
  if (previous_[i] >= 0)
    next_[previous_[i]] = next_[i];
  else
    head_[degree_[i]] = next_[i];
}

std::int32_t MinimumDegree::smallest() {
  while (head_[lowest_] < 0) ++lowest_;
  return head_[lowest_];
}

/// Moves the live lists to the front of iw_; the new element that is being written lies behind them and is none of them.
void MinimumDegree::compress() {
  // each live list is marked at its first entry by ~id, the entry itself waits in start_
  const auto total = static_cast<std::int32_t>(kind_.size());
  for (std::int32_t i = 0; i < total; ++i) {
    if (kind_[i] == absorbed || length_[i] == 0) continue;
    const std::int32_t first = iw_[start_[i]];
    iw_[start_[i]] = ~i;
    start_[i] = first;
  }
  std::size_t to = 0;
  for (std::size_t from = 0; from < free_;) {
    if (iw_[from] >= 0) {
      ++from;
      continue;
    }
    const std::int32_t i = ~iw_[from];
    iw_[to] = start_[i];
    start_[i] = static_cast<std::int32_t>(to++);
    ++from;
    for (std::int32_t t = 1; t < length_[i]; ++t) iw_[to++] = iw_[from++];
  }
  free_ = to;
}

/// Lp = (neighbours ∪ variables of the pivot's elements) \ pivot; the pivot's elements are absorbed.
void MinimumDegree::make_element(std::int32_t p) {
  std::size_t need = length_[p] - element_count_[p];
  for (std::int32_t t = 0; t < element_count_[p]; ++t) need += length_[iw_[start_[p] + t]];
  if (free_ + need > iw_.size()) compress();
  if (free_ + need > iw_.size()) iw_.resize(free_ + need + iw_.size() / 2);
  const auto start = static_cast<std::int32_t>(free_);
  std::int32_t size = 0;
  const auto take = [&](std::int32_t i) {
    if (weight_[i] <= 0) return;
    delist(i);
    size += weight_[i];
    weight_[i] = -weight_[i];
    iw_[free_++] = i;
  };
  weight_[p] = -weight_[p];  // not in its own list
  for (std::int32_t t = 0; t < element_count_[p]; ++t) {
    const std::int32_t e = iw_[start_[p] + t];
    for (std::int32_t s = start_[e]; s < start_[e] + length_[e]; ++s) take(iw_[s]);
    kind_[e] = absorbed;
    length_[e] = 0;
  }
  for (std::int32_t t = element_count_[p]; t < length_[p]; ++t) take(iw_[start_[p] + t]);
  kind_[p] = element;
  start_[p] = start;
  length_[p] = static_cast<std::int32_t>(free_) - start;
  degree_[p] = size_ = size;
}

/// stamp[e] − mark = weight of Le \ Lp for every element e that meets Lp.
void MinimumDegree::measure_overlaps(std::int32_t p) {
  for (std::int32_t s = start_[p]; s < start_[p] + length_[p]; ++s) {
    const std::int32_t i = iw_[s];
    for (std::int32_t t = start_[i]; t < start_[i] + element_count_[i]; ++t) {
      const std::int32_t e = iw_[t];
      if (kind_[e] != element) continue;
      if (stamp_[e] < mark_) stamp_[e] = mark_ + degree_[e];
      stamp_[e] += weight_[i];  // weights in Lp are negative
    }
  }
}

/// External degrees of Lp's variables, bounded as in Amestoy, Davis & Duff; elements inside Lp are absorbed; a variable whose only
/// neighbour is the pivot is eliminated with it.
void MinimumDegree::update_degrees(std::int32_t p) {
  gone_.clear();
  for (std::int32_t s = start_[p]; s < start_[p] + length_[p]; ++s) {
    const std::int32_t i = iw_[s];
    std::int64_t outside = 0;
    std::uint32_t hash = static_cast<std::uint32_t>(p);
    // the list shrinks by at least the element or neighbour that the pivot was, so that p fits in
    std::int32_t to = start_[i];
    const std::int32_t elements_end = start_[i] + element_count_[i], end = start_[i] + length_[i];
    for (std::int32_t t = start_[i]; t < elements_end; ++t) {
      const std::int32_t e = iw_[t];
      if (kind_[e] != element) continue;
      const std::int64_t part = stamp_[e] - mark_;
      if (part > 0) {
        outside += part;
        hash += static_cast<std::uint32_t>(e);
        iw_[to++] = e;
      } else {
        kind_[e] = absorbed;
        length_[e] = 0;
      }
    }
    const std::int32_t kept = to - start_[i];
    for (std::int32_t t = elements_end; t < end; ++t) {
      const std::int32_t j = iw_[t];
      if (j == p || weight_[j] <= 0 || kind_[j] != variable) continue;
      outside += weight_[j];
      hash += static_cast<std::uint32_t>(j);
      iw_[to++] = j;
    }
    if (outside == 0 && pending_[i] == 0) {
      gone_.push_back(i);
      continue;
    }
    // elements are kept, p, neighbours: the first neighbour makes room for p by moving to the end
    if (to > start_[i] + kept) iw_[to] = iw_[start_[i] + kept];
    iw_[start_[i] + kept] = p;
    element_count_[i] = kept + 1;
    length_[i] = to + 1 - start_[i];
    degree_[i] = static_cast<std::int32_t>(std::min<std::int64_t>(degree_[i], outside));
    hash_[i] = static_cast<std::int32_t>(hash % static_cast<std::uint32_t>(variables_));
  }
}

bool MinimumDegree::same_lists(std::int32_t i, std::int32_t j) const {
  if (length_[i] != length_[j] || element_count_[i] != element_count_[j]) return false;
  for (std::int32_t t = start_[j]; t < start_[j] + length_[j]; ++t)
    if (stamp_[iw_[t]] != mark_) return false;
  return true;
}

/// Variables of Lp with the same lists are one from now on. Marks of elements and variables share stamp_.
void MinimumDegree::merge_indistinguishable(std::int32_t p) {
  const std::int32_t begin = start_[p], end = begin + length_[p];
  mark_ += static_cast<std::int64_t>(head_.size());  // above every stamp of measure_overlaps
  for (std::int32_t s = begin; s < end; ++s) {
    const std::int32_t i = iw_[s];
    if (weight_[i] == 0 || pending_[i]) continue;
    next_[i] = bucket_[hash_[i]];
    bucket_[hash_[i]] = i;
  }
  for (std::int32_t s = begin; s < end; ++s) {
    const std::int32_t h = weight_[iw_[s]] == 0 ? -1 : hash_[iw_[s]];
    if (h < 0 || bucket_[h] < 0) continue;
    for (std::int32_t i = bucket_[h]; i >= 0 && next_[i] >= 0; i = next_[i]) {
      ++mark_;
      for (std::int32_t t = start_[i]; t < start_[i] + length_[i]; ++t) stamp_[iw_[t]] = mark_;
      for (std::int32_t before = i, j = next_[i]; j >= 0; j = next_[j]) {
        if (!same_lists(i, j)) {
          before = j;
          continue;
        }
        weight_[i] += weight_[j];  // both negative
        weight_[j] = 0;
        kind_[j] = absorbed;
        length_[j] = 0;
        member_[tail_[i]] = j;
        tail_[i] = tail_[j];
        next_[before] = next_[j];
      }
    }
    bucket_[h] = -1;
  }
  ++mark_;
}

/// Degrees of the remaining variables of Lp become |outside| + |Lp \ i|; they enter the lists again.
void MinimumDegree::finish_element(std::int32_t p) {
  std::int32_t to = start_[p];
  for (std::int32_t s = start_[p]; s < start_[p] + length_[p]; ++s) {
    const std::int32_t i = iw_[s];
    if (weight_[i] == 0) continue;
    const std::int32_t weight = weight_[i] = -weight_[i];
    degree_[i] = std::min(degree_[i] + size_ - weight, left_ - weight);
    degree_[i] = std::max(degree_[i], 0);
    if (!pending_[i]) enlist(i);
    iw_[to++] = i;
  }
  length_[p] = to - start_[p];
  degree_[p] = size_;
  if (length_[p] == 0) kind_[p] = absorbed;
}

void MinimumDegree::release(std::int32_t i) {
  if (--pending_[i] == 0 && kind_[i] == variable && weight_[i] > 0) enlist(i);
}

/// Puts i and all that were merged into it behind what has been ordered, and lets go what waited for them.
void MinimumDegree::eliminate(std::int32_t i, const QuotientGraph& g, const Dissection& d) {
  const auto velocities = static_cast<std::int32_t>(g.own_pointers.size()) - 1;
  for (std::int32_t x = i; x >= 0; x = member_[x]) {
    order.push_back(x);
    left_ -= g.weight[x];
    if (x < velocities)
      for (std::int32_t t = g.own_pointers[x]; t < g.own_pointers[x + 1]; ++t)
        if (g.waits[g.own_rows[t]]) release(g.own_rows[t]);
    for (std::int32_t a = d.parent[d.home[x]]; a >= 0; a = d.parent[a])
      if (--tree_[a] == 0)
        for (std::int32_t t = tree_pointers_[a]; t < tree_pointers_[a + 1]; ++t) release(tree_variables_[t]);
  }
}

void MinimumDegree::run(const QuotientGraph& g, const Dissection& d, Poll poll) {
  load(g, d);
  while (left_ > 0) {
    const std::int32_t p = smallest();
    delist(p);
    make_element(p);
    poll.spend(16 * length_[p]);
    eliminate(p, g, d);
    measure_overlaps(p);
    update_degrees(p);
    for (const std::int32_t i : gone_) {
      size_ += weight_[i];
      weight_[i] = 0;
      kind_[i] = absorbed;
      length_[i] = 0;
    }
    for (const std::int32_t i : gone_) eliminate(i, g, d);
    weight_[p] = 0;
    merge_indistinguishable(p);
    finish_element(p);
  }
}

}  // namespace mlcp
