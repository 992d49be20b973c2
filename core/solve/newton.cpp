#include "solve/newton.h"

#include <algorithm>
#include <cmath>

#include "memory/slice.h"
#include "solve/interior_point.h"

namespace mlcp {
namespace {

/// Full steps may go on so often without fewer changes than ever before.
constexpr int patience = 10;
/// Where rows depend on each other and the start is only a guess, the interior points are next: after so many steps, or at once if the guess is wrong
/// about more than one row in eight.
constexpr int patience_with_guesses = 3;
constexpr std::size_t good_guess = 8;
/// Where pivots touch so few rows, those that full steps have left to do are fewer than the steps of interior points.
constexpr std::int32_t few_to_pivot = 1000;
/// Refined points as good as this are judged row by row; worse ones stand on a factor that cannot be trusted.
constexpr double refined = 1e-13;
/// Rows of rounded data contradict each other by up to this much. Impulses that meet a row but for w differ from the centre by w / (ε a): with a smaller ε
/// those of the rows in the way reach their bounds, and which of them gives way shows without a pivot.
constexpr double rounded = 1e-10, sharper = 1e-2, sharpest_epsilon = 1e-13;
/// Impulses so many times as large as the right-hand sides ask for are those of a contradiction that is no rounding, divided by ε.
constexpr double grown = 1e4;
/// Of the largest right-hand side, rows scaled to a = 1: a slack that is more is not rounding, whatever its terms.
constexpr double matters = 1e-6;
constexpr double first_epsilon = 1e-2, reduction = 0.3;
constexpr int most_descents = 30, most_inner_steps = 60;
/// Rounding may move a row once more after the refined point.
constexpr int most_rounds = 5;
/// Of its first value: what the interior points are followed down to.
constexpr double reduced_gap = 1e-14;

}  // namespace

/// The active set is one to go back to: the start, or one that solved a problem nearby.
void Newton::keep(const Island& island) {
  std::copy(basis_.set.state.begin() + island.first_row, basis_.set.state.begin() + island.last_row, basis_.work.state.begin() + island.first_row);
}

void Newton::go_back(const Island& island) {
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    basis_.set.state[o] = basis_.work.state[o];
    if (basis_.set.state[o] != ActiveSet::active) basis_.rest(o, static_cast<ActiveSet::State>(basis_.set.state[o]));
  }
}

/// Full steps until no row changes. Where changes at once do not become fewer, only the larger ones are made, down to a single one: rows that undo
/// each other's changes are told apart (after the backup rule of Júdice & Pires 1994).
Newton::Ending Newton::full_steps(const Island& island, double drop) {
  std::size_t fewest = SIZE_MAX;
  int share = 0;  // 2^−share of the changes are made
  const bool guessed = drop == 0 && (!warm_ || island.crowded);
  int most = guessed ? patience_with_guesses : patience;
  for (int left = most;;) {
    stopped_ = limits_.check(counts_, 0);
    if (stopped_ != MLCP_SOLVED) return Ending::stopped;
    proximal_.newton_point(island);
    auto flips = proximal_.flips_of_full_step(island);
    ++counts_.pivots;
    if (flips.empty()) {
      keep(island);
      return Ending::settled;
    }
    if (guessed && good_guess * flips.size() > static_cast<std::size_t>(island.last_row - island.first_row)) most = 0;
    if (flips.size() < fewest) {
      fewest = flips.size();
      left = most;
      share = std::max(0, share - 1);
    } else if (--left < 0) {
      return Ending::stuck;
    } else {
      ++share;
    }
    if (share > 0) flips = proximal_.largest(flips, std::max<std::size_t>(1, flips.size() >> share));
    if (basis_.change(island, flips, drop, counts_) > 0 && drop > 0) return Ending::dependent;
  }
}

