#pragma once
#include "factorize/dense_response.h"
#include "solve/active_set.h"
#include "solve/limits.h"

namespace mlcp {

/// The pivoting method (Goldfarb & Idnani 1983, as Simplex by the dual rule) on one small island, with a dense factor of A on the active rows: for rows that
/// depend on each other, where full steps of DenseNewton run in circles.
class DenseSimplex {
 public:
  /// zero: slacks up to this, relative to their terms, count as zero.
  DenseSimplex(DenseIsland& island, double zero, Counts& counts) : s_(island), zero_(zero), counts_(counts) {}

  /// before: any states. after: those of a solution, and its impulses but for rounding.   false: given up; infeasible islands are among these.
  /// cost: of a pivot, the members times the rows, and what is left of the factor behind a row that leaves it.
  bool solve();

 private:
  void rest(std::int32_t i, ActiveSet::State to);
  double terms(std::int32_t i) const;
  void start();
  bool drop_beyond_bounds();
  void find_slacks();
  std::int32_t entering_row() const;
  bool treat(std::int32_t i);
  bool take_in(std::int32_t i);
  bool take_out(std::int32_t t);

  DenseIsland& s_;
  const double zero_;
  Counts& counts_;
  std::int32_t left_ = 0;  // pivots
};

}  // namespace mlcp
