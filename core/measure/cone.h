#pragma once
#include <cstdint>

#include "assemble/problem.h"

namespace mlcp {

/// A direction in the tangent plane; in the plane problem y = 0.
struct Tangent {
  double x = 0, y = 0;
};
inline double dot(Tangent a, Tangent b) { return a.x * b.x + a.y * b.y; }
double length(Tangent t);

/// Impulse or slack of a contact: normal and tangent components.
struct ContactVector {
  double n = 0;
  Tangent t;
};

/// K = {γ : |γ_T| ≤ µ γ_n}, or with facets > 0 the pyramid inside it that the generators (1, µ dⱼ) span, dⱼ = (cos 2πj/N, sin 2πj/N).
/// In the plane both are the same, with d = ±1. Trigonometry is in extended precision, which no CPU has its own variant of.
struct Cone {
  double mu;
  std::int32_t facets;  ///< 0: circular
  bool planar;

  bool pyramid() const { return facets > 0 && !planar; }
  /// dⱼ of a pyramid; j may be any integer.
  Tangent direction(std::int32_t j) const;
  /// The facet whose direction is next to t ≠ 0, the first one of two.
  std::int32_t nearest_facet(Tangent t) const;
  /// The direction among those of K that maximises −d·slip: against the slip; 0 for no slip.
  Tangent against(Tangent slip) const;
  /// maxⱼ(−dⱼ·slip) ≥ 0, the slip that enters the shift of de Saxcé & Feng (1998).
  double support(Tangent slip) const;
  /// The point of K next to x.
  ContactVector project(const ContactVector& x) const;
  /// Defect of K* ∋ w ⊥ γ ∈ K in units of w: max(a·dist(γ, K), dist(w, K*), |γ·w|/|γ|), dist(w, K*) = |P_K(−w)| (Moreau).
  double defect(const ContactVector& gamma, const ContactVector& w, double a) const;

 private:
  ContactVector project_circular(const ContactVector& x) const;
  ContactVector project_sector(const ContactVector& x) const;
};

/// facets: the solver's setting, for contacts that do not say.
inline Cone cone_of(const Contact& c, std::int32_t facets) { return {c.mu, c.facets > 0 ? c.facets : facets, c.dimension == 2}; }

/// The numbers of a contact's rows.
inline ContactVector contact_vector(const Contact& c, const double* rows) {
  return {rows[c.row], {rows[c.row + 1], c.dimension == 3 ? rows[c.row + 2] : 0.0}};
}

}  // namespace mlcp
