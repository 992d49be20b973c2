#pragma once
#include <span>

#include "factorize/factor.h"
#include "factorize/mass_response.h"
#include "factorize/refinement.h"
#include "solve/active_set.h"
#include "solve/limits.h"
#include "solve/workspace.h"

namespace mlcp {

/// Pivots at most this, relative to aᵢ, belong to a row that depends on the rows in the factor.
constexpr double dependent_pivot = 1e-9;
/// Bilateral rows, and rows that a refactorization finds active, are given up only below this, whatever the sign: rounded data
/// has small pivots, and dropping them costs more than it saves.
constexpr double lost_pivot = 1e-13;

/// Compliance of every row, relative to aᵢ, by which an infeasible island is solved for the velocity of least violation.
constexpr double least_violation_softness = 1e-7;

/// The active set and the factor of its KKT matrix, kept in step: what every method works on.
/// invariant, per island: a row is in the factor if and only if its state is active.
class Basis {
 public:
  explicit Basis(const Memory& m) : values(m), set(m), factor(m), refinement(m), response(m), work(m), toggled_(m), factor_work_(m) {}

  void prepare(const Problem& problem, const Analysis& analysis, const Settings& settings);

  /// New numbers of rows in the pattern, with M and k, of the last prepare(). Rows in a factor whose entries have changed leave it first, so that the
  /// factor stays true where it was made for `epsilon` (by island; < 0: not kept).
  /// after: changed[s] tells whether island s has a row that is not what it was; epsilon[s] < 0 where there is no factor any more.
  /// cost: entries of M, J and Σ, and the toggles.
  void reload(const Problem& problem, std::span<std::uint8_t> changed, std::span<double> epsilon, Counts& counts);

  /// Factors the active rows of an island afresh. Rows that depend on others (pivot ≤ drop · a) go to rest.
  /// false: a velocity's pivot is not positive, see Factor::failed_position.
  bool refactorize(const Island& island, double drop, Counts& counts);
  /// Takes row o in by a toggle, or afresh where a toggle is not safe or the settings ask so.
  /// false: it turned out to depend on the active rows and rests.
  bool activate(const Island& island, std::int32_t o, Counts& counts);
  /// Puts row o, which is not in the factor, exactly at its bound.
  void rest(std::int32_t o, ActiveSet::State to);
  /// Takes row o out and puts it at rest in `to`.
  void deactivate(const Island& island, std::int32_t o, ActiveSet::State to, Counts& counts);
  /// Makes all changes, by toggles or afresh, whichever touches less. Rows that depend on others (pivot ≤ drop · a) rest afterwards.
  /// returns the number of rows that rest against what was asked.
  std::int32_t change(const Island& island, std::span<const Flip> flips, double drop, Counts& counts);

  /// The point of the active set: v and the active impulses from the linear system (3.2), refined; refactorized once if the factor has
  /// drifted. Then w, and what counts as zero.
  void solve_point(const Island& island, Counts& counts);

  /// The refined point of the factor as it is; then w, and what counts as zero. A velocity that is 0 because large impulses cancel, or because
  /// rows at rest hold it there, comes out as rounding, which its own terms do not forgive: it is made 0 where the errors allow it.
  /// from_x: see Refinement.  returns the backward error.
  double refine(const Island& island, Counts& counts, bool from_x = false);

  /// w of the point, and what counts as zero.
  void look_at_slacks(const Island& island, Counts& counts);

  /// Slacks up to this, relative to the scale of their error, count as zero while solving.
  double zero() const { return zero_slack(*settings_); }
  /// Errors up to this leave room for what is added to them in the end.
  double forgiven() const { return 0.1 * settings_->tolerance; }

  /// The invariant of an island, for assertions.
  bool check(const Island& island) const;

  std::int32_t position(std::int32_t o) const { return pattern->row_position[o]; }
  double gamma(std::int32_t o) const { return -set.x[position(o)]; }

  const KktPattern* pattern = nullptr;
  KktValues values;
  ActiveSet set;
  Factor factor;
  Refinement refinement;
  MassResponse response;
  Workspace work;
  double contradiction = 0;  ///< see SolveInput

 private:
  bool row_moves(const Problem& problem, std::int32_t o) const;
  std::int32_t violations(const Island& island) const;
  bool still(const Island& island, bool widely);
  void count_toggle(const Island& island, Counts& counts);
  const Settings* settings_ = nullptr;
  Array<std::int32_t> toggled_;      // by island's first position: toggles since the last factorization
  Array<std::int64_t> factor_work_;  // by island's first position: entries that its last factorization touched
};

}  // namespace mlcp
