#pragma once
#include "assemble/problem.h"

/// Right-hand sides of a time step, paper (2.5). Each one fails with Error, nothing written.
namespace mlcp {

/// k = M v + h q.
void timestep_momentum(Problem& problem, double h, std::int32_t count, const double* v, const double* q);

/// rᵢ = −(K/h) φᵢ − ∂φᵢ/∂t, K = 1 for an open gap. r may be phi or phi_t.
void timestep_rows(double h, double stabilisation, bool unilateral, std::int32_t count, const double* phi, const double* phi_t,
                   double* r);

/// rᵢ ← max(rᵢ, −eᵢ ρᵢ − ∂φᵢ/∂t) where φᵢ + h ρᵢ ≤ 0 and ρᵢ < −slowest, ρ = dφ/dt before the step: Newton's law, Moreau (1988). NULL phi_t: 0.
void timestep_restitution(double h, double slowest, std::int32_t count, const double* restitution, const double* phi, const double* rate,
                          const double* phi_t, double* r);

/// A row with a compliance in place of a spring, a damper or a soft joint.
struct SoftRow {
  double compliance, r;
};
/// Σ = 1/(h (h s + d)),  r = −s φ/(h s + d)
SoftRow timestep_spring(double h, double stiffness, double damping, double phi);
/// Σ = cfm/h,  r = −(erp/h) φ
SoftRow timestep_erp_cfm(double h, double erp, double cfm, double phi);

}  // namespace mlcp
