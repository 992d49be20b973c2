#include "factorize/factor.h"

#include <algorithm>
#include <cmath>

namespace mlcp {

void Factor::prepare(const KktPattern& pattern, const Symbolic& symbolic, const KktValues& values) {
  pattern_ = &pattern;
  symbolic_ = &symbolic;
  kkt_ = &values;
  poll_ = {};
  const std::int32_t size = symbolic.size();
  values_.resize(symbolic.entries());
  pivot_.assign(size, 0.0);
  inverse_.assign(size, 0.0);
  in_.assign(size, 0);
  next_.resize(size);
  head_.resize(size);
  cursor_.resize(size);
  y_.assign(size, 0.0);
  gathered_.resize(size);
  mark_.assign(size, -1);
  reach_.resize(size);
  failed_.resize(size);
}

/// Left-looking by batches. Column p subtracts what earlier columns of its own run and whole earlier batches do to it: their columns share the
/// rows from p on, so that Σ_k C(p:,k) c_pk / d_k is summed densely and scattered once.
FactorStatus Factor::factorize(const Island& island, const std::uint8_t* wanted, double drop, std::int64_t& work) {
  std::fill(head_.begin() + island.first, head_.begin() + island.last, -1);
  for (std::int32_t p = island.first; p < island.last; ++p) in_[p] = !pattern_->is_row(p) || wanted[p];
  Poll poll = poll_;
  std::int64_t asked = work;
  for (std::int32_t p = island.first; p < island.last; ++p) {
    poll.spend(work - asked);
    asked = work;
    const bool row = pattern_->is_row(p);
    const std::int64_t begin = symbolic_->pointers[p], end = symbolic_->pointers[p + 1];
    double d = kkt_->factored[p];
    if (in_[p]) {
      for (std::int32_t t = pattern_->lower_pointers[p]; t < pattern_->lower_pointers[p + 1]; ++t) {
        const std::int32_t q = pattern_->lower_rows[t];
        if (in_[q]) y_[q] = kkt_->lower[t];
      }
      if (const std::int32_t first = symbolic_->run_start[p]; first < p) subtract(first, p, end - begin, p, d, work);
    }
    // batches whose next row is p: the last column of each has the rows that all its columns share
    for (std::int32_t last = head_[p]; last >= 0;) {
      const std::int32_t after = next_[last];
      const std::int64_t t = cursor_[last]++, tail = symbolic_->pointers[last + 1] - t - 1;
      if (in_[p]) subtract(symbolic_->batch_start[last], last + 1, tail, p, d, work);
      if (tail > 0) {
        const std::int32_t q = symbolic_->rows[cursor_[last]];
        next_[last] = head_[q];
        head_[q] = last;
      }
      last = after;
    }
    bool live = in_[p];
    if (live && !row && !(d > 0)) {
      failed_[island.first] = p;
      for (std::int64_t t = begin; t < end; ++t) y_[symbolic_->rows[t]] = 0;
      return FactorStatus::not_positive_definite;
    }
    if (live && row && !(std::abs(d) > drop * kkt_->a[pattern_->row_ordinal[p]])) {
      live = false;
      in_[p] = 0;
      clear_row(p, work);
    }
    for (std::int64_t t = begin; t < end; ++t) {
      values_[t] = live ? y_[symbolic_->rows[t]] : 0;
      y_[symbolic_->rows[t]] = 0;
    }
    pivot_[p] = live ? d : 0;
    inverse_[p] = live ? 1 / d : 0;
    if (symbolic_->batch_start[p] >= 0 && begin < end) {
      cursor_[p] = begin;
      next_[p] = head_[symbolic_->rows[begin]];
      head_[symbolic_->rows[begin]] = p;
    }
  }
  return FactorStatus::ok;
}

/// Columns first .. last − 1 of one batch, which all have row p and behind it the same `tail` rows: y −= Σ_k C(tail,k) c_pk / d_k, and d for
/// row p itself.
void Factor::subtract(std::int32_t first, std::int32_t last, std::int64_t tail, std::int32_t p, double& d, std::int64_t& work) {
  constexpr std::int32_t most = 32;  // columns summed at once
  const std::int64_t end = symbolic_->pointers[last];
  const std::int32_t* rows = symbolic_->rows.data() + end - tail;
  double* sum = gathered_.data() + p;  // a column from p on has no more rows than there are positions behind p
  const double* column[most];
  double factor[most];
  while (first < last) {
    std::int32_t count = 0;
    for (; first < last && count < most; ++first) {
      const double* c = values_.data() + symbolic_->pointers[first + 1] - tail;
      if (!in_[first] || c[-1] == 0) continue;
      factor[count] = c[-1] * inverse_[first];
      d -= c[-1] * factor[count];
      column[count++] = c;
    }
    work += count * (tail + 1);
    if (count == 0 || tail == 0) continue;
    if (count == 1) {
      for (std::int64_t i = 0; i < tail; ++i) y_[rows[i]] -= column[0][i] * factor[0];
      continue;
    }
    kernels_->combine(tail, count, column, factor, sum);
    for (std::int64_t i = 0; i < tail; ++i) y_[rows[i]] -= sum[i];
  }
}

/// Nodes before `below` on the tree paths that start at row p's nodes: where L⁻¹ K(:,p) can be nonzero.
/// after: they stand in reach_[returned, last), children before parents, each marked; the caller resets mark_ as it goes.
std::int32_t Factor::reach(std::int32_t p, std::int32_t below, std::int32_t last) {
  const std::int32_t o = pattern_->row_ordinal[p];
  std::int32_t top = last;
  for (std::int32_t t = pattern_->row_pointers[o]; t < pattern_->row_pointers[o + 1]; ++t) {
    std::int32_t length = 0, q = pattern_->row_columns[t];
    for (; q >= 0 && q < below && mark_[q] != p; q = symbolic_->parent[q]) {
      mark_[q] = p;
      --top;
      reach_[top] = q;
      ++length;
    }
    std::reverse(reach_.begin() + top, reach_.begin() + top + length);
  }
  return top;
}

/// The reached columns in stretches of one run each; their marks are reset.
template <class Visit>
void Factor::for_each_stretch(std::int32_t top, std::int32_t last, Visit visit) {
  while (top < last) {
    const std::int32_t first = reach_[top], end = symbolic_->run_end[first];
    std::int32_t next = first;
    for (; top < last && reach_[top] == next && next < end; ++top) mark_[next++] = -1;
    visit(stretch(first, next));
  }
}

std::int64_t Factor::entry(std::int32_t column, std::int32_t row) const {
  const std::int32_t* rows = symbolic_->rows.data();
  const std::int32_t* first = rows + symbolic_->pointers[column];
  return std::lower_bound(first, rows + symbolic_->pointers[column + 1], row) - rows;
}

void Factor::clear_row(std::int32_t p, std::int64_t& work) {
  // row p of L: the tree's subtree that the nodes of K(p,:) before p span
  for (std::int32_t t = pattern_->upper_pointers[p]; t < pattern_->upper_pointers[p + 1]; ++t)
    for (std::int32_t q = pattern_->upper_rows[t]; q >= 0 && q < p && mark_[q] != p; q = symbolic_->parent[q]) {
      mark_[q] = p;
      if (in_[q]) values_[entry(q, p)] = 0;
      ++work;
    }
  for (std::int32_t t = pattern_->upper_pointers[p]; t < pattern_->upper_pointers[p + 1]; ++t)
    for (std::int32_t q = pattern_->upper_rows[t]; q >= 0 && q < p && mark_[q] == p; q = symbolic_->parent[q]) mark_[q] = -1;
}

Stretch Factor::stretch(std::int32_t first, std::int32_t last) const {
  const std::int64_t start = symbolic_->pointers[first];
  return {first, last, symbolic_->pointers[first + 1] - start, symbolic_->rows.data() + start};
}

FactorArrays Factor::arrays() const {
  const auto writable = [](const Array<double>& a) { return const_cast<double*>(a.data()); };
  return {writable(values_), symbolic_->pointers.data(), in_.data(), writable(pivot_), writable(inverse_), writable(gathered_)};
}

FactorStatus Factor::rank_one(std::int32_t p, double sigma, std::int64_t& work) {
  const FactorArrays f = arrays();
  double* w = y_.data();
  for (std::int64_t t = symbolic_->pointers[p]; t < symbolic_->pointers[p + 1]; ++t) w[symbolic_->rows[t]] = values_[t];
  std::int32_t first = symbolic_->parent[p];
  for (; first >= 0; first = symbolic_->parent[symbolic_->run_end[first] - 1]) {
    const std::int64_t touched = kernels_->rank_one(f, stretch(first, symbolic_->run_end[first]), w, sigma);
    if (touched < 0) break;
    work += touched;
  }
  if (first < 0) return FactorStatus::ok;
  for (; first >= 0; first = symbolic_->parent[first]) w[first] = 0;
  return FactorStatus::small_pivot;
}

FactorStatus Factor::remove(std::int32_t p, std::int64_t& work) {
  const FactorStatus status = rank_one(p, 1 / pivot_[p], work);
  for (std::int64_t t = symbolic_->pointers[p]; t < symbolic_->pointers[p + 1]; ++t) values_[t] = 0;
  clear_row(p, work);
  in_[p] = 0;
  pivot_[p] = inverse_[p] = 0;
  return status;
}

FactorStatus Factor::insert(std::int32_t p, std::int64_t& work, double drop) {
  const std::int32_t o = pattern_->row_ordinal[p];
  double* y = y_.data();
  for (std::int32_t t = pattern_->row_pointers[o]; t < pattern_->row_pointers[o + 1]; ++t)
    if (in_[pattern_->row_columns[t]]) y[pattern_->row_columns[t]] = kkt_->row[t];
  double d = kkt_->factored[p];
  // row p of L: L(:p,:p) D l = K(:p,p); its entries in C are y_j
  const FactorArrays f = arrays();
  for_each_stretch(reach(p, p, p), p, [&](const Stretch& s) {
    work += kernels_->forward(f, s, y);
    const std::int64_t place = std::lower_bound(s.rows, s.rows + s.count, p) - s.rows;
    for (std::int32_t j = s.first; j < s.last; ++j) {
      if (in_[j] && y[j] != 0) {
        d -= y[j] * (y[j] * inverse_[j]);
        values_[symbolic_->pointers[j] + place - (j - s.first)] = y[j];
      }
      y[j] = 0;
    }
  });
  y[p] = 0;
  const std::int64_t begin = symbolic_->pointers[p], end = symbolic_->pointers[p + 1];
  if (drop > 0 && !(std::abs(d) > drop * kkt_->a[o])) {
    for (std::int64_t t = begin; t < end; ++t) y[symbolic_->rows[t]] = 0;
    clear_row(p, work);
    return FactorStatus::dependent;
  }
  for (std::int64_t t = begin; t < end; ++t) {
    values_[t] = y[symbolic_->rows[t]];
    y[symbolic_->rows[t]] = 0;
  }
  in_[p] = 1;
  pivot_[p] = d;
  inverse_[p] = 1 / d;
  if (!(std::abs(d) > 0)) return FactorStatus::small_pivot;
  return rank_one(p, -1 / d, work);
}

void Factor::solve(const Island& island, double* x, std::int64_t& work) const {
  for (std::int32_t j = island.first; j < island.last; ++j)
    if (!in_[j]) x[j] = 0;
  const FactorArrays f = arrays();
  for (std::int32_t first = island.first; first < island.last; first = symbolic_->run_end[first])
    work += kernels_->forward(f, stretch(first, symbolic_->run_end[first]), x);
  backward_all(island, x, work);
}

void Factor::backward_all(const Island& island, double* x, std::int64_t& work) const {
  const FactorArrays f = arrays();
  for (std::int32_t last = island.last, first; last > island.first; last = first) {
    first = symbolic_->run_start[last - 1];
    work += kernels_->backward(f, stretch(first, last), x);
  }
}

/// x := L⁻¹ K(:,p) for a row p that is out, x = 0 before; keep false: x = 0 again afterwards. returns K_pp − Σ x_j²/d_j.
double Factor::forward_row(std::int32_t p, std::int32_t last, double* x, bool keep, std::int64_t& work) {
  const std::int32_t o = pattern_->row_ordinal[p];
  for (std::int32_t t = pattern_->row_pointers[o]; t < pattern_->row_pointers[o + 1]; ++t)
    if (in_[pattern_->row_columns[t]]) x[pattern_->row_columns[t]] = kkt_->row[t];
  double schur = kkt_->factored[p];
  const FactorArrays f = arrays();
  for_each_stretch(reach(p, last, last), last, [&](const Stretch& s) {
    work += kernels_->forward(f, s, x);
    for (std::int32_t j = s.first; j < s.last; ++j) {
      schur -= x[j] * (x[j] * inverse_[j]);  // 1/d = 0 for what is out
      if (!keep) x[j] = 0;
    }
  });
  return schur;
}

double Factor::solve_row(const Island& island, std::int32_t p, double* x, std::int64_t& work) {
  std::fill(x + island.first, x + island.last, 0.0);
  const double schur = forward_row(p, island.last, x, true, work);
  backward_all(island, x, work);
  return schur;
}

double Factor::schur(const Island& island, std::int32_t p, std::int64_t& work) {
  return forward_row(p, island.last, y_.data(), false, work);
}

std::int64_t Factor::path_columns(std::int32_t p) const {
  std::int64_t count = 0;
  for (std::int32_t j = symbolic_->parent[p]; j >= 0; j = symbolic_->parent[j]) ++count;
  return count;
}

}  // namespace mlcp
