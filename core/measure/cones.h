#pragma once
#include "measure/cone.h"
#include "measure/errors.h"

namespace mlcp {

/// Errors of contacts, from the caller's numbers alone. NONE: the normal as any unilateral row. CONVEX and COULOMB: the cone. Rows that are
/// coupled: the bounds that their normal's impulse gives.
class ConeMeasure {
 public:
  explicit ConeMeasure(const Memory& m) : error(m) {}

  /// before: `measure` has been run for the same problem, rows, velocities and impulses; its errors of the rows of cones and of coupled rows become 0
  /// and their own, those of `e` are taken over the rest. Slacks that a large µ multiplies are computed anew in extended precision; what even that
  /// does not know of µ times the slip counts as error.
  /// facets: of contacts that do not say.
  void run(const Problem& problem, const Mask* enabled, std::int32_t facets, std::span<const double> v, std::span<const double> gamma, Measure& measure,
           Errors& e);

  Array<double> error;  ///< per contact; 0 for models without a cone
};

/// Whether the solve sees a cone there: CONVEX or COULOMB with µ > 0 and all its rows enabled.
bool has_cone(const Contact& contact, const Mask* enabled);

/// Bounds of a row: its own, or those that the impulse of its normal gives.
struct RowBounds {
  double lo, hi;
};
RowBounds coupled_bounds(const Problem& problem, const Coupling& coupling, double normal_impulse);

}  // namespace mlcp
