#pragma once
#include <span>

#include "analyze/components.h"
#include "factorize/block_ldl.h"
#include "factorize/kernels.h"

namespace mlcp {

/// One island of few velocities and many rows: N = M + JᵀWJ with a diagonal W ≥ 0, factored densely within its envelope. M sparse, J by panels of four
/// rows, of which each keeps those tiles of four velocities where one of the rows has an entry. Velocities and rows count as in DenseIsland.
struct NormalIsland {
  std::int32_t n, m;
  const std::int32_t *ascending, *row;  ///< the caller's
  std::int32_t blocks, panels;          ///< fours of velocities and of rows; what fills the last ones is 0
  std::int32_t *mass_pointers, *mass_indices;
  double* mass;                          ///< both triangles, by column
  std::int32_t *tile_pointers, *tile_block;  ///< panel → its tiles, by block of velocities, ascending
  double* tiles;                         ///< entry of row 4c + q and velocity 4b + r at [4q + r] of its tile
  BlockLdl normal;                       ///< N
  double *k, *reach;                     ///< 4 blocks: momenta; |v₀| = |kⱼ/Mⱼⱼ|
  double *r, *sigma, *a, *size, *lo, *hi;  ///< 4 panels: prescribed velocities are in r; aᵢ = Σⱼ Jᵢⱼ²/Mⱼⱼ + Σᵢᵢ; size as in DenseIsland
  double *weight;                        ///< 4 panels: W
  double *v, *momentum, *step;           ///< 4 blocks, for the method: velocities, k + Jᵀγ − M v, and a right-hand side or its solution
  double *gamma, *w, *dgamma;            ///< 4 panels, likewise: impulses, slacks, steps
  double *slack, *slope, *over, *under, *change, *other;  ///< 4 panels, scratch of the method
  std::uint8_t* state;                   ///< 4 panels: where each row stands
  const Kernels* kernels;

  std::int32_t velocity(std::int32_t p) const { return ascending[n - 1 - p]; }  ///< the caller's
  std::int32_t padded_rows() const { return 4 * panels; }
  std::int32_t padded_velocities() const { return 4 * blocks; }
};

/// The numbers of such islands. Each has its own part, so that several threads may work on different ones.
class NormalEquations {
 public:
  explicit NormalEquations(const Memory& m) : places_(m), local_(m), found_(m), reals_(m), integers_(m), states_(m), islands_(m) {}

  /// Room for every component that `taken` names, and what follows from the pattern. allocates
  void prepare(const Problem& problem, const Components& components, std::span<const std::uint8_t> taken);
  NormalIsland& island(std::int32_t c) { return islands_[c]; }
  std::int64_t entries() const { return static_cast<std::int64_t>(reals_.size()); }

  /// The caller's numbers.  false: some Mⱼⱼ is not positive, some Σᵢᵢ is negative, or Σ couples rows.
  bool load(const Problem& problem, std::int32_t c);

  /// Factors M + JᵀWJ.  false: it is not positive definite.
  /// cost: Σ over panels of (tiles)², and over the envelope of the lengths it meets.
  static bool factor(NormalIsland& island);
  /// momentum := k + Jᵀγ − M v,   w := J v + Σγ − r.
  static void residuals(NormalIsland& island);
  /// (dv, dγ) of  M dv − Jᵀdγ = momentum,   J dv + W⁻¹dγ = f  on rows with a weight, dγ = 0 on others: into step and dgamma. f: before in dgamma.
  static void solve(NormalIsland& island);
  /// |J|(|v| + |v₀|) + |Σγ| + |r| of row i.
  static double terms(const NormalIsland& island, std::int32_t i);

 private:
  struct Place {
    std::int64_t reals, integers, states, mass, tiles;  // where its part begins; entries of M, tiles of J
  };
  void measure(const Problem& problem, std::int32_t c, Place& place);
  NormalIsland lay_out(std::int32_t c);
  void find_pattern(const Problem& problem, NormalIsland& island);
  std::span<const std::int32_t> tiles_of(const Problem& problem, std::span<const std::int32_t> rows);
  bool load_row(const Problem& problem, NormalIsland& island, std::int32_t i);

  const Kernels* kernels_ = &kernels_for_this_cpu();
  const Components* components_ = nullptr;
  Array<Place> places_;
  Array<std::int32_t> local_;   // n: velocity → its number in its island, −1 in none
  Array<std::int32_t> found_;   // scratch of tiles_of()
  Array<double> reals_;
  Array<std::int32_t> integers_;
  Array<std::uint8_t> states_;
  Array<NormalIsland> islands_;
};

}  // namespace mlcp
