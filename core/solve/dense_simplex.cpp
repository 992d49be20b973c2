#include "solve/dense_simplex.h"

#include <algorithm>
#include <cmath>

#include "solve/basis.h"

namespace mlcp {
namespace {

/// Pivots up to this, relative to their terms, are rounding; so are shares of an impulse.
constexpr double dependent = 1e-11, no_share = 1e-9;
/// Of Aᵢᵢ: what a row that was found to be independent has left in any case.
constexpr double left_pivot = 1e-14;

}  // namespace

void DenseSimplex::rest(std::int32_t i, ActiveSet::State to) {
  s_.state[i] = to;
  s_.gamma[i] = -ActiveSet::resting_x(to, s_.lo[i], s_.hi[i]);
}

/// Σ yⱼ² aⱼ, y being what row i and the members do together: the terms of its pivot yᵀA y. before: DenseResponse::couple.
double DenseSimplex::terms(std::int32_t i) const {
  const double* const z = s_.x_rows();
  double sum = s_.response(i, i);
  for (std::int32_t t = 0; t < *s_.members; ++t) sum += z[t] * z[t] * s_.response(s_.member[t], s_.member[t]);
  return sum;
}

/// From any states to members that are independent and impulses within their bounds: the active set only shrinks, so this ends.
void DenseSimplex::start() {
  do {
    *s_.members = 0;
    for (std::int32_t i = 0; i < s_.m; ++i) {
      if (s_.state[i] != ActiveSet::active) continue;
      s_.gamma[i] = 0;
      s_.member[(*s_.members)++] = i;
      rest(i, ActiveSet::resting(s_.lo[i], s_.hi[i]));
    }
    DenseResponse::factor_active(s_, dependent_pivot);
    for (std::int32_t t = 0; t < *s_.members; ++t) {
      s_.state[s_.member[t]] = ActiveSet::active;
      s_.gamma[s_.member[t]] = 0;
    }
    DenseResponse::solve_active(s_);
    ++counts_.factorizations;
  } while (drop_beyond_bounds());
}

/// false: there is none.
bool DenseSimplex::drop_beyond_bounds() {
  bool any = false;
  for (std::int32_t t = 0; t < *s_.members; ++t) {
    const std::int32_t i = s_.member[t];
    if (s_.gamma[i] >= s_.lo[i] && s_.gamma[i] <= s_.hi[i]) continue;
    rest(i, s_.gamma[i] < s_.lo[i] ? ActiveSet::at_lower : ActiveSet::at_upper);
    any = true;
  }
  return any;
}

void DenseSimplex::find_slacks() {
  DenseResponse::slacks(s_, ActiveSet::active);
  counts_.work += static_cast<std::int64_t>(s_.m) * *s_.members;
}

/// The violated row that would move its bodies most.  −1: there is none.
std::int32_t DenseSimplex::entering_row() const {
  std::int32_t chosen = -1;
  double most = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    const double a = s_.response(i, i), w = s_.w[i];
    if (s_.state[i] == ActiveSet::active || a == 0 || s_.lo[i] == s_.hi[i]) continue;
    const double amount = s_.state[i] == ActiveSet::at_lower ? -w : s_.state[i] == ActiveSet::at_upper ? w : std::abs(w);
    if (amount <= zero_ * s_.scale[i] || amount * amount <= most * a) continue;
    chosen = i;
    most = amount * amount / a;
  }
  return chosen;
}

bool DenseSimplex::take_in(std::int32_t i) {
  const std::int32_t t = *s_.members;
  s_.member[(*s_.members)++] = i;
  s_.state[i] = ActiveSet::active;
  DenseResponse::factor_active(s_, left_pivot, t);
  return *s_.members == t + 1;
}

bool DenseSimplex::take_out(std::int32_t t) {
  std::copy(s_.member + t + 1, s_.member + *s_.members, s_.member + t);
  const std::int32_t left = --*s_.members;
  DenseResponse::factor_active(s_, left_pivot, t);
  return *s_.members == left;
}

/// Drives row k to w = 0 or to its far bound. Impulses that reach their bounds on the way leave the active set.
bool DenseSimplex::treat(std::int32_t k) {
  const double sign = s_.w[k] < 0 ? 1 : -1;
  const double* const z = s_.x_rows();
  double w = s_.w[k];
  while (left_-- > 0) {
    ++counts_.pivots;
    counts_.work += static_cast<std::int64_t>(*s_.members) * *s_.members;
    const double pivot = DenseResponse::couple(s_, k), sum = terms(k);
    double length = pivot > dependent * sum ? -sign * w / pivot : infinity;
    std::int32_t blocking = -1;  // a member, or all of them: k itself
    const auto block = [&](std::int32_t t, std::int32_t i, double rate) {
      const double bound = rate > 0 ? s_.hi[i] : s_.lo[i];
      if (std::isinf(bound)) return;
      const double room = std::max((bound - s_.gamma[i]) / rate, 0.0);
      if (!(room < length)) return;
      length = room;
      blocking = t;
    };
    block(*s_.members, k, sign);
    for (std::int32_t t = 0; t < *s_.members; ++t) {
      const std::int32_t i = s_.member[t];
      if (z[t] * z[t] * s_.response(i, i) > no_share * no_share * sum) block(t, i, -sign * z[t]);
    }
    if (length == infinity) return false;
    for (std::int32_t t = 0; t < *s_.members; ++t) s_.gamma[s_.member[t]] -= sign * length * z[t];
    s_.gamma[k] += sign * length;
    w += sign * length * pivot;
    if (blocking < 0) return take_in(k);
    if (blocking == *s_.members) {
      rest(k, sign > 0 ? ActiveSet::at_upper : ActiveSet::at_lower);
      return true;
    }
    rest(s_.member[blocking], -sign * z[blocking] > 0 ? ActiveSet::at_upper : ActiveSet::at_lower);
    if (!take_out(blocking)) return false;
  }
  return false;
}

bool DenseSimplex::solve() {
  left_ = 4 * (s_.m + 10);
  start();
  for (;;) {
    find_slacks();
    const std::int32_t k = entering_row();
    if (k < 0) return true;
    if (!treat(k)) return false;
  }
}

}  // namespace mlcp
