#pragma once
#include "analyze/dissection.h"
#include "analyze/elimination_tree.h"
#include "analyze/lineage.h"
#include "analyze/minimum_degree.h"
#include "analyze/quotient_graph.h"
#include "assemble/velocity_runs.h"

namespace mlcp {

/// Fill-reducing elimination order of the KKT matrix in which every row comes after all velocities that it touches: then its pivot is
/// −(Σ + J M⁻¹Jᵀ) reduced by the rows before it, of one sign, and no ε is needed (paper-free form of §3.2: rows may interleave
/// with bodies, the paper has them last). In crowded islands any order will do.
class Ordering {
 public:
  explicit Ordering(const Memory& m) : order(m), free_velocities(m), graph_(m), dissection_(m), degree_(m), lineage_(m), placed_(m), members_(m), member_pointers_(m), key_(m) {}

  /// throws: Stopped
  void compute(const Problem& problem, const Selection& selection, const Crowding& crowding, const Poll& poll = {});
  /// Takes the caller's order if it holds exactly the nodes that compute would order, rows after their velocities where these are not crowded.
  bool accept(const Problem& problem, const Selection& selection, const Crowding& crowding, std::span<const std::int32_t> imposed);

  /// The order of an earlier analysis, carried over to a problem whose rows came and went: velocities in the order that they had, every row where the
  /// subtrees of its velocities meet. There the front holds all rows that touch one of them, so that its elimination fills in nothing but where the row
  /// couples what was not coupled before. In crowded islands, before its velocities.
  /// last, tree: of the earlier order. Velocities count as then; any other pattern is legal too, but may fill in.     cost: O(entries of J), nearly.
  /// throws: Stopped
  void carry(const Problem& problem, const Selection& selection, const Crowding& crowding, const KktPattern& last, const EliminationTree& tree, Poll poll = {});

  /// Nothing to eliminate, nothing free.
  void clear();

  Array<std::int32_t> order;          ///< nodes
  VelocityRuns free_velocities;       ///< with a diagonal mass, and no row touches them: v = k / M, not in the order

 private:
  void collect_free(const Problem& problem, const Selection& selection);

  QuotientGraph graph_;
  Dissection dissection_;
  MinimumDegree degree_;
  Lineage lineage_;
  Array<std::uint8_t> placed_;
  Array<std::int32_t> members_, member_pointers_;
  Array<std::int32_t> key_;  // by row: when a carried order places it
};

}  // namespace mlcp
