#include "factorize/factor.h"

#include <algorithm>
#include <cmath>

namespace mlcp {
namespace {

/// What a batch does to so many rows is found at once: Kernels::products.
constexpr std::int64_t least_rows = 4, most_rows = 16;
/// Of Mⱼⱼ: a pivot that is no more is what rounding leaves of 0, in a mass that is only semidefinite.
constexpr double rounding = 0x1p-48;
/// Pivots of rows up to this, relative to a, are held against what rounding leaves of their terms.
constexpr double delicate = 1e-7, last_digit = 0x1p-52;
/// Columns summed at once.
constexpr std::int32_t most_columns = 32;

std::int64_t stride_of(std::int64_t rows) { return (rows + 3) / 4 * 4; }

}  // namespace

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
  place_.resize(size);
  y_.assign(size, 0.0);
  gathered_.resize(size);
  block_pointers_.resize(size);
  std::int64_t room = 0;
  for (std::int32_t p = 0; p < size; ++p) {
    const std::int64_t rows = symbolic.pointers[p + 1] - symbolic.pointers[p];
    const bool multiplied = symbolic.batch_start[p] >= 0 && symbolic.batch_start[p] < p && rows >= least_rows && rows <= most_rows;
    block_pointers_[p] = multiplied ? room : -1;
    if (multiplied) room += stride_of(rows) * stride_of(rows);
  }
  blocks_.resize(room);
  mark_.assign(size, -1);
  reach_.resize(size);
  failed_.resize(size);
}

/// Left-looking by runs. What earlier batches do to the columns of a run is found batch by batch: the columns of a batch share their rows, so that
/// Σ_k C(:,k) c_pk / d_k is summed densely, and where its entries stand in the run is looked up once for all columns of the run. Batches that act on few rows
/// have that sum ready for all of them. Then the run is eliminated within itself, without indices.
FactorStatus Factor::factorize(const Island& island, const std::uint8_t* wanted, double drop, std::int64_t& work) {
  std::fill(head_.begin() + island.first, head_.begin() + island.last, -1);
  for (std::int32_t p = island.first; p < island.last; ++p) in_[p] = !pattern_->is_row(p) || wanted[p];
  Poll poll = poll_;
  std::int64_t asked = work;
  for (std::int32_t first = island.first; first < island.last; first = symbolic_->run_end[first]) {
    load(first);
    for (std::int32_t batch = head_[first]; batch >= 0;) {
      const std::int32_t after = next_[batch];
      subtract(batch, first, work);
      batch = after;
    }
    for (std::int32_t p = first; p < symbolic_->run_end[first]; ++p) {
      poll.spend(work - asked);
      asked = work;
      if (!eliminate(first, p, drop, work)) {
        failed_[island.first] = p;
        return FactorStatus::not_positive_definite;
      }
      if (symbolic_->batch_start[p] >= 0) finish_batch(p, work);
    }
  }
  return FactorStatus::ok;
}

/// K's entries in the columns of a run; place_[row] counts the rows of its first column, unless nothing acts on it and it has K's own pattern: then they
/// are not looked up.
void Factor::load(std::int32_t first) {
  const std::int32_t last = symbolic_->run_end[first];
  const Stretch run = stretch(first, last);
  const bool as_in_k = head_[first] < 0 && last == first + 1 && run.count == pattern_->lower_pointers[last] - pattern_->lower_pointers[first];
  if (!as_in_k)
    for (std::int32_t i = 0; i < run.count; ++i) place_[run.rows[i]] = i;
  for (std::int32_t p = first; p < last; ++p) {
    const std::int32_t* row = pattern_->lower_rows.data() + pattern_->lower_pointers[p];
    const double* entry = kkt_->lower.data() + pattern_->lower_pointers[p];
    const std::int32_t entries = pattern_->lower_pointers[p + 1] - pattern_->lower_pointers[p];
    double* column = values_.data() + symbolic_->pointers[p];
    pivot_[p] = in_[p] ? kkt_->factored[p] : 0;
    if (in_[p] && as_in_k) {
      for (std::int32_t i = 0; i < entries; ++i) column[i] = in_[row[i]] ? entry[i] : 0;
      continue;
    }
    std::fill(column, values_.data() + symbolic_->pointers[p + 1], 0.0);
    if (!in_[p]) continue;
    column -= p - first;
    for (std::int32_t i = 0; i < entries; ++i)
      if (in_[row[i]]) column[place_[row[i]]] = entry[i];
  }
}

