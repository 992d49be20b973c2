#include "measure/cones.h"

#include <algorithm>
#include <cmath>

#include "factorize/extended.h"

namespace mlcp {
namespace {

/// The law of Coulomb takes µ times the slip: beyond this the rounding of a slack in double would be 1e-13 of its terms, times µ.
constexpr double steep = 1e3;

bool on(const Mask* enabled, std::int32_t row) { return !enabled || enabled->state[row] != MLCP_ROW_DISABLED; }

/// The slack that the law asks to be in K*.
ContactVector shifted(const Contact& contact, const Cone& cone, ContactVector w) {
  if (contact.model == MLCP_FRICTION_COULOMB) w.n += cone.mu * cone.support(w.t);
  return w;
}

/// wᵢ in extended precision.  cost: a tenth of a microsecond an entry.
double exact_slack(const Problem& problem, std::int32_t i, std::span<const double> v, std::span<const double> gamma) {
  Extended sum = -problem.r[i];
  const auto add = [&sum](const SparseView& matrix, std::int32_t row, std::span<const double> x) {
    for (std::int32_t t = matrix.pointers[row]; t < matrix.pointers[row + 1]; ++t) sum += static_cast<Extended>(matrix.values[t]) * x[matrix.indices[t]];
  };
  add(problem.jacobian_view(), i, v);
  add(problem.compliance_view(), i, gamma);
  return static_cast<double>(sum);
}

struct Defect {
  double residual, relative;
};

Defect defect_of(const Contact& contact, const Cone& cone, std::span<const double> gamma, const Measure& measure) {
  const ContactVector g = contact_vector(contact, gamma.data()), w = contact_vector(contact, measure.w.data());
  double a = 0, scale = 0;
  for (std::int32_t i = contact.row; i < contact.row + contact.dimension; ++i) {
    a += measure.a[i] / contact.dimension;
    scale = std::max(scale, measure.scale[i]);
    if (!std::isfinite(gamma[i]) || !std::isfinite(measure.w[i]) || !std::isfinite(measure.scale[i])) return {infinity, infinity};
  }
  const double residual = cone.defect(g, shifted(contact, cone, w), a), unknown = contact.model == MLCP_FRICTION_COULOMB ? cone.mu * extended_epsilon : 0;
  return {residual, relative_error(residual, scale) + unknown};
}

}  // namespace

bool has_cone(const Contact& contact, const Mask* enabled) {
  if ((contact.model != MLCP_FRICTION_CONVEX && contact.model != MLCP_FRICTION_COULOMB) || !(contact.mu > 0)) return false;
  for (std::int32_t t = 0; t < contact.dimension; ++t)
    if (!on(enabled, contact.row + t)) return false;
  return true;
}

RowBounds coupled_bounds(const Problem& problem, const Coupling& coupling, double normal_impulse) {
  const double push = std::max(normal_impulse, 0.0);
  return {problem.lo[coupling.row] * push, problem.hi[coupling.row] * push};
}

void ConeMeasure::run(const Problem& problem, const Mask* enabled, std::int32_t facets, std::span<const double> v, std::span<const double> gamma,
                      Measure& measure, Errors& e) {
  error.assign(problem.contacts.size(), 0.0);
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const Contact& contact = problem.contacts[c];
    if (!has_cone(contact, enabled)) continue;
    if (contact.model == MLCP_FRICTION_COULOMB && contact.mu > steep)
      for (std::int32_t t = 0; t < contact.dimension; ++t) measure.w[contact.row + t] = exact_slack(problem, contact.row + t, v, gamma);
    const Defect defect = defect_of(contact, cone_of(contact, facets), gamma, measure);
    for (std::int32_t t = 0; t < contact.dimension; ++t) measure.error[contact.row + t] = measure.residual[contact.row + t] = 0;
    error[c] = std::isfinite(defect.relative) ? defect.relative : infinity;
    e.cone_residual = std::max(e.cone_residual, defect.residual);
    if (e.worst_contact < 0 || error[c] > e.cones) e.worst_contact = static_cast<std::int32_t>(c);
    e.cones = std::max(e.cones, error[c]);
  }
  for (const Coupling& coupling : problem.couplings) {
    const std::int32_t i = coupling.row;
    if (!on(enabled, i)) continue;
    const RowBounds bounds = coupled_bounds(problem, coupling, gamma[coupling.normal]);
    const double residual = std::abs(natural_residual(measure.w[i], measure.a[i], gamma[i], bounds.lo, bounds.hi));
    measure.residual[i] = std::isfinite(residual) ? residual : infinity;
    measure.error[i] = relative_error(measure.residual[i], measure.scale[i]);
  }
  measure.take_maxima(enabled, e);
}

}  // namespace mlcp
