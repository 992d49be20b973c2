#pragma once
#include "analyze/analysis.h"
#include "factorize/kkt_values.h"

namespace mlcp {

/// Where each row stands, and the point that goes with it: x = (v, −γ) by position, the rest by ordinal of constraint rows.
/// invariant between pivots: rows at a bound have γ exactly there; active rows are in the factor and have w = 0; a row in state
/// `out` has no finite bound, γ = 0, and is not in the factor because it depends on active rows.
struct ActiveSet {
  enum State : std::uint8_t { at_lower, active, at_upper, out, disabled };

  Array<std::uint8_t> state;
  Array<double> x, w;
  Array<double> tolerance;        ///< |w| up to this is zero; infinite for rows that are not to enter
  Array<std::uint8_t> deferred;   ///< violated, but no step can mend it: 1
  Array<std::uint8_t> wanted;     ///< by position: rows that a factorization is to take in

  explicit ActiveSet(const Memory& m) : state(m), x(m), w(m), tolerance(m), deferred(m), wanted(m) {}
  void prepare(const KktPattern& pattern);

  /// The state a row has when it is not active: its finite bound, the lower one first.
  static State resting(double lo, double hi);
  /// The state that an enabled row starts in, by the caller's mask if there is one.
  static State starting(const Problem& problem, std::int32_t row, const Mask* mask);
  /// Starts from the caller's mask (NULL: only rows that may push both ways are active).
  void start(const Problem& problem, const KktPattern& pattern, const KktValues& values, const Mask* enabled, const Mask* mask);
  /// Row o is at rest on the wrong side of its bound.
  bool violated(std::int32_t o) const;
  void defer(std::int32_t o) {
    deferred[o] = 1;
    tolerance[o] = infinity;
  }
  /// x of a row that rests: −γ at its bound, 0 for out and disabled.
  static double resting_x(State state, double lo, double hi);
};

/// What the caller is told.
mlcp_row_state row_state(std::uint8_t state);

/// w = K(rows,:) x − b over the rows of an island; active rows included.
/// cost: entries of J and Σ.
void slacks(const Island& island, const KktPattern& pattern, const KktValues& values, const double* x, double* w);

/// tolerance = relative · (|J|(|v| + |v₀|) + |Σ||γ| + |r|), the scale of the error that is reported; infinite for rows that are deferred
/// or whose bounds are equal.
void slack_tolerances(const Island& island, const KktPattern& pattern, const KktValues& values, double relative, ActiveSet& set);

}  // namespace mlcp
