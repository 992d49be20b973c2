#pragma once
#include "factorize/normal_equations.h"
#include "solve/active_set.h"
#include "solve/limits.h"

namespace mlcp {

/// InteriorPoint on one small crowded island: the same steps (Mehrotra 1992), with the impulses eliminated row by row, so that each step factors
/// N = M + JᵀWJ, which is as small as the velocities are few, whatever the number of rows. Then the active set that shows, with ε aᵢ on its rows:
/// refinement against the problem without ε is a proximal step each, dependent rows keep the share of the interior point, and rows that turn out wrong
/// change. What it cannot solve, and infeasible islands, are for the methods on the sparse factor.
class DenseInteriorPoint {
 public:
  /// zero: slacks up to this, relative to their terms, count as zero.
  DenseInteriorPoint(NormalIsland& island, double zero, Watch& watch, Counts& counts) : s_(island), zero_(zero), watch_(watch), counts_(counts) {}

  /// before: NormalEquations::load. From the active set and impulses of the start if it has them, first without interior points.
  /// after: states, impulses within their bounds, velocities, and the factor of that active set.   false: given up, or stopped.
  bool solve(const Problem& problem, const Mask* start);

 private:
  void rest(std::int32_t i, ActiveSet::State to);
  bool movable(std::int32_t i) const { return s_.a[i] > 0 && s_.lo[i] < s_.hi[i]; }
  void take(const Problem& problem, const Mask& start);
  bool first_point();
  void centre();
  bool reduce();
  void find_distances();
  double gap() const;
  double length() const;
  bool step();
  void settle();
  bool factor_active();
  double error_of_active() const;
  void refine();
  std::int32_t flip();
  bool polish();

  NormalIsland& s_;
  const double zero_;
  Watch& watch_;
  Counts& counts_;
  std::int32_t pairs_ = 0;       // of impulse and slack that are to have a product of 0
  double gap_ = 0;               // mean of these products
  double margin_ = 1;
};

}  // namespace mlcp
