#pragma once
#include "factorize/dense_response.h"
#include "solve/active_set.h"
#include "solve/limits.h"

namespace mlcp {

/// Newton's method on one small island: full primal-dual active-set steps on the dense A (Hintermüller, Ito & Kunisch 2002), each a factorization of
/// A on the active rows, after a few Gauss-Seidel sweeps, fewer from the impulses of a start. Rows that depend on active ones rest. Where full steps run in circles,
/// and from a start that is nearly right, DenseSimplex finds the active set. What neither can solve, and infeasible islands, are for the methods on the sparse factor.
class DenseNewton {
 public:
  /// zero: slacks up to this, relative to their terms, count as zero.  pivots: rows that depend on others may rest, wherever that leaves the load.
  DenseNewton(DenseIsland& island, double zero, bool pivots, Counts& counts) : s_(island), zero_(zero), pivots_(pivots), counts_(counts) {}

  /// From the active set of a start, with its impulses if they are known; NULL: rows that may push both ways are active. after: the active set, its factor
  /// and its impulses.  false: given up.
  bool solve(const Problem& problem, const Mask* start);
  /// The same from the states and impulses as they are.
  bool solve_on();

 private:
  void start(const Problem& problem, const Mask* mask);
  bool solve_at_once();
  bool too_many() const;
  void guess(int most);
  std::int32_t flip();
  std::int32_t step(double drop);
  bool dropped_joints() const;
  bool may_pivot() const;
  void go_back();
  bool full_steps(double drop, int patience);
  bool pivot();
  void rest(std::int32_t i, ActiveSet::State to);

  DenseIsland& s_;
  const double zero_;
  const bool pivots_;
  Counts& counts_;
};

}  // namespace mlcp
