#pragma once
#include <span>

#include "analyze/components.h"
#include "factorize/block_ldl.h"
#include "factorize/kernels.h"

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
  std::int32_t blocks, panels;         ///< fours of velocities and of rows; what fills the last ones is 0
  BlockLdl mass;
  double *reach, *k;                   ///< 4 blocks: |v₀| = |kⱼ/Mⱼⱼ|; L⁻¹ k
  double* y;                           ///< panels of four columns of Y: entry p of row 4c + r at panel(c)[4p + r]
  std::int32_t *begin, *end;           ///< panels: blocks where one is not 0
  double* a;                           ///< 4 panels rows of 4 panels, symmetric
  double *b, *size;                    ///< m; size: |r| + |J||v₀| + 2|J||v_given| as in KktValues
  double *lo, *hi;
  BlockLdl active;                     ///< of A on the rows `member`
  std::int32_t* member;
  std::int32_t* members;                ///< how many
  std::int32_t *pushing, *fours;       ///< m, panels: scratch, rows with an impulse, fours of rows to look at
  double* gamma;                       ///< 4 panels, what fills the last one is 0
  std::uint8_t *state, *kept, *tried;  ///< m: where each row stands, and sets to go back to, for the method
  double *w, *scale;                   ///< 4 panels: slacks, and their terms by magnitude, for the method
  double* x;                           ///< 4 blocks + 4 panels: scratch
  double* scaled;                      ///< 16 blocks: D⁻¹ times a panel
  const Kernels* kernels;

  std::int32_t velocity(std::int32_t p) const { return ascending[n - 1 - p]; }  ///< the caller's
  double* panel(std::int32_t c) const { return y + std::int64_t{16} * blocks * c; }
  double* row_of_a(std::int32_t i) const { return a + std::int64_t{4} * panels * i; }
  double response(std::int32_t i, std::int32_t j) const { return row_of_a(i)[j]; }
  /// Entries of x that belong to rows.
  double* x_rows() const { return x + 4 * blocks; }
};

/// The numbers of small islands. Each has its own part, so that several threads may work on different ones.
class DenseResponse {
 public:
  explicit DenseResponse(const Memory& m) : places_(m), local_(m), slots_(m), first_(m), left_out_(m), reals_(m), integers_(m), members_(m), states_(m), islands_(m) {}

  /// Room for every component but those that `left_out` names, and what follows from the pattern; what follows from that of M alone is kept as long as its
  /// version stays. components: always the same object. allocates
  void prepare(const Problem& problem, const Components& components, std::span<const std::uint8_t> left_out = {});
  DenseIsland& island(std::int32_t c) { return islands_[c]; }
  std::int64_t entries() const { return static_cast<std::int64_t>(reals_.size()); }

  /// Loads and factors M, forms A and b.  false: M is not positive definite, or some Aᵢᵢ is negative; 0 is legal: a row between
  /// prescribed bodies.
  /// cost: Σ over the envelope of M of the lengths it meets; m² n / 2 where the rows' velocities overlap; all by panels of four.
  bool compute(const Problem& problem, std::int32_t c);

  /// Factors A on the rows `member` in their order; those with a pivot of at most drop · Aᵢᵢ depend on the others and are left out of `member`.
  /// first: members before this one are where they were at the last call.
  static void factor_active(DenseIsland& island, double drop, std::int32_t first = 0);
  /// γ of the members, 0 before: w = 0 there with the impulses of the rows that rest.
  static void solve_active(DenseIsland& island);
  /// w of the impulses, and scale, the magnitude of its terms, on every four rows of which one is in another state than `known`.
  static void slacks(const DenseIsland& island, std::uint8_t known);
  /// v of the impulses, into x.
  static void velocities(const DenseIsland& island);
  /// Aᵢᵢ less what the members take from it, for a row that is none.
  static double schur(const DenseIsland& island, std::int32_t i);
  /// The same, with z = A_SS⁻¹ A_Si on the members S in x_rows(): as the impulse of i grows by 1, theirs fall by z.
  static double couple(const DenseIsland& island, std::int32_t i);
  /// (δv, δγ) of momentum residuals k + Jᵀγ − M v in x[0, n) and of −w on the members in x_rows(), both replaced by the correction.
  static void correct(const DenseIsland& island);

 private:
  struct Place {
    std::int64_t reals, integers, slots, blocks;  // the slots end where those of the next one begin
    std::int32_t rows;
  };
  /// An entry of M on or below the diagonal of its island: values[from] belongs at mass.lower[to].
  struct Slot {
    std::int32_t from, to;
  };
  DenseIsland lay_out(std::int32_t c);
  /// Of M, whose entries it lists from `slot` on.  returns behind the last one.
  Slot* find_mass_envelope(const Problem& problem, const DenseIsland& island, Slot* slot);
  /// Of Y.
  void find_row_envelopes(const Problem& problem, DenseIsland& island);
  bool load_mass(const Problem& problem, DenseIsland& island, std::span<const Slot> slots);
  void load_row(const Problem& problem, DenseIsland& island, std::int32_t i);
  void respond(DenseIsland& island, std::int32_t panel);
  static void load_active(DenseIsland& island, std::int32_t b);
  static void solve_members(const DenseIsland& island, double* x);

  const Kernels* kernels_ = &kernels_for_this_cpu();
  const Components* components_ = nullptr;
  Array<Place> places_;
  Array<std::int32_t> local_;  // n: velocity → its number in its island, −1 in none; m behind it: rows
  Array<Slot> slots_;
  Array<std::int32_t> first_;        // of every island's M: BlockLdl::first
  Array<std::uint8_t> left_out_;     // at the last prepare()
  std::int64_t mass_version_ = -1;   // of the components that slots_ and first_ are of
  Array<double> reals_;
  Array<std::int32_t> integers_;
  Array<std::int32_t> members_;  // by component
  Array<std::uint8_t> states_;
  Array<DenseIsland> islands_;
};

}  // namespace mlcp
