#pragma once
#include <set>
#include <vector>

#include "analyze/analysis.h"
#include "factorize/factor.h"
#include "support/dense.h"

/// A problem on its way through analysis and factor, with the dense twin of each.
namespace support {

/// Strictly lower pattern, as sets of rows by column.
using Pattern = std::vector<std::set<int>>;

/// K = [M Jᵀ; J −Σ] over all nodes, velocity j is j, row i is n + i.
Matrix kkt_matrix(const Dense& d);
/// Pattern of K over the positions of an order; structural, explicit zeros count.
Pattern kkt_pattern(const mlcp::Problem& problem, std::span<const std::int32_t> order);
/// Dense elimination of booleans: the pattern of L.
Pattern eliminate(Pattern a);
std::int64_t entries(const Pattern& a);
/// first entry below the diagonal, −1 where there is none
std::vector<int> tree_of(const Pattern& L);

struct Stage {
  mlcp::Analysis analysis;
  mlcp::KktValues values;
  mlcp::Factor factor;
  std::int64_t work = 0;

  explicit Stage(const mlcp::Problem& problem, const mlcp::Mask* enabled = nullptr);
  const mlcp::KktPattern& pattern() const { return analysis.pattern; }
  const std::vector<mlcp::Island>& islands() const { return islands_; }
  /// Factors every island with the rows that wanted names by position; the worst status.
  mlcp::FactorStatus factorize(const std::vector<std::uint8_t>& wanted, double drop = 1e-9);
  /// The values of K by position, from lower and diagonal.
  Matrix loaded() const;
  /// K⁻¹ b on what is in.
  std::vector<double> solve(const std::vector<double>& b);
  const mlcp::Island& island_of(std::int32_t position) const;
  std::vector<std::int32_t> row_positions() const;

 private:
  std::vector<mlcp::Island> islands_;
};

/// ‖K x − b‖ over what is in, relative to |K||x| + |b|.
Real residual_of(const Stage& stage, const Matrix& K, const std::vector<double>& x, const std::vector<double>& b);
/// Pivots of an L D Lᵀ of K restricted to what is in, in order; 0 for what is out.
Vector pivots_of(const Stage& stage, const Matrix& K);

}  // namespace support
