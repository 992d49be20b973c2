#pragma once
#include <span>

#include "analyze/symbolic.h"
#include "assemble/problem.h"

namespace mlcp {

/// Of each Mⱼⱼ, of the largest where that is 0: the δ that is added where M is only semidefinite.
constexpr double semidefinite_delta = 1e-8;

/// The numbers of one step in elimination order: K x = b with x = (v, −γ), prescribed velocities moved into b.
///
///     K = [M Jᵀ; J −Σ],   b = (k, r − J v_given)
struct KktValues {
  Array<double> lower;     ///< as KktPattern::lower_rows
  Array<double> diagonal;  ///< size
  Array<double> factored;  ///< size: the diagonal that the factor takes in, that of K or, for proximal methods, −(Σᵢᵢ + ε aᵢ) and Mⱼⱼ + δ
  Array<double> row;       ///< as KktPattern::row_columns
  Array<double> b;         ///< size
  Array<double> size;      ///< |k|; |r| + |J||v₀| + 2|J||v_given| with v₀ⱼ = kⱼ/Mⱼⱼ: terms that the errors are relative to
  Array<double> a;         ///< ordinals: aᵢ = Σⱼ Jᵢⱼ²/Mⱼⱼ + Σᵢᵢ over dynamic velocities, 1 for masses that are 0
  Array<double> root_a;    ///< ordinals: √aᵢ, 1 where aᵢ = 0
  Array<double> lo, hi;    ///< ordinals
  Array<std::int32_t> together;  ///< ordinal → the first of the rows of its island that are measured with it; empty: each row for itself

  explicit KktValues(const Memory& m) : lower(m), diagonal(m), factored(m), row(m), b(m), size(m), a(m), root_a(m), lo(m), hi(m), together(m), first_(m) {}

  /// cost: O(entries of M, J and Σ).
  void load(const Problem& problem, const KktPattern& pattern);
  /// Σᵢᵢ := Σᵢᵢ + amount · aᵢ on the rows first .. last − 1; amount 0 restores the caller's Σ.
  void soften(const Problem& problem, const KktPattern& pattern, std::int32_t first, std::int32_t last, double amount);
  /// What the factor takes in on an island from now on: −(Σᵢᵢ + ε aᵢ) on rows, Mⱼⱼ + δ Mⱼⱼ on velocities, or δ max M where
  /// Mⱼⱼ is 0. K itself stays.
  void regularise(const KktPattern& pattern, const Island& island, double epsilon, double delta);
  /// The numbers of the problem with ½ Σ δⱼ(v − u)ⱼ² added, δⱼ as in regularise(): its M and k, for the factor as well. u: by position.
  void add_proximal_mass(const KktPattern& pattern, const Island& island, double delta, const double* u);
  /// Those of the problem itself again; the factor stays that of M + δ.
  void take_proximal_mass_away(const Problem& problem, const KktPattern& pattern, const Island& island);
  /// contact_of_row: see SolveInput.
  void measure_together(const KktPattern& pattern, std::span<const Island> islands, std::span<const std::int32_t> contact_of_row);
  /// scale(ordinal) := the largest of the rows measured together.
  template <class Scale>
  void largest_together(const Island& island, Scale scale) const {
    if (together.empty()) return;
    for (std::int32_t o = island.first_row; o < island.last_row; ++o)
      if (scale(o) > scale(together[o])) scale(together[o]) = scale(o);
    for (std::int32_t o = island.first_row; o < island.last_row; ++o) scale(o) = scale(together[o]);
  }

 private:
  double largest_mass(const KktPattern& pattern, const Island& island) const;
  Array<std::int32_t> first_;  // contact → its first row in the island
};

}  // namespace mlcp
