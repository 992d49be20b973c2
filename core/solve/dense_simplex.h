#pragma once
#include "factorize/dense_tableau.h"
#include "solve/active_set.h"
#include "solve/limits.h"

namespace mlcp {

/// The pivoting method (Goldfarb & Idnani 1983, as Simplex by the dual rule) on the tableau of one small island: for rows that depend on each other, where
/// full steps of DenseNewton run in circles. Its numbers have the rounding of every pivot, so that it finds an active set and no more.
class DenseSimplex {
 public:
  /// zero: slacks up to this, relative to their terms, count as zero.
  DenseSimplex(DenseIsland& island, double zero, Counts& counts) : s_(island), tableau_(island), zero_(zero), counts_(counts) {}

  /// before: any states. after: those of a solution, and its impulses but for rounding.   false: given up; infeasible islands are among these.
  bool solve();

 private:
  void rest(std::int32_t i, ActiveSet::State to);
  bool is_in(std::int32_t i) const { return s_.state[i] == ActiveSet::active; }
  double terms(std::int32_t i) const;
  void start();
  void find_impulses();
  bool drop_beyond_bounds();
  void find_slacks();
  std::int32_t entering_row() const;
  bool treat(std::int32_t i);

  DenseIsland& s_;
  DenseTableau tableau_;
  const double zero_;
  Counts& counts_;
  std::int32_t left_ = 0;  // pivots
};

}  // namespace mlcp
