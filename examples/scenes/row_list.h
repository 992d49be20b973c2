#pragma once
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "handles.h"

namespace scenes {

using namespace handles;

/// Identity of a row over time: the two bodies and a feature of the pair (a corner, a wall, a row of a joint). Never 0.
/// Bodies below 2²⁴ − 2, features below 2¹⁶ − 1.
std::uint64_t row_key(std::int32_t body_a, std::int32_t body_b, std::int32_t feature);

enum class RowKind { Joint, Contact };

/// Rows of one step, gathered and then handed over in one bulk call. All bodies have the same dimension.
class RowList {
 public:
  explicit RowList(std::int32_t dimension) : dimension_(dimension) {}

  /// One row: ∂φ/∂q of both bodies, `dimension` numbers each (ignored for MLCP_WORLD), and φ in m: the gap of a contact, the
  /// error of a joint.
  void add(RowKind kind, std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a,
           std::span<const double> jacobian_b, double phi, std::int32_t feature);
  void add(RowKind kind, std::int32_t body_a, std::int32_t body_b, std::initializer_list<double> jacobian_a,
           std::initializer_list<double> jacobian_b, double phi, std::int32_t feature);

  /// r by the time stepping of paper (2.5) with step h and stabilisation K, then mlcp_problem_rows_add.
  void add_to(const Problem& problem, double h, double stabilisation) const;

  std::int32_t count() const { return static_cast<std::int32_t>(phi_.size()); }

 private:
  std::int32_t dimension_;
  std::vector<RowKind> kind_;
  std::vector<std::int32_t> body_a_, body_b_;
  std::vector<double> jacobian_;  // 2·dimension a row: a's block, b's block
  std::vector<double> phi_;
  std::vector<std::uint64_t> key_;
};

}  // namespace scenes
