#pragma once
#include "factorize/dense_response.h"
#include "solve/active_set.h"
#include "solve/limits.h"

namespace mlcp {

/// Newton's method on one small island: full primal-dual active-set steps on the dense A (Hintermüller, Ito & Kunisch 2002), each a factorization of
/// A on the active rows, after a few Gauss-Seidel sweeps, fewer from the impulses of a start. Rows that depend on active ones rest. Where full steps run in circles
/// DenseSimplex finds the active set. What neither can solve, and infeasible islands, are for the methods on the sparse factor.
class DenseNewton {
 public:
  /// zero: slacks up to this, relative to their terms, count as zero.
  DenseNewton(DenseIsland& island, double zero, Counts& counts) : s_(island), zero_(zero), counts_(counts) {}

  /// Puts every row where the start has it, with its impulse if that is known. NULL: rows that may push both ways are active.
  void start(const Problem& problem, const Mask* mask);
  /// before: start(). after: the active set, its factor and its impulses.  false: given up.
  /// pivots: rows that depend on others may rest, wherever that leaves the load.
  bool solve(bool warm, bool pivots);
  /// The same from the states and impulses as they are.
  bool solve_on();

 private:
  bool too_many() const;
  void guess(int most);
  std::int32_t flip();
  std::int32_t step(double drop);
  bool dropped_joints() const;
  bool full_steps(double drop, int patience);
  void rest(std::int32_t i, ActiveSet::State to);

  DenseIsland& s_;
  const double zero_;
  Counts& counts_;
  bool impulses_ = false;
};

}  // namespace mlcp
