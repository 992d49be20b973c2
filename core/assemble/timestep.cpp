#include "assemble/timestep.h"

#include "assemble/validate.h"

namespace mlcp {

namespace {

void check_step(double h) {
  if (!(h > 0) || !std::isfinite(h)) throw Error(MLCP_ERROR_ARGUMENT, "h = %g is not a positive time", h);
}

void check_at_least_zero(const char* name, double x) {
  if (!(x >= 0) || !std::isfinite(x)) throw Error(MLCP_ERROR_ARGUMENT, "%s = %g is not at least 0 and finite", name, x);
}

void check_fraction(const char* name, double x) {
  if (!(x >= 0 && x <= 1)) throw Error(MLCP_ERROR_ARGUMENT, "%s = %g is not in 0 .. 1", name, x);
}

SoftRow checked(const SoftRow& row) {
  if (!std::isfinite(row.compliance) || !std::isfinite(row.r))
    throw Error(MLCP_ERROR_ARGUMENT, "the numbers are too extreme: compliance = %g, r = %g", row.compliance, row.r);
  return row;
}

double row_r(double h, double stabilisation, bool unilateral, double phi, double phi_t) {
  const double k = unilateral && phi >= 0 ? 1 : stabilisation;
  return -(k / h) * phi - phi_t;
}

}  // namespace

void timestep_momentum(Problem& problem, double h, std::int32_t count, const double* v, const double* q) {
  check_step(h);
  check_length("count", count, problem.n());
  check_array("v", v, count);
  check_array("q", q, count);
  check_finite("v", v, count);
  check_finite("q", q, count);
  Array<double>& k = problem.work.value;
  k.resize(count);
  for (std::int32_t j = 0; j < count; ++j) k[j] = h * q[j];
  for (std::int32_t j = 0; j < count; ++j)
    for (std::int32_t e = problem.mass.pointers[j]; e < problem.mass.pointers[j + 1]; ++e)
      k[problem.mass.indices[e]] += problem.mass.values[e] * v[j];
  for (std::int32_t j = 0; j < count; ++j)
    if (!std::isfinite(k[j])) throw Error(MLCP_ERROR_ARGUMENT, "v[%d] = %g and q[%d] = %g overflow", j, v[j], j, q[j]);
  std::copy_n(k.data(), count, problem.momentum.data());
}

void timestep_rows(double h, double stabilisation, bool unilateral, std::int32_t count, const double* phi, const double* phi_t,
                   double* r) {
  check_step(h);
  check_fraction("stabilisation", stabilisation);
  check_count("count", count);
  check_array("phi", phi, count);
  check_array("r", r, count);
  for (std::int32_t i = 0; i < count; ++i) {
    const double value = row_r(h, stabilisation, unilateral, phi[i], phi_t ? phi_t[i] : 0);
    if (!std::isfinite(value)) throw Error(MLCP_ERROR_ARGUMENT, "phi[%d] = %g gives r = %g", i, phi[i], value);
  }
  for (std::int32_t i = 0; i < count; ++i) r[i] = row_r(h, stabilisation, unilateral, phi[i], phi_t ? phi_t[i] : 0);
}

void timestep_restitution(double h, double slowest, std::int32_t count, const double* restitution, const double* phi, const double* rate,
                          const double* phi_t, double* r) {
  check_step(h);
  check_at_least_zero("slowest", slowest);
  check_count("count", count);
  check_array("restitution", restitution, count);
  check_array("phi", phi, count);
  check_array("rate", rate, count);
  check_array("r", r, count);
  check_finite("phi", phi, count);
  check_finite("rate", rate, count);
  check_finite("r", r, count);
  if (phi_t) check_finite("phi_t", phi_t, count);
  for (std::int32_t i = 0; i < count; ++i)
    if (!(restitution[i] >= 0 && restitution[i] <= 1))
      throw Error(MLCP_ERROR_ARGUMENT, "restitution[%d] = %g is not in 0 .. 1", i, restitution[i]);
  for (std::int32_t i = 0; i < count; ++i)
    if (rate[i] < -slowest && phi[i] + h * rate[i] <= 0) r[i] = std::max(r[i], -restitution[i] * rate[i] - (phi_t ? phi_t[i] : 0));
}

SoftRow timestep_spring(double h, double stiffness, double damping, double phi) {
  check_step(h);
  check_at_least_zero("stiffness", stiffness);
  check_at_least_zero("damping", damping);
  if (stiffness == 0 && damping == 0) throw Error(MLCP_ERROR_ARGUMENT, "stiffness and damping are both 0");
  const double impedance = h * stiffness + damping;
  return checked({1 / (h * impedance), -stiffness * phi / impedance});
}

SoftRow timestep_erp_cfm(double h, double erp, double cfm, double phi) {
  check_step(h);
  check_fraction("erp", erp);
  check_at_least_zero("cfm", cfm);
  return checked({cfm / h, -(erp / h) * phi});
}

}  // namespace mlcp
