#pragma once
#include "friction/lemke.h"
#include "measure/cones.h"

namespace mlcp {

/// Coulomb's law with pyramids as one LCP (Stewart & Trinkle 1996), for one small island, dense:
///     0 ≤ γ_n ⊥ w_n ≥ 0,   0 ≤ β ⊥ Dᵀw_T + λ e ≥ 0,   0 ≤ λ ⊥ µ γ_n − eᵀβ ≥ 0,   γ_T = D β
/// over w = A γ + b with A = J M⁻¹Jᵀ + Σ, from which bilateral rows are eliminated. Lemke's method is finite on it, whatever µ is.
class StewartTrinkle {
 public:
  explicit StewartTrinkle(const Memory& m)
      : lemke_(m), row_(m), bilateral_(m), velocity_(m), local_(m), contact_(m), mass_(m), half_(m), a_(m), b_(m), unknown_(m),
        matrix_(m), q_(m), z_(m), gamma_(m), w_(m) {}

  /// island: of each row of the problem; disabled rows have −1. facets: of contacts that do not say.
  /// false: too large, rows with other bounds than 0, ∞ or none, or no solution found.
  bool solve(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row_island, std::int32_t island,
             std::int32_t facets);
  /// How a contact of that island with a cone slips.
  Tangent slip(const Problem& problem, std::int32_t contact) const;

 private:
  /// An unknown ≥ 0: an impulse along up to three rows; λ of a cone has none and `cone` its γ_n, with its β behind that.
  struct Unknown {
    std::int32_t row, rows;   ///< first one of local rows
    double weight[3];
    std::int32_t cone, facets;
  };
  bool collect(const Problem& problem, const Mask* enabled, std::span<const std::int32_t> row_island, std::int32_t island);
  void collect_velocities(const Problem& problem);
  bool form_delassus(const Problem& problem);
  void eliminate_bilateral();
  void list_unknowns(const Problem& problem, std::int32_t facets);
  void form_lcp(const Problem& problem);
  double along(const Unknown& u, const double* x) const;

  Lemke lemke_;
  Array<std::int32_t> row_, bilateral_, velocity_, local_, contact_;
  Array<double> mass_, half_, a_, b_;
  Array<Unknown> unknown_;
  Array<double> matrix_, q_, z_, gamma_, w_;
  double scale_ = 1;
};

}  // namespace mlcp
