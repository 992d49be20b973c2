#pragma once
#include "analyze/symbolic.h"
#include "factorize/kernels.h"
#include "factorize/kkt_values.h"
#include "threads/poll.h"

namespace mlcp {

enum class FactorStatus {
  ok,
  dependent,             ///< an insertion was not made: the row depends on those that are in
  small_pivot,           ///< the update would divide by rounding: the factor is stale, refactorize
  not_positive_definite  ///< a velocity's pivot is not positive: Factor::failed_position()
};

/// Numeric L D Lᵀ of K restricted to the nodes that are in: all velocities and the active rows. Stored as C = L D, so that a
/// column needs no rescaling when its pivot changes; columns and rows of what is out are zero ("as if they were not there").
/// Every island is factored, updated and solved on its own range; several threads may work on different islands.
///
/// invariant, per fresh island: Σ_k C(:,k) C(:,k)ᵀ / d_k = K on the nodes that are in, up to rounding.
class Factor {
 public:
  explicit Factor(const Memory& m) : values_(m), pivot_(m), inverse_(m), in_(m), next_(m), head_(m), cursor_(m), place_(m), y_(m), gathered_(m), block_pointers_(m), blocks_(m), mark_(m), reach_(m), failed_(m) {}

  /// Sizes everything for this pattern. allocates; all islands are stale afterwards.
  void prepare(const KktPattern& pattern, const Symbolic& symbolic, const KktValues& values);
  /// New numbers in the same pattern: all islands are stale afterwards.
  void forget(const KktValues& values) { kkt_ = &values; }

  bool in(std::int32_t p) const { return in_[p] != 0; }
  double pivot(std::int32_t p) const { return pivot_[p]; }

  /// What factorizations ask until the next prepare(); the island that one stops on is stale.
  void ask(const Poll& poll) { poll_ = poll; }

  /// Factors an island afresh with the rows that wanted[p] names. A row whose pivot is at most drop · a in size depends on the
  /// rows before it and is left out: in(p) is false afterwards.
  /// cost: Σ over columns of (entries)², left-looking by runs.  throws: Stopped.
  FactorStatus factorize(const Island& island, const std::uint8_t* wanted, double drop, std::int64_t& work);

  /// Takes row p out.  before: in.  after: as if row and column p were not there.  allocates nothing.
  /// cost: the columns on the path parent(p) → root, and row p of L.
  /// source: Davis & Hager (2005): row deletion as one rank-1 update.
  FactorStatus remove(std::int32_t p, std::int64_t& work);
  /// Takes row p in, unless its pivot is at most drop · a in size.  before: out.  after: as if factored with it.  The same paper: one sparse
  /// solve and one rank-1 downdate.
  FactorStatus insert(std::int32_t p, std::int64_t& work, double drop = 0);

  /// x := K⁻¹ x over an island; entries of nodes that are out come back 0.
  void solve(const Island& island, double* x, std::int64_t& work) const;
  /// x := K⁻¹ K(:,p) over an island, for a row p that is out. returns its Schur complement K_pp − K(p,:) K⁻¹ K(:,p), whose sign
  /// is that of −(Σ + J M⁻¹Jᵀ). The forward part follows the paths from row p's nodes alone.
  double solve_row(const Island& island, std::int32_t p, double* x, std::int64_t& work);

  /// The Schur complement of solve_row alone: no backward part.
  double schur(const Island& island, std::int32_t p, std::int64_t& work);

  /// Columns on the path parent(p) → root: what a toggle of p may touch.
  std::int64_t path_columns(std::int32_t p) const;
  std::int32_t failed_position(const Island& island) const { return failed_[island.first]; }
  const Symbolic& symbolic() const { return *symbolic_; }

 private:
  std::int32_t reach(std::int32_t p, std::int32_t below, std::int32_t last);
  Stretch stretch(std::int32_t first, std::int32_t last) const;
  Stretch batch(std::int32_t first, std::int32_t last) const;
  FactorArrays arrays() const;
  void backward_all(const Island& island, double* x, std::int64_t& work) const;
  template <class Visit>
  void for_each_stretch(std::int32_t top, std::int32_t last, Visit visit);
  double forward_row(std::int32_t p, std::int32_t last, double* x, bool keep, std::int64_t& work);
  std::int64_t entry(std::int32_t column, std::int32_t row) const;
  FactorStatus rank_one(std::int32_t p, double sigma, std::int64_t& work);
  void clear_row(std::int32_t p, std::int64_t& work);
  void load(std::int32_t first);
  void subtract(std::int32_t batch, std::int32_t first, std::int64_t& work);
  template <class Visit>
  void for_each_sum(std::int32_t first, std::int32_t last, std::int64_t tail, std::int32_t p, std::int64_t& work, Visit visit);
  bool depends(std::int32_t p, double d, double drop);
  double terms(std::int32_t p);
  bool eliminate(std::int32_t first, std::int32_t p, double drop, std::int64_t& work);
  void finish_batch(std::int32_t p, std::int64_t& work);
  void wait(std::int32_t batch);
  void multiply_out(std::int32_t last, std::int64_t& work);

  const Kernels* kernels_ = &kernels_for_this_cpu();
  const KktPattern* pattern_ = nullptr;
  const Symbolic* symbolic_ = nullptr;
  const KktValues* kkt_ = nullptr;
  Poll poll_;
  Array<double> values_;             // C, as Symbolic::rows
  Array<double> pivot_, inverse_;    // d and 1/d; 1/d = 0 for what is out
  Array<std::uint8_t> in_;
  Array<std::int32_t> next_, head_;  // batches, by last column, that act next on the run that begins with p, while factoring
  Array<std::int64_t> cursor_;       // their next row
  Array<std::int32_t> place_;        // row → its place in the first column of the run at hand
  Array<double> y_;                  // 0 between calls
  Array<double> gathered_;           // workspace of the kernels
  Array<std::int64_t> block_pointers_;  // where the products of a batch stand, by its last column; −1: they are summed anew for every row
  Array<double> blocks_;
  Array<std::int32_t> mark_, reach_; // mark_ is −1 between calls
  Array<std::int32_t> failed_;       // by island's first position
};

}  // namespace mlcp