/// settled: the refined point of the active set solves the problem itself. stuck: it does not, or flips_ tells which rows must change.
/// from_x: dependent rows keep their share, and may contradict each other by as much as is allowed: in crowded islands, where to tell which of them
/// gives way takes hundreds of pivots, a tenth of the tolerance.
/// solved: x is the point of the active set already, but for refinement.
Newton::Ending Newton::finish(const Island& island, bool from_x, bool solved) {
  const std::size_t few = 8 + (island.last_row - island.first_row) / 50;
  const double enough = from_x ? std::max(refined, island.crowded ? basis_.forgiven() : basis_.contradiction) : refined;
  for (int round = 0; round < most_rounds; ++round) {
    const double error = finished_ = basis_.refine(island, counts_, from_x || (round == 0 && solved));
    flips_ = proximal_.flips_of_point(island);
    if (flips_.empty()) return error <= enough && empty_rows_hold(island) && !impulses_forgive(island) ? Ending::settled : Ending::stuck;
    if (proximal_.epsilon() == 0 || !(error <= refined) || flips_.size() > few) break;
    basis_.change(island, flips_, 0, counts_);  // ties: rows that ε had kept on the other side of their bounds
  }
  return Ending::stuck;
}

/// Rows that no impulse can move (a = 0) are none of Newton's, but they may be violated.
bool Newton::empty_rows_hold(const Island& island) const {
  const ActiveSet& set = basis_.set;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (basis_.values.a[o] > 0 || set.state[o] == ActiveSet::disabled) continue;
    const double w = set.w[o], zero = set.tolerance[o];
    if (set.state[o] == ActiveSet::at_lower ? w < -zero : set.state[o] == ActiveSet::at_upper ? w > zero : std::abs(w) > zero) return false;
  }
  return true;
}

/// Where no load meets the rows, impulses that grow make any slack small beside their own terms: one that matters beside what the rows ask for is none that
/// rounding has left.
bool Newton::impulses_forgive(const Island& island) const {
  double missing = 0, asked = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    const std::uint8_t state = basis_.set.state[o];
    if (state == ActiveSet::disabled || basis_.values.lo[o] == basis_.values.hi[o]) continue;
    const double w = basis_.set.w[o], wrong = state == ActiveSet::at_lower ? -w : state == ActiveSet::at_upper ? w : std::abs(w);
    missing = std::max(missing, wrong / basis_.values.root_a[o]);
    asked = std::max(asked, basis_.values.size[basis_.position(o)] / basis_.values.root_a[o]);
  }
  return !(missing <= matters * asked);
}

bool Newton::impulses_grow(const Island& island) const {
  double largest = 0, asked = 0;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
    if (basis_.set.state[o] == ActiveSet::disabled) continue;
    largest = std::max(largest, basis_.values.root_a[o] * std::abs(basis_.gamma(o)));
    asked = std::max(asked, basis_.values.size[basis_.position(o)] / basis_.values.root_a[o]);
  }
  return !(largest <= grown * asked);
}

Newton::Ending Newton::exact(const Island& island) {
  const auto active = [&] { return std::count(basis_.set.state.begin() + island.first_row, basis_.set.state.begin() + island.last_row, ActiveSet::active); };
  const auto wanted = active();
  if (!proximal_.soften(island, 0, 0, dependent_pivot)) return Ending::indefinite;
  if (active() < wanted) return Ending::dependent;
  return exact_rounds(island);
}

Newton::Ending Newton::exact_rounds(const Island& island) {
  for (int round = 0; round < most_rounds; ++round) {
    const Ending ending = full_steps(island, dependent_pivot);
    if (ending != Ending::settled) return ending;
    if (finish(island, false, true) == Ending::settled) return Ending::settled;
    if (flips_.empty()) return Ending::stuck;
    if (basis_.change(island, flips_, dependent_pivot, counts_) > 0) return Ending::dependent;
  }
  return Ending::stuck;
}

bool Newton::soften(const Island& island, double epsilon) {
  if (proximal_.soften(island, epsilon, delta_, 0)) return true;
  if (delta_ > 0) return false;
  delta_ = semidefinite_delta;
  return proximal_.soften(island, epsilon, delta_, 0);
}

