#pragma once
#include "analyze/symbolic.h"
#include "assemble/problem.h"

namespace mlcp {

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
  Array<double> a;         ///< ordinals: aᵢ = Σⱼ Jᵢⱼ²/Mⱼⱼ + Σᵢᵢ over dynamic velocities
  Array<double> root_a;    ///< ordinals: √aᵢ, 1 where aᵢ = 0
  Array<double> lo, hi;    ///< ordinals

  explicit KktValues(const Memory& m) : lower(m), diagonal(m), factored(m), row(m), b(m), size(m), a(m), root_a(m), lo(m), hi(m) {}

  /// cost: O(entries of M, J and Σ).
  void load(const Problem& problem, const KktPattern& pattern);
  /// Σᵢᵢ := Σᵢᵢ + amount · aᵢ on the rows first .. last − 1; amount 0 restores the caller's Σ.
  void soften(const Problem& problem, const KktPattern& pattern, std::int32_t first, std::int32_t last, double amount);
  /// What the factor takes in on an island from now on: −(Σᵢᵢ + ε aᵢ) on rows, Mⱼⱼ + δ max M on velocities. K itself stays.
  void regularise(const KktPattern& pattern, const Island& island, double epsilon, double delta);
};

}  // namespace mlcp
