#include "solve/dense_simplex.h"

#include <algorithm>
#include <cmath>

namespace mlcp {
namespace {

/// Pivots up to this, relative to their terms, are rounding; so are shares of an impulse.
constexpr double dependent = 1e-11, no_share = 1e-9;

}  // namespace

void DenseSimplex::rest(std::int32_t i, ActiveSet::State to) {
  s_.state[i] = to;
  s_.gamma[i] = -ActiveSet::resting_x(to, s_.lo[i], s_.hi[i]);
}

/// Σ yⱼ² aⱼ, y being what row i and the rows that are in do together: the terms of its pivot yᵀA y.
double DenseSimplex::terms(std::int32_t i) const {
  double sum = s_.response(i, i);
  for (std::int32_t j = 0; j < s_.m; ++j)
    if (is_in(j)) sum += tableau_(i, j) * tableau_(i, j) * s_.response(j, j);
  return sum;
}

/// From any states to rows that are independent and impulses within their bounds: the active set only shrinks, so this ends.
void DenseSimplex::start() {
  tableau_.load();
  for (std::int32_t i = 0; i < s_.m; ++i) s_.w[i] = is_in(i);
  for (std::int32_t i = 0; i < s_.m; ++i)
    if (is_in(i)) rest(i, ActiveSet::resting(s_.lo[i], s_.hi[i]));
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.w[i] == 0 || !(tableau_(i, i) > dependent * terms(i))) continue;
    tableau_.take_in(i);
    s_.state[i] = ActiveSet::active;
  }
  do find_impulses();
  while (drop_beyond_bounds());
}

/// γ of the rows that are in, from those of the others: γ_S = −A_SS⁻¹ (b_S + A_SN γ_N).
void DenseSimplex::find_impulses() {
  double* const rhs = s_.w;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (!is_in(i)) continue;
    rhs[i] = s_.b[i];
    const double* const a = s_.row_of_a(i);
    for (std::int32_t j = 0; j < s_.m; ++j)
      if (!is_in(j)) rhs[i] += a[j] * s_.gamma[j];
  }
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (!is_in(i)) continue;
    double gamma = 0;
    for (std::int32_t j = 0; j < s_.m; ++j)
      if (is_in(j)) gamma += tableau_(i, j) * rhs[j];
    s_.gamma[i] = gamma;
  }
}

/// false: there is none.
bool DenseSimplex::drop_beyond_bounds() {
  bool any = false;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (!is_in(i) || (s_.gamma[i] >= s_.lo[i] && s_.gamma[i] <= s_.hi[i])) continue;
    tableau_.take_out(i);
    rest(i, s_.gamma[i] < s_.lo[i] ? ActiveSet::at_lower : ActiveSet::at_upper);
    any = true;
  }
  return any;
}

/// Of all rows, since those that are in now may have left when the scale of their slack is asked for.
void DenseSimplex::find_slacks() {
  DenseResponse::slacks(s_, ActiveSet::disabled);
  for (std::int32_t i = 0; i < s_.m; ++i)
    if (is_in(i)) s_.w[i] = 0;
  counts_.work += static_cast<std::int64_t>(s_.m) * s_.m;
}

/// The violated row that would move its bodies most.  −1: there is none.
std::int32_t DenseSimplex::entering_row() const {
  std::int32_t chosen = -1;
  double most = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    const double a = s_.response(i, i), w = s_.w[i];
    if (is_in(i) || a == 0 || s_.lo[i] == s_.hi[i]) continue;
    const double amount = s_.state[i] == ActiveSet::at_lower ? -w : s_.state[i] == ActiveSet::at_upper ? w : std::abs(w);
    if (amount <= zero_ * s_.scale[i] || amount * amount <= most * a) continue;
    chosen = i;
    most = amount * amount / a;
  }
  return chosen;
}

/// Drives row k to w = 0 or to its far bound. Impulses that reach their bounds on the way leave the active set.
bool DenseSimplex::treat(std::int32_t k) {
  const double sign = s_.w[k] < 0 ? 1 : -1;
  while (left_-- > 0) {
    ++counts_.pivots;
    counts_.work += static_cast<std::int64_t>(s_.m) * s_.m / 2;
    const double sum = terms(k), pivot = tableau_(k, k);
    const bool arrives = pivot > dependent * sum;
    double length = arrives ? -sign * s_.w[k] / pivot : infinity;
    std::int32_t blocking = -1;
    const auto block = [&](std::int32_t i, double rate) {
      const double bound = rate > 0 ? s_.hi[i] : s_.lo[i];
      if (std::isinf(bound)) return;
      const double room = std::max((bound - s_.gamma[i]) / rate, 0.0);
      if (!(room < length)) return;
      length = room;
      blocking = i;
    };
    block(k, sign);
    for (std::int32_t j = 0; j < s_.m; ++j) {
      if (!is_in(j)) continue;
      const double share = tableau_(j, k);
      if (share * share * s_.response(j, j) > no_share * no_share * sum) block(j, -sign * share);
    }
    if (length == infinity) return false;
    for (std::int32_t j = 0; j < s_.m; ++j) {
      if (is_in(j))
        s_.gamma[j] -= sign * length * tableau_(j, k);
      else
        s_.w[j] += sign * length * tableau_(j, k);
    }
    s_.gamma[k] += sign * length;
    if (blocking < 0) {
      tableau_.take_in(k);
      s_.state[k] = ActiveSet::active;
      s_.w[k] = 0;
      return true;
    }
    if (blocking == k) {
      rest(k, sign > 0 ? ActiveSet::at_upper : ActiveSet::at_lower);
      return true;
    }
    const ActiveSet::State to = -sign * tableau_(blocking, k) > 0 ? ActiveSet::at_upper : ActiveSet::at_lower;
    tableau_.take_out(blocking);
    rest(blocking, to);
    s_.w[blocking] = 0;
  }
  return false;
}

bool DenseSimplex::solve() {
  left_ = 4 * (s_.m + 10);
  start();
  for (bool any = true; any;) {
    any = false;
    find_slacks();
    for (std::int32_t k = entering_row(); k >= 0; k = entering_row()) {
      if (!treat(k)) return false;
      any = true;
    }
  }
  return true;
}

}  // namespace mlcp
