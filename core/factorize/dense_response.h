#pragma once
#include <span>

#include "analyze/components.h"
#include "factorize/dense_ldl.h"

namespace mlcp {

/// One small island, everything dense. M = L D Lᵀ, Y = L⁻¹Jᵀ, A = Y ᵀD⁻¹Y + Σ, and with them
///
///     w = A γ + b,   b = Yᵀ D⁻¹ L⁻¹ k − r,   v = L⁻ᵀ D⁻¹ (L⁻¹ k + Y γ)
///
/// Rows count from 0 in the order of Components, velocities from the last one to the first: robots number their joints from the base to the
/// tips, and eliminated from the tips M has no fill, with the descendants of each joint beside it (Featherstone 2005).
struct DenseIsland {
  std::int32_t n, m;
  const std::int32_t *ascending, *row;  ///< the caller's
  DenseLdl mass;
  double *diagonal, *k;                ///< n: Mⱼⱼ; L⁻¹ k
  double* y;                           ///< m rows of n: columns of Y
  std::int32_t *begin, *end;           ///< m: where a row of y is not 0
  double* a;                           ///< m rows of m, symmetric
  double *b, *size;                    ///< m; size: |r| + |J||v₀| + 2|J||v_given| as in KktValues
  double *lo, *hi;
  DenseLdl active;                     ///< of A on the rows `member`
  std::int32_t* member;
  std::int32_t* members;                ///< how many
  double* gamma;
  std::uint8_t* state;                 ///< m: where each row stands, for the method
  double* x;                           ///< n + m: scratch

  std::int32_t velocity(std::int32_t p) const { return ascending[n - 1 - p]; }  ///< the caller's
  double response(std::int32_t i, std::int32_t j) const { return a[static_cast<std::int64_t>(i) * m + j]; }
};

/// The numbers of small islands. Each has its own part, so that several threads may work on different ones.
class DenseResponse {
 public:
  explicit DenseResponse(const Memory& m) : places_(m), local_(m), reals_(m), integers_(m), members_(m), states_(m) {}

  /// Room for every component, and what follows from the pattern. allocates
  void prepare(const Problem& problem, const Components& components);
  DenseIsland island(std::int32_t c);
  std::int64_t entries() const { return static_cast<std::int64_t>(reals_.size()); }

  /// Loads and factors M, forms A and b.  false: M is not positive definite, or some Aᵢᵢ is negative; 0 is legal: a row between
  /// prescribed bodies.
  /// cost: Σ over the envelope of M of the lengths it meets; m² n / 2 where the rows' velocities overlap.
  bool compute(const Problem& problem, std::int32_t c);

  /// Factors A on the active rows in their order; those with a pivot of at most drop · Aᵢᵢ depend on the others and are left out of `member`.
  static void factor_active(DenseIsland& island, double drop);
  /// γ of the members, 0 before: w = 0 there with the impulses of the rows that rest.
  static void solve_active(DenseIsland& island);
  /// v of the impulses, into x.
  static void velocities(const DenseIsland& island);
  /// Aᵢᵢ less what the members take from it, for a row that is none.
  static double schur(const DenseIsland& island, std::int32_t i);
  /// (δv, δγ) of momentum residuals k + Jᵀγ − M v in x[0, n) and of −w on the members in x[n, n + m), both replaced by the correction.
  static void correct(const DenseIsland& island);

 private:
  struct Place {
    std::int64_t reals, integers;
    std::int32_t rows;
  };
  void find_envelopes(const Problem& problem, DenseIsland& island);
  bool load_mass(const Problem& problem, DenseIsland& island);
  void load_row(const Problem& problem, DenseIsland& island, std::int32_t i);
  void respond(DenseIsland& island, std::int32_t i);

  const Components* components_ = nullptr;
  Array<Place> places_;
  Array<std::int32_t> local_;  // n: velocity → its number in its island, −1 in none; m behind it: rows
  Array<double> reals_;
  Array<std::int32_t> integers_;
  Array<std::int32_t> members_;  // by component
  Array<std::uint8_t> states_;
};

}  // namespace mlcp
