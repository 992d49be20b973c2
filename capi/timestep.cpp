#include "assemble/timestep.h"

#include "handles.h"

using namespace mlcp;

namespace {

void put(const SoftRow& row, double* compliance, double* r) {
  *compliance = row.compliance;
  *r = row.r;
}

}  // namespace

mlcp_status mlcp_timestep_momentum(mlcp_problem* problem, double h, int32_t count, const double* v, const double* q) {
  return edit(problem, [&](mlcp_problem& p) { timestep_momentum(p.problem, h, count, v, q); });
}

mlcp_status mlcp_timestep_rows(double h, double stabilisation, int32_t unilateral, int32_t count, const double* phi,
                               const double* phi_t, double* r) {
  return guard(nullptr, [&] { timestep_rows(h, stabilisation, unilateral != 0, count, phi, phi_t, r); });
}

mlcp_status mlcp_timestep_restitution(double h, double slowest, int32_t count, const double* restitution, const double* phi,
                                      const double* rate, const double* phi_t, double* r) {
  return guard(nullptr, [&] { timestep_restitution(h, slowest, count, restitution, phi, rate, phi_t, r); });
}

mlcp_status mlcp_timestep_spring(double h, double stiffness, double damping, double phi, double* compliance, double* r) {
  if (!compliance || !r) return MLCP_ERROR_NULL;
  return guard(nullptr, [&] { put(timestep_spring(h, stiffness, damping, phi), compliance, r); });
}

mlcp_status mlcp_timestep_erp_cfm(double h, double erp, double cfm, double phi, double* compliance, double* r) {
  if (!compliance || !r) return MLCP_ERROR_NULL;
  return guard(nullptr, [&] { put(timestep_erp_cfm(h, erp, cfm, phi), compliance, r); });
}
