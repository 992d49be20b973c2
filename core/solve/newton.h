#pragma once
#include "solve/proximal.h"

namespace mlcp {

/// Of a factor that has room for dependent rows, and is still that of K to refinement.
constexpr double sharp_epsilon = 1e-8;

/// Semismooth Newton on the complementarity conditions: every row is put where the last point says it belongs, many at a time, and the linear
/// system is solved again (a primal-dual active set method; Hintermüller, Ito & Kunisch 2002). The changes go through row toggles of
/// the factor, or through one factorization where that touches less.
///
/// Full steps alone are the whole method on most scenes: a handful from a fair guess. They need not converge, so
///   exact      ε = 0, as long as the number of changes falls and no row depends on active ones;
///   sharp      ε = 1e-8, the same with dependent rows;
///   interior   from the centre of what is feasible by interior points (InteriorPoint) to an active set, then sharp again;
///   descent    ε from 1e-2 down, with an exact line search on the proximal problem: from anywhere. Lowered when the inner problem is solved.
/// Each ends with ε = 0: iterative refinement against K itself, and a last look whether every row is where it belongs.
class Newton {
 public:
  struct Left {
    /// From the active set of the problem nearby, full steps run in circles; sweeps from its impulses will find a better one.
    bool guess = false;
    /// Few rows, or an active set of which some rows depend on others and contradict them by more than a rounding.
    bool pivots = false;
  };

  Newton(Basis& basis, Limits& limits, Counts& counts) : basis_(basis), limits_(limits), counts_(counts), proximal_(basis, counts) {}

  /// before: states, and impulses where they are known (x of the rows).
  /// SOLVED: the basis holds the answer. ITERATION_LIMIT: it gave up, and the active set is the best start that it knows.
  /// warm: the start solved a problem nearby. open: what it may leave to others.
  mlcp_outcome solve(const Island& island, bool warm, Left open);
  /// After ITERATION_LIMIT: who will be done sooner than the ways that were not tried.
  Left left() const { return left_; }
  /// Goes on from an answer that the factor with this ε belongs to, after numbers of rows have changed: `flips` first, then full steps.
  /// SOLVED: the basis holds the answer. ITERATION_LIMIT: it takes more than that.
  mlcp_outcome resume(const Island& island, std::span<const Flip> flips, double epsilon);
  /// From impulses that solved a problem nearby, along the path of interior points alone. As solve().
  mlcp_outcome solve_by_interior_points(const Island& island);
  /// Among the impulses that give this velocity, those with the least Σ aᵢγᵢ²: the proximal point around 0 as ε → 0. before: the basis holds an
  /// answer. false: not found, and the point is what it was.
  bool least_norm(const Island& island);
  double epsilon() const { return proximal_.epsilon(); }  ///< of the factor that is left
  bool semidefinite() const { return delta_ > 0; }        ///< that factor is of M + δ

 private:
  enum class Ending { settled, stuck, dependent, stopped, indefinite };
  void begin(const Island& island, bool warm);
  mlcp_outcome conclude(const Island& island, Ending ending);
  Ending exact(const Island& island);
  Ending exact_rounds(const Island& island);
  Ending sharp(const Island& island, int rounds);
  Ending sharp_rounds(const Island& island, int rounds);
  Ending descent(const Island& island);
  Ending interior(const Island& island);
  Ending full_steps(const Island& island, double drop);
  Ending minimise(const Island& island);
  Ending finish(const Island& island, bool from_x = false, bool solved = false);
  bool empty_rows_hold(const Island& island) const;
  bool impulses_forgive(const Island& island) const;
  bool impulses_grow(const Island& island) const;
  void keep(const Island& island);
  void go_back(const Island& island);
  bool soften(const Island& island, double epsilon);

  Basis& basis_;
  Limits& limits_;
  Counts& counts_;
  Proximal proximal_;
  double delta_ = 0;
  bool feasible_ = false;     // interior points have shown it
  bool contradicts_ = false;  // the active set stays, and some of its rows contradict each other
  bool warm_ = false;
  Left left_;
  double finished_ = 0;          // error of the last finish
  std::span<const Flip> flips_;  // of the last finish
  mlcp_outcome stopped_ = MLCP_SOLVED;
};

}  // namespace mlcp
