#pragma once
// GMP: rational numbers, so that the oracle rounds nothing.
#include <gmpxx.h>

#include <optional>
#include <string>
#include <vector>

#include "support/dense.h"

/// The problem in rational numbers: every double is one, so nothing here is rounded and every comparison with 0 is true.
namespace exact {

using Rational = mpq_class;
using Numbers = std::vector<Rational>;

/// Row by row.
struct Table {
  int rows = 0, columns = 0;
  Numbers entry;

  Table(int r, int c) : rows(r), columns(c), entry(static_cast<std::size_t>(r) * c) {}
  Rational& operator()(int i, int j) { return entry[static_cast<std::size_t>(i) * columns + j]; }
  const Rational& operator()(int i, int j) const { return entry[static_cast<std::size_t>(i) * columns + j]; }
};

/// X with A X = B by elimination without exchange; none if a leading minor of A is 0.
std::optional<Table> solve(Table A, Table B);

/// w = A γ + b over the enabled rows, A = J M⁻¹Jᵀ + Σ, b = J M⁻¹k + J v_given − r; and v = v₀ + P γ over all velocities, P = M⁻¹Jᵀ.
struct Reduced {
  Table A, P;
  Numbers b, v0;
  std::vector<std::optional<Rational>> lo, hi;  ///< none: infinite
  std::vector<int> row;                         ///< of the problem

  int m() const { return static_cast<int>(b.size()); }
};
/// none if M is singular.
std::optional<Reduced> reduce(const support::Dense& problem);

}  // namespace exact