Newton::Ending Newton::sharp(const Island& island, int rounds) {
  if (!soften(island, sharp_epsilon)) return Ending::indefinite;
  return sharp_rounds(island, rounds);
}

Newton::Ending Newton::sharp_rounds(const Island& island, int rounds) {
  double before = infinity;
  for (int round = 0; round < rounds; ++round) {
    const Ending ending = full_steps(island, 0);
    if (ending != Ending::settled) return ending;
    proximal_.center_here(island);
    if (finish(island) == Ending::settled) return Ending::settled;
    const bool contradict = !(finished_ <= 0.5 * before);  // rows do, by that much
    if (contradict && finished_ <= rounded && proximal_.epsilon() > sharpest_epsilon && !impulses_grow(island)) {
      if (!soften(island, sharper * proximal_.epsilon())) return Ending::indefinite;
      round = -1;
      before = infinity;
      continue;
    }
    contradicts_ = contradict && flips_.empty();
    if (contradicts_) return Ending::stuck;
    before = finished_;
    // The share of least norm may be beyond the bounds of some rows, where that of the centre is not. Only where there is a solution: the impulses of
    // an infeasible problem grow from centre to centre until its contradiction is small beside them.
    if (!feasible_) continue;
    proximal_.newton_point(island);
    if (finish(island, true) == Ending::settled) return Ending::settled;
  }
  return Ending::stuck;
}

/// Newton steps with line search until the proximal problem is solved: the active set stays and the step is whole.
Newton::Ending Newton::minimise(const Island& island) {
  for (int step = 0; step < most_inner_steps; ++step) {
    stopped_ = limits_.check(counts_, 0);
    if (stopped_ != MLCP_SOLVED) return Ending::stopped;
    const auto flips = proximal_.flips_of_descent(island);
    if (step > 0 && flips.empty()) {
      keep(island);
      return Ending::settled;
    }
    basis_.change(island, flips, 0, counts_);
    proximal_.descend(island);
    ++counts_.pivots;
  }
  return Ending::stuck;
}

Newton::Ending Newton::descent(const Island& island) {
  double epsilon = first_epsilon;
  if (!soften(island, epsilon)) return Ending::indefinite;
  proximal_.newton_point(island);
  proximal_.start_descent(island);
  for (int outer = 0; outer < most_descents; ++outer) {
    const std::int64_t before = counts_.pivots;
    const Ending ending = minimise(island);
    if (ending == Ending::stopped) return ending;
    proximal_.recenter(island);
    // solved in one step: the active set is likely the last one
    if (counts_.pivots == before + 1 && finish(island) == Ending::settled) return Ending::settled;
    if (epsilon <= sharp_epsilon) continue;
    epsilon *= reduction;
    if (!soften(island, epsilon)) return Ending::indefinite;
  }
  return Ending::stuck;
}

/// From the start, centred, along the path of interior points, whose end shows the active set.
Newton::Ending Newton::interior(const Island& island) {
  InteriorPoint path(basis_, limits_, counts_);
  const bool reduced = island.last - island.first == island.last_row - island.first_row;
  bool reached = false;
  for (const bool far : {false, true}) {
    if (far && reduced) break;  // large enough impulses make any contradiction of such rows small beside them
    slice(basis_.set.x.data(), island.first, island.last) = slice(basis_.work.center.data(), island.first, island.last);
    reached = path.start(island, delta_, far) && path.reduce(island, reduced_gap);
    stopped_ = path.stopped();
    if (stopped_ != MLCP_SOLVED) return Ending::stopped;
    if (reached) break;
  }
  if (!reached) return Ending::stuck;
  proximal_.center_here(island);
  feasible_ = true;
  return sharp(island, 2);
}

void Newton::begin(const Island& island, bool warm) {
  warm_ = warm;
  keep(island);
  proximal_.enter(island);
  proximal_.center_here(island);
  delta_ = 0;
  feasible_ = contradicts_ = false;
}

