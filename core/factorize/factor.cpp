#include "factorize/factor.h"

#include <algorithm>
#include <cmath>

#include "factorize/kernels.h"

namespace mlcp {

void Factor::prepare(const KktPattern& pattern, const Symbolic& symbolic, const KktValues& values) {
  pattern_ = &pattern;
  symbolic_ = &symbolic;
  kkt_ = &values;
  const std::int32_t size = symbolic.size();
  values_.resize(symbolic.entries());
  pivot_.assign(size, 0.0);
  inverse_.assign(size, 0.0);
  in_.assign(size, 0);
  next_.resize(size);
  head_.resize(size);
  cursor_.resize(size);
  y_.assign(size, 0.0);
  mark_.assign(size, -1);
  reach_.resize(size);
}

FactorStatus Factor::factorize(const Island& island, const std::uint8_t* wanted, double drop, std::int64_t& work) {
  const std::int64_t* start = symbolic_->pointers.data();
  const std::int32_t* rows = symbolic_->rows.data();
  std::fill(head_.begin() + island.first, head_.begin() + island.last, -1);
  for (std::int32_t p = island.first; p < island.last; ++p) in_[p] = !pattern_->is_row(p) || wanted[p];
  for (std::int32_t p = island.first; p < island.last; ++p) {
    const bool row = pattern_->is_row(p);
    double d = kkt_->diagonal[p];
    if (in_[p]) {
      for (std::int32_t t = pattern_->lower_pointers[p]; t < pattern_->lower_pointers[p + 1]; ++t) {
        const std::int32_t q = pattern_->lower_rows[t];
        if (in_[q]) y_[q] = kkt_->lower[t];
      }
    }
    // columns k with c_pk ≠ 0: K(p:,p) −= C(p:,k) c_pk / d_k; those whose row p is out just move on
    for (std::int32_t k = head_[p]; k >= 0;) {
      const std::int32_t after = next_[k];
      const std::int64_t t = cursor_[k]++;
      if (in_[p]) {
        const double f = values_[t] * inverse_[k];
        d -= values_[t] * f;
        kernels::scatter_subtract(start[k + 1] - t - 1, rows + t + 1, values_.data() + t + 1, f, y_.data());
        work += start[k + 1] - t;
      }
      if (cursor_[k] < start[k + 1]) {
        const std::int32_t q = rows[cursor_[k]];
        next_[k] = head_[q];
        head_[q] = k;
      }
      k = after;
    }
    bool live = in_[p];
    if (live && !row && !(d > 0)) {
      failed_ = p;
      for (std::int64_t t = start[p]; t < start[p + 1]; ++t) y_[rows[t]] = 0;
      return FactorStatus::not_positive_definite;
    }
    if (live && row && !(std::abs(d) > drop * kkt_->a[pattern_->row_ordinal[p]])) {
      live = false;
      in_[p] = 0;
      clear_row(p, work);
    }
    if (!live) {
      for (std::int64_t t = start[p]; t < start[p + 1]; ++t) {
        y_[rows[t]] = 0;
        values_[t] = 0;
      }
      pivot_[p] = inverse_[p] = 0;
      continue;
    }
    for (std::int64_t t = start[p]; t < start[p + 1]; ++t) {
      values_[t] = y_[rows[t]];
      y_[rows[t]] = 0;
    }
    pivot_[p] = d;
    inverse_[p] = 1 / d;
    if (start[p] < start[p + 1]) {
      cursor_[p] = start[p];
      next_[p] = head_[rows[start[p]]];
      head_[rows[start[p]]] = p;
    }
  }
  return FactorStatus::ok;
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

/// Trailing matrix += σ w wᵀ with w = C(p+1:,p), along the path. Gill, Golub, Murray & Saunders (1974), method C1, on C = L D:
///     d' = d + σ w_j²,  c' = c + σ w_j w,  w := w − (w_j/d) c,  σ := σ d/d'.
FactorStatus Factor::rank_one(std::int32_t p, double sigma, std::int64_t& work) {
  const std::int64_t* start = symbolic_->pointers.data();
  const std::int32_t* rows = symbolic_->rows.data();
  for (std::int64_t t = start[p]; t < start[p + 1]; ++t) y_[rows[t]] = values_[t];
  FactorStatus status = FactorStatus::ok;
  for (std::int32_t j = symbolic_->parent[p]; j >= 0; j = symbolic_->parent[j]) {
    const double w = y_[j];
    y_[j] = 0;
    if (w == 0 || status != FactorStatus::ok) continue;
    const double d = pivot_[j], updated = d + sigma * w * w;
    if (!(std::abs(updated) > 1e-12 * std::abs(d)) || (updated > 0) != (d > 0)) {
      status = FactorStatus::small_pivot;
      continue;
    }
    kernels::rank_one_column(start[j + 1] - start[j], rows + start[j], values_.data() + start[j], y_.data(), w / d, sigma * w);
    pivot_[j] = updated;
    inverse_[j] = 1 / updated;
    sigma *= d / updated;
    work += start[j + 1] - start[j];
  }
  return status;
}

FactorStatus Factor::remove(std::int32_t p, std::int64_t& work) {
  const FactorStatus status = rank_one(p, 1 / pivot_[p], work);
  for (std::int64_t t = symbolic_->pointers[p]; t < symbolic_->pointers[p + 1]; ++t) values_[t] = 0;
  clear_row(p, work);
  in_[p] = 0;
  pivot_[p] = inverse_[p] = 0;
  return status;
}

FactorStatus Factor::insert(std::int32_t p, std::int64_t& work) {
  const std::int64_t* start = symbolic_->pointers.data();
  const std::int32_t* rows = symbolic_->rows.data();
  const std::int32_t o = pattern_->row_ordinal[p], last = p;
  for (std::int32_t t = pattern_->row_pointers[o]; t < pattern_->row_pointers[o + 1]; ++t)
    if (in_[pattern_->row_columns[t]]) y_[pattern_->row_columns[t]] = kkt_->row[t];
  double d = kkt_->diagonal[p];
  for (std::int32_t s = reach(p, p, last); s < last; ++s) {
    const std::int32_t j = reach_[s];
    mark_[j] = -1;
    if (!in_[j]) continue;
    const double c = y_[j], f = c * inverse_[j];
    y_[j] = 0;
    d -= c * f;
    kernels::scatter_subtract(start[j + 1] - start[j], rows + start[j], values_.data() + start[j], f, y_.data());
    values_[entry(j, p)] = c;
    work += start[j + 1] - start[j];
  }
  y_[p] = 0;
  for (std::int64_t t = start[p]; t < start[p + 1]; ++t) {
    values_[t] = y_[rows[t]];
    y_[rows[t]] = 0;
  }
  in_[p] = 1;
  pivot_[p] = d;
  inverse_[p] = 1 / d;
  if (!(std::abs(d) > 0)) return FactorStatus::small_pivot;
  return rank_one(p, -1 / d, work);
}

void Factor::solve(const Island& island, double* x, std::int64_t& work) const {
  const std::int64_t* start = symbolic_->pointers.data();
  const std::int32_t* rows = symbolic_->rows.data();
  for (std::int32_t j = island.first; j < island.last; ++j) {
    if (!in_[j]) {
      x[j] = 0;
    } else if (x[j] != 0) {
      kernels::scatter_subtract(start[j + 1] - start[j], rows + start[j], values_.data() + start[j], x[j] * inverse_[j], x);
    }
  }
  for (std::int32_t j = island.last - 1; j >= island.first; --j)
    if (in_[j]) x[j] = inverse_[j] * (x[j] - kernels::gather_dot(start[j + 1] - start[j], rows + start[j], values_.data() + start[j], x));
  work += 2 * (start[island.last] - start[island.first]);
}

/// x := L⁻¹ K(:,p) for a row p that is out, x = 0 before; keep false: x = 0 again afterwards. returns K_pp − Σ x_j²/d_j.
double Factor::forward_row(std::int32_t p, std::int32_t last, double* x, bool keep, std::int64_t& work) {
  const std::int64_t* start = symbolic_->pointers.data();
  const std::int32_t* rows = symbolic_->rows.data();
  const std::int32_t o = pattern_->row_ordinal[p];
  for (std::int32_t t = pattern_->row_pointers[o]; t < pattern_->row_pointers[o + 1]; ++t)
    if (in_[pattern_->row_columns[t]]) x[pattern_->row_columns[t]] = kkt_->row[t];
  double schur = kkt_->diagonal[p];
  for (std::int32_t s = reach(p, last, last); s < last; ++s) {
    const std::int32_t j = reach_[s];
    mark_[j] = -1;
    if (in_[j] && x[j] != 0) {
      const double f = x[j] * inverse_[j];
      schur -= x[j] * f;
      kernels::scatter_subtract(start[j + 1] - start[j], rows + start[j], values_.data() + start[j], f, x);
      work += start[j + 1] - start[j];
    }
    if (!keep) x[j] = 0;
  }
  return schur;
}

double Factor::solve_row(const Island& island, std::int32_t p, double* x, std::int64_t& work) {
  const std::int64_t* start = symbolic_->pointers.data();
  const std::int32_t* rows = symbolic_->rows.data();
  std::fill(x + island.first, x + island.last, 0.0);
  const double schur = forward_row(p, island.last, x, true, work);
  for (std::int32_t j = island.last - 1; j >= island.first; --j) {
    if (!in_[j]) continue;
    x[j] = inverse_[j] * (x[j] - kernels::gather_dot(start[j + 1] - start[j], rows + start[j], values_.data() + start[j], x));
    work += start[j + 1] - start[j];
  }
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