/// What the batch that ends with column `batch` does to the run that begins with `first`; it then waits for the next run that it acts on.
void Factor::subtract(std::int32_t batch, std::int32_t first, std::int64_t& work) {
  const std::int64_t begin = symbolic_->pointers[batch], rows = symbolic_->pointers[batch + 1] - begin;
  const std::int32_t* row = symbolic_->rows.data() + begin;
  std::int64_t a = cursor_[batch] - begin;
  for (const std::int32_t last = symbolic_->run_end[first]; a < rows && row[a] < last; ++a) {
    const std::int32_t p = row[a];
    if (!in_[p]) continue;
    double* column = values_.data() + symbolic_->pointers[p] - (p - first);
    const auto scatter = [&](const double* sum, double factor) {  // of the rows behind p
      for (std::int64_t b = a + 1; b < rows; ++b) column[place_[row[b]]] -= sum[b - a - 1] * factor;
    };
    if (symbolic_->batch_start[batch] == batch) {
      const double c = values_[begin + a], factor = c * inverse_[batch];
      if (c == 0) continue;
      pivot_[p] -= c * factor;
      scatter(values_.data() + begin + a + 1, factor);
      work += rows - a;
    } else if (block_pointers_[batch] >= 0) {
      const double* product = blocks_.data() + block_pointers_[batch] + stride_of(rows) * a + a;
      pivot_[p] -= product[0];
      scatter(product + 1, 1.0);
    } else {
      for_each_sum(symbolic_->batch_start[batch], batch + 1, rows - a - 1, p, work, scatter);
    }
  }
  cursor_[batch] = begin + a;
  wait(batch);
}

/// Columns first .. last − 1 of one batch, which all have row p and behind it the same `tail` rows: d_p −= Σ_k c_pk² / d_k, and visit(sum, factor) with
/// Σ_k C(tail,k) c_pk / d_k = factor · sum for a few columns at a time.
template <class Visit>
void Factor::for_each_sum(std::int32_t first, std::int32_t last, std::int64_t tail, std::int32_t p, std::int64_t& work, Visit visit) {
  const double* column[most_columns];
  double factor[most_columns];
  double* sum = gathered_.data() + p;  // a column from p on has no more rows than there are positions behind p
  while (first < last) {
    std::int32_t count = 0;
    for (; first < last && count < most_columns; ++first) {
      const double* c = values_.data() + symbolic_->pointers[first + 1] - tail;
      if (!in_[first] || c[-1] == 0) continue;
      factor[count] = c[-1] * inverse_[first];
      pivot_[p] -= c[-1] * factor[count];
      column[count++] = c;
    }
    work += count * (tail + 1);
    if (count == 0 || tail == 0) continue;
    if (count > 1) kernels_->combine(tail, count, column, factor, sum);
    visit(count > 1 ? sum : column[0], count > 1 ? 1.0 : factor[0]);
  }
}

/// Row p, whose pivot is d and which all columns before p are ready for, is rounding beside the rows before it.
bool Factor::depends(std::int32_t p, double d, double drop) {
  const double size = std::abs(d), a = kkt_->a[pattern_->row_ordinal[p]];
  return !(size > drop * a) || (drop > 0 && size <= delicate * a && size <= last_digit * terms(p));
}

/// Σ yᵢ² aᵢ over rows, Lᵀy = e_p: the terms of d_p = −yᵀ(Σ + J M⁻¹Jᵀ)y, y being what row p and the rows before it do together.
/// cost: the columns that row p of L has entries in.
double Factor::terms(std::int32_t p) {
  double* y = y_.data();
  double sum = 0;
  const auto add = [&](std::int32_t j) {
    if (pattern_->is_row(j)) sum += y[j] * y[j] * kkt_->a[pattern_->row_ordinal[j]];
  };
  const std::int32_t top = reach(p, p, p);
  y[p] = 1;
  add(p);
  for (std::int32_t s = p; s-- > top;) {
    const std::int32_t j = reach_[s];
    mark_[j] = -1;
    for (std::int64_t t = symbolic_->pointers[j]; t < symbolic_->pointers[j + 1] && symbolic_->rows[t] <= p; ++t)
      y[j] -= values_[t] * y[symbolic_->rows[t]];
    y[j] *= inverse_[j];
    add(j);
  }
  for (std::int32_t s = top; s < p; ++s) y[reach_[s]] = 0;
  y[p] = 0;
  return sum;
}

