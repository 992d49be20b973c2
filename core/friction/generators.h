#pragma once
#include "assemble/mask.h"
#include "measure/cone.h"

namespace mlcp {

/// The directions d of the generators (1, µ d) that stand for each cone in a solve: in the plane both, in space a few, which are enough
/// because a solution needs no more than three at a time. Three guards, 120° apart, stay; the others are aimed where they are needed.
class Generators {
 public:
  explicit Generators(const Memory& m) : contact(m), first(m), direction(m), tried(m) {}

  /// The cones of the problem and their first directions. facets: of contacts that do not say.
  void start(const Problem& problem, const Mask* enabled, std::int32_t facets);
  std::int32_t cones() const { return static_cast<std::int32_t>(contact.size()); }
  Cone cone(const Problem& problem, std::int32_t c) const { return cone_of(problem.contacts[contact[c]], facets_); }
  /// A cone that has all the generators it ever needs.
  bool complete(const Problem& problem, std::int32_t c) const;

  /// Aims a generator of cone c at d, one of the cone's directions. Which one: with `move` the nearest that is not a guard, else, of
  /// those not active, the one with the largest slack. state, w: of the cone's generators, from its first one on.
  /// Returns its index, −1 when there is one already or none to spare.
  std::int32_t aim(const Problem& problem, std::int32_t c, Tangent d, bool move, const mlcp_row_state* state, const double* w);

  Array<std::int32_t> contact;  ///< of each cone
  Array<std::int32_t> first;    ///< first generator of each cone; one more entry than cones
  Array<Tangent> direction;     ///< of each generator
  Array<std::int32_t> tried;    ///< per cone, directions so far

 private:
  std::int32_t facets_ = 0;
};

}  // namespace mlcp
