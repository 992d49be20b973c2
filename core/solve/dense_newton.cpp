#include "solve/dense_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/basis.h"
#include "solve/dense_simplex.h"

namespace mlcp {
namespace {

/// Full steps may go on so often without fewer changes than ever before.
constexpr int patience = 3;
/// Where pivots are open.
constexpr int short_patience = 1;
/// Rows that the pivoting method has taken in are independent, as far as that can be told.
constexpr double found_pivot = 1e-14;
/// Sweeps of the guess: it stands when two in turn leave the same rows active.
constexpr int most_sweeps = 8;
/// From the impulses of a step before.
constexpr int most_sweeps_on = 2;
/// A factorization of k active rows is k³ / 6, a sweep of m rows m²: so many times the second, times six.
constexpr double much_dearer = 50;
/// More active rows are factored sooner the sparse way, whose cost is not that of a cube; where there are velocities, A has cost too much by then.
constexpr std::int32_t most_active = 160;

static_assert(int{DenseSweep::at_lower} == ActiveSet::at_lower && int{DenseSweep::between} == ActiveSet::active && int{DenseSweep::at_upper} == ActiveSet::at_upper);

}  // namespace

void DenseNewton::rest(std::int32_t i, ActiveSet::State to) {
  s_.state[i] = to;
  s_.gamma[i] = -ActiveSet::resting_x(to, s_.lo[i], s_.hi[i]);
}

void DenseNewton::start(const Problem& problem, const Mask* mask) {
  const bool impulses = mask && !mask->impulse.empty();
  for (std::int32_t i = 0; i < s_.m; ++i) {
    rest(i, ActiveSet::starting(problem, s_.row[i], mask));
    if (s_.state[i] == ActiveSet::active) s_.gamma[i] = impulses ? mask->impulse[s_.row[i]] : 0;
  }
}

bool DenseNewton::too_many() const { return s_.n == 0 && s_.m > most_active && std::count(s_.state, s_.state + s_.m, ActiveSet::active) > most_active; }

/// Projected Gauss-Seidel on A. The slacks follow every impulse by its column of A, which is its row: no sum has to wait for the impulse before.
void DenseNewton::guess(int most) {
  if (std::all_of(s_.gamma, s_.gamma + s_.m, [](double g) { return g == 0; }))
    std::copy(s_.b, s_.b + s_.m, s_.w);
  else
    DenseResponse::slacks(s_, ActiveSet::disabled);  // of all rows
  std::fill(s_.w + s_.m, s_.w + 4 * s_.panels, 0.0);
  double* const inverse = s_.x_rows();
  for (std::int32_t i = 0; i < s_.m; ++i) inverse[i] = s_.response(i, i) >= std::numeric_limits<double>::min() ? 1 / s_.response(i, i) : 0;
  const DenseSweep sweep{s_.m, 4 * s_.panels, s_.a, inverse, s_.lo, s_.hi, s_.gamma, s_.w, s_.state};
  for (int count = 0; count < most; ++count) {
    const bool changed = s_.kernels->impulse_sweep(sweep);
    counts_.work += static_cast<std::int64_t>(s_.m) * s_.m;
    if (!changed || too_many()) break;
  }
}

/// Rows whose state does not fit change it.  returns how many.
std::int32_t DenseNewton::flip() {
  std::int32_t flips = 0;
  DenseResponse::slacks(s_, ActiveSet::active);  // first: they are those of the impulses as they are
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.state[i] == ActiveSet::active) {
      if (s_.gamma[i] >= s_.lo[i] && s_.gamma[i] <= s_.hi[i]) continue;
      rest(i, s_.gamma[i] < s_.lo[i] ? ActiveSet::at_lower : ActiveSet::at_upper);
    } else {
      const double w = s_.w[i];
      // what no impulse can change is for the measurement to judge
      const double zero = s_.lo[i] == s_.hi[i] || s_.response(i, i) == 0 ? infinity : zero_ * s_.scale[i];
      const bool wrong = s_.state[i] == ActiveSet::at_lower ? w < -zero : s_.state[i] == ActiveSet::at_upper ? w > zero : std::abs(w) > zero;
      if (!wrong) continue;
      s_.state[i] = ActiveSet::active;
    }
    ++flips;
  }
  return flips;
}

