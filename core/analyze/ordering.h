#pragma once
#include "analyze/dissection.h"
#include "analyze/minimum_degree.h"
#include "analyze/quotient_graph.h"

namespace mlcp {

/// Fill-reducing elimination order of the KKT matrix in which every row comes after all velocities that it touches: then its pivot is
/// −(Σ + J M⁻¹Jᵀ) reduced by the rows before it, of one sign, and no ε is needed (paper-free form of §3.2: rows may interleave
/// with bodies, the paper has them last). In crowded islands any order will do.
class Ordering {
 public:
  explicit Ordering(const Memory& m) : order(m), free_velocity(m), graph_(m), dissection_(m), degree_(m), placed_(m), members_(m), member_pointers_(m) {}

  /// throws: Stopped
  void compute(const Problem& problem, const Selection& selection, const Crowding& crowding, const Poll& poll = {});
  /// Takes the caller's order if it holds exactly the nodes that compute would order, rows after their velocities where these are not crowded.
  bool accept(const Problem& problem, const Selection& selection, const Crowding& crowding, std::span<const std::int32_t> imposed);

  /// Nothing to eliminate, nothing free.
  void clear();

  Array<std::int32_t> order;          ///< nodes
  Array<std::int32_t> free_velocity;  ///< velocities with a diagonal mass that no row touches: v = k / M, not in the order

 private:
  void collect_free(const Problem& problem, const Selection& selection);

  QuotientGraph graph_;
  Dissection dissection_;
  MinimumDegree degree_;
  Array<std::uint8_t> placed_;
  Array<std::int32_t> members_, member_pointers_;
};

}  // namespace mlcp