/// Without an answer, the best active set there is, and K without ε.
mlcp_outcome Newton::conclude(const Island& island, Ending ending) {
  if (ending != Ending::settled) {
    basis_.values.regularise(*basis_.pattern, island, 0, 0);
    go_back(island);
  }
  switch (ending) {
    case Ending::settled: return MLCP_SOLVED;
    case Ending::stopped: return stopped_;
    case Ending::indefinite: return MLCP_NOT_POSITIVE_DEFINITE;
    default: return MLCP_ITERATION_LIMIT;
  }
}

mlcp_outcome Newton::solve(const Island& island, bool warm, Left open) {
  begin(island, warm);
  Ending ending = island.crowded ? Ending::dependent : exact(island);
  left_ = {};
  for (int attempt = 0; attempt < 3 && ending != Ending::settled && ending != Ending::stopped; ++attempt) {
    left_.guess = open.guess && attempt == 0 && ending == Ending::stuck;
    left_.pivots = open.pivots && attempt == 1 && (island.last_row - island.first_row <= few_to_pivot || contradicts_);
    if (left_.guess || left_.pivots) break;
    if (attempt == 2 && feasible_ && ending == Ending::stuck && finished_ <= refined) break;  // a few rows that depend on each other change sides: for pivots
    go_back(island);
    ending = attempt == 0 ? sharp(island, 4) : attempt == 1 ? interior(island) : descent(island);
  }
  return conclude(island, ending);
}

mlcp_outcome Newton::resume(const Island& island, std::span<const Flip> flips, double epsilon) {
  proximal_.enter(island);
  proximal_.resume(epsilon);
  warm_ = true;
  feasible_ = false;
  Ending ending = basis_.change(island, flips, epsilon > 0 ? 0 : dependent_pivot, counts_) > 0 && epsilon == 0 ? Ending::dependent : Ending::settled;
  keep(island);
  proximal_.center_here(island);
  if (ending == Ending::settled) ending = epsilon > 0 ? sharp_rounds(island, most_rounds) : exact_rounds(island);
  if (ending == Ending::settled) return MLCP_SOLVED;
  basis_.values.regularise(*basis_.pattern, island, 0, 0);
  return ending == Ending::stopped ? stopped_ : MLCP_ITERATION_LIMIT;
}

mlcp_outcome Newton::solve_by_interior_points(const Island& island) {
  begin(island, true);
  const Ending ending = interior(island);
  return conclude(island, ending == Ending::indefinite ? Ending::stuck : ending);
}

/// The proximal point around 0, refined against K: every correction is (A + εD)⁻¹A z, which lies in D⁻¹ range(A) as the least norm does, so
/// that only rounding, of the size of its unit over ε, is left. The largest ε that converges is the best.
bool Newton::least_norm(const Island& island) {
  auto x = slice(basis_.set.x.data(), island.first, island.last);
  auto saved = slice(basis_.work.rhs_size.data(), island.first, island.last);
  saved = x;
  for (std::int32_t o = island.first_row; o < island.last_row; ++o) basis_.work.entered[o] = basis_.set.state[o];
  proximal_.enter(island);
  for (const double epsilon : {1e-4, 1e-6, 1e-8}) {
    // rows that hold share the load, whether they are active or not
    for (std::int32_t o = island.first_row; o < island.last_row; ++o) {
      basis_.work.center[basis_.position(o)] = 0;
      if (basis_.set.state[o] != ActiveSet::disabled && basis_.values.a[o] > 0 && std::abs(basis_.set.w[o]) <= basis_.set.tolerance[o])
        basis_.set.state[o] = ActiveSet::active;
    }
    try {
      if (soften(island, epsilon) && full_steps(island, 0) == Ending::settled && finish(island) == Ending::settled) return true;
    } catch (const Stopped&) {  // what there was stands
    }
    x = saved;
    for (std::int32_t o = island.first_row; o < island.last_row; ++o) basis_.set.state[o] = static_cast<std::uint8_t>(basis_.work.entered[o]);
    basis_.look_at_slacks(island, counts_);
  }
  return false;
}

}  // namespace mlcp