/// A, factored and solved on the active rows; rows with a pivot of at most drop · Aᵢᵢ go to rest.  returns the rows that change their state.
std::int32_t DenseNewton::step(double drop) {
  *s_.members = 0;
  for (std::int32_t i = 0; i < s_.m; ++i) {
    if (s_.state[i] != ActiveSet::active) continue;
    s_.gamma[i] = 0;
    s_.member[(*s_.members)++] = i;
  }
  const std::int32_t wanted = *s_.members;
  DenseResponse::factor_active(s_, drop);
  if (*s_.members < wanted) {
    for (std::int32_t i = 0, t = 0; i < s_.m; ++i) {
      if (s_.state[i] != ActiveSet::active) continue;
      if (t < *s_.members && s_.member[t] == i)
        ++t;
      else
        rest(i, ActiveSet::resting(s_.lo[i], s_.hi[i]));
    }
  }
  DenseResponse::solve_active(s_);
  ++counts_.pivots;
  ++counts_.factorizations;
  counts_.work += static_cast<std::int64_t>(s_.m) * s_.m;
  return flip();
}

/// Of several rows that hold a joint together each is to carry its share, which the sparse factor with its ε gives them.
bool DenseNewton::dropped_joints() const {
  for (std::int32_t i = 0; i < s_.m; ++i)
    if (s_.state[i] == ActiveSet::out) return true;
  return false;
}

/// To the active set that fitted best.
void DenseNewton::go_back() {
  for (std::int32_t i = 0; i < s_.m; ++i) {
    s_.state[i] = s_.kept[i];
    if (s_.state[i] != ActiveSet::active) rest(i, static_cast<ActiveSet::State>(s_.state[i]));
  }
}

/// false: they do not end, and the set that fitted best is kept.
bool DenseNewton::full_steps(double drop, int patience) {
  std::int32_t fewest = s_.m + 1;
  for (int left = patience; left >= 0;) {
    std::copy(s_.state, s_.state + s_.m, s_.tried);
    const std::int32_t flips = step(drop);
    if (flips == 0) return true;
    if (flips < fewest) {
      fewest = flips;
      left = patience;
      std::swap(s_.kept, s_.tried);
    } else {
      --left;
    }
  }
  return false;
}

bool DenseNewton::pivot() {
  go_back();
  return DenseSimplex(s_, zero_, counts_).solve() && full_steps(found_pivot, short_patience);
}

bool DenseNewton::may_pivot() const { return pivots_ && !dropped_joints(); }

/// The active set of a start as it is, where rows are likely to depend on each other and a factorization costs no more than sweeps do; pivots from there if
/// it does not fit.
bool DenseNewton::solve_at_once() {
  if (2 * s_.m <= s_.n) return false;
  const double m = s_.m, active = static_cast<double>(std::count(s_.state, s_.state + s_.m, ActiveSet::active));
  if (active * active * active > much_dearer * m * m) return false;
  const bool fits = full_steps(dependent_pivot, 0);
  return may_pivot() && (fits || pivot());
}

bool DenseNewton::solve(const Problem& problem, const Mask* mask) {
  start(problem, mask);
  if (mask && pivots_) {
    if (solve_at_once()) return true;
    start(problem, mask);
  }
  if (!mask || !mask->impulse.empty()) guess(mask ? most_sweeps_on : most_sweeps);
  if (too_many()) return false;
  return full_steps(dependent_pivot, pivots_ ? short_patience : patience) || (may_pivot() && pivot());
}

bool DenseNewton::solve_on() { return full_steps(dependent_pivot, short_patience) || (may_pivot() && pivot()); }

}  // namespace mlcp