/// Column p within its run, and its pivot.  false: it is that of a velocity and not positive but for rounding.
bool Factor::eliminate(std::int32_t first, std::int32_t p, double drop, std::int64_t& work) {
  double* column = values_.data() + symbolic_->pointers[p];
  const std::int64_t rows = symbolic_->pointers[p + 1] - symbolic_->pointers[p];
  if (in_[p] && first < p)
    for_each_sum(first, p, rows, p, work, [&](const double* sum, double factor) {
      for (std::int64_t i = 0; i < rows; ++i) column[i] -= sum[i] * factor;
    });
  const double d = pivot_[p];
  if (in_[p] && !pattern_->is_row(p) && !(d > rounding * kkt_->factored[p])) return false;
  if (in_[p] && pattern_->is_row(p) && depends(p, d, drop)) {
    in_[p] = 0;
    clear_row(p, work);
    std::fill_n(column, rows, 0.0);
  }
  pivot_[p] = in_[p] ? d : 0;
  inverse_[p] = in_[p] ? 1 / d : 0;
  return true;
}

/// before: its last column p is eliminated.
void Factor::finish_batch(std::int32_t p, std::int64_t& work) {
  if (symbolic_->batch_start[p] == p && !in_[p]) return;  // does nothing to anyone
  cursor_[p] = symbolic_->pointers[p];
  if (block_pointers_[p] >= 0) multiply_out(p, work);
  wait(p);
}

void Factor::wait(std::int32_t batch) {
  if (cursor_[batch] == symbolic_->pointers[batch + 1]) return;
  const std::int32_t run = symbolic_->run_start[symbolic_->rows[cursor_[batch]]];
  next_[batch] = head_[run];
  head_[run] = batch;
}

/// Σ_k c_k c_kᵀ / d_k of the batch that ends with column `last`, for the rows that its columns share.
void Factor::multiply_out(std::int32_t last, std::int64_t& work) {
  const std::int64_t rows = symbolic_->pointers[last + 1] - symbolic_->pointers[last], stride = stride_of(rows);
  double* block = blocks_.data() + block_pointers_[last];
  std::fill_n(block, stride * stride, 0.0);
  const double* column[most_columns];
  double inverse[most_columns];
  for (std::int32_t first = symbolic_->batch_start[last]; first <= last;) {
    std::int32_t count = 0;
    for (; first <= last && count < most_columns; ++first) {
      if (!in_[first]) continue;
      column[count] = values_.data() + symbolic_->pointers[first + 1] - rows;
      inverse[count++] = inverse_[first];
    }
    kernels_->products(rows, count, column, inverse, block);
    work += count * rows * (rows + 1) / 2;
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
  for (std::int32_t t = pattern_->upper_pointers[p]; t < pattern_->upper_pointers[p + 1]; ++t) {
    std::int32_t run_end = 0;
    std::int64_t from_end = 0;  // the same for all columns of a run
    for (std::int32_t q = pattern_->upper_rows[t]; q >= 0 && q < p && mark_[q] != p; q = symbolic_->parent[q]) {
      mark_[q] = p;
      ++work;
      if (!in_[q]) continue;
      if (run_end != symbolic_->run_end[q]) {
        run_end = symbolic_->run_end[q];
        from_end = symbolic_->pointers[q + 1] - entry(q, p);
      }
      values_[symbolic_->pointers[q + 1] - from_end] = 0;
    }
  }
  for (std::int32_t t = pattern_->upper_pointers[p]; t < pattern_->upper_pointers[p + 1]; ++t)
    for (std::int32_t q = pattern_->upper_rows[t]; q >= 0 && q < p && mark_[q] == p; q = symbolic_->parent[q]) mark_[q] = -1;
}

Stretch Factor::stretch(std::int32_t first, std::int32_t last) const {
  const std::int64_t start = symbolic_->pointers[first];
  return {first, last, symbolic_->pointers[first + 1] - start, symbolic_->rows.data() + start};
}

Stretch Factor::batch(std::int32_t first, std::int32_t last) const {
  Stretch s = stretch(first, last);
  s.equal = symbolic_->run_end[first] < last;
  return s;
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
  for (std::int32_t first = island.first; first < island.last; first = symbolic_->batch_end[first])
    work += kernels_->forward(f, batch(first, symbolic_->batch_end[first]), x);
  backward_all(island, x, work);
}

void Factor::backward_all(const Island& island, double* x, std::int64_t& work) const {
  const FactorArrays f = arrays();
  for (std::int32_t last = island.last, first; last > island.first; last = first) {
    first = symbolic_->batch_start[last - 1];
    work += kernels_->backward(f, batch(first, last), x);
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
